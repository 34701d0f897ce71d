// The forced stages of a tile, as often and as finely as its verdicts need.
#pragma once

#include "sweep_kernel.hpp"

#include "overturn/mechanics/region.hpp"
#include "overturn/sweep/fields.hpp"
#include "overturn/sweep/kernel.hpp"
#include "overturn/sweep/plane.hpp"
#include "overturn/sweep/sweep_tile.hpp"
#include "overturn/sweep/tile.hpp"

#include <vector>

namespace overturn {

/// What a job asks of the forced stages beside where they end.
struct Asked {
    bool impacts = false;
    bool error = false;
    bool steps = false;
    bool phase = false; ///< at which the pulse ended, or the block fell
    bool peak = false;  ///< without the error: no kernel records both
};

/// A point of which more is known than its end in doubles tells: computed in more digits, or
/// bounded.
struct SettledPoint {
    int point = 0; ///< counted row by row
    Region region = Region::undecided;
    double margin = 0;
};

/// The arrays behind PointEnds; empty where nobody asks.
struct Ends {
    Ends(std::size_t points, const Asked& asked)
        : tilt(points), rate(points), side(points), flags(points),
          impacts(asked.impacts ? points : 0), error(asked.error ? points : 0),
          steps(asked.steps ? points : 0), phase(asked.phase ? points : 0),
          peak(asked.peak ? points : 0)
    {}

    PointEnds pointers();
    int size() const { return int(tilt.size()); }

    std::vector<double> tilt, rate, side;
    std::vector<std::uint8_t> flags;
    std::vector<double> impacts, error, steps, phase, peak;
    std::vector<SettledPoint> settled; ///< seldom any, as of the next
    std::vector<int> unresolved;       ///< points that stay in doubt
};

/// One tile, made ready to run; of a plane that lives longer. Whatever takes long throws
/// TileDropped once it is requested.
class TileRun {
public:
    TileRun(const Scene& scene, const Plane& plane, const Tile& tile, Kernel kernel,
            DropRequested drop_requested = nullptr);

    int points() const { return int(tile_.points()); }

    /// Integrates every point, or the chosen ones.
    void run(const Numerics& numerics, Ends& ends, InDoubt in_doubt = InDoubt::goes_on) const;
    void run(const Numerics& numerics, const std::vector<int>& chosen, Ends& ends) const;

    /// Integrates one point in more digits, T: long double or Digits50.
    template <class T>
    void run_exactly(int point, Ends& ends) const;

    /// Settles a point that provably only bounces low: it is safe, its margin what is left open by
    /// bound_of_low_bounces(). If its bounces were too many to follow, it is at rest but for that.
    bool settle_low_bounces(int point, Ends& ends) const;

    std::vector<std::uint8_t> regions(Ends& ends) const;
    std::vector<double> margins(Ends& ends) const; ///< not a number where undecided

    /// The largest |theta| / alpha, and the time from the first uplift to |theta| = pi/2 [1/p],
    /// both during the pulse and after it; infinite where the block falls, or does not. Ends with
    /// peaks, or with phases.
    std::vector<double> peaks(Ends& ends) const;
    std::vector<double> fall_times(Ends& ends) const;

private:
    void heed_drop() const;
    void run(const Numerics& numerics, const int* chosen, int count, Ends& ends,
             InDoubt in_doubt) const;
    double first_uplift(std::size_t row) const;

    Scene scene_;
    const Plane& plane_;
    Tile tile_;
    Block<double> block_;
    Kernel kernel_;
    DropRequested drop_requested_;
    std::vector<double> acceleration_, uplifts_, frequency_;
    double begin_, end_;
};

} // namespace overturn
