// The paper's block under a one-sine pulse: prints its region, the angle and velocity at the
// end of the pulse, and the margin, as the program stores them.
// Some headers are included only to test their dependencies: Boost and xsimd.
#include <overturn/integrate/forced_stage.hpp>
#include <overturn/mechanics/free_rocking.hpp>
#include <overturn/mechanics/region.hpp>
#include <overturn/number/digits50.hpp>
#include <overturn/number/pack.hpp>

#include <cstdio>
#include <cstdlib>

int main(int argc, char** argv)
{
    using namespace overturn;
    if (argc != 5) {
        std::fprintf(stderr, "usage: one_block SLENDERNESS RESTITUTION FREQUENCY AMPLITUDE\n");
        return 2;
    }
    const double slenderness = std::atof(argv[1]), restitution = std::atof(argv[2]);
    const double frequency = std::atof(argv[3]), amplitude = std::atof(argv[4]);

    constexpr Theory theory = Theory::nonlinear;
    const Block<double> block{slenderness, restitution};
    const PulseExcitation<double> excitation = pulse_excitation<theory>(
        pulse_motion<double>(PulseKind::one_sine), block, amplitude, frequency);
    const ForcedEnd<double> end = run_forced_stage<RungeKutta, theory>(block, excitation, 1e-9);
    std::printf("%d %.17g %.17g %.17g\n", int(region_of<theory>(end, block)),
                end.state.side * end.state.tilt, end.state.side * end.state.rate,
                margin_of<theory>(end, block));
}
