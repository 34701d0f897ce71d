// Random grids of one block and 32 x 32 pulses: half of them with realistic blocks and pulses, half
// of them over the whole range of jobs in which a pulse can move the block; half of each close to a
// boundary between safe and unsafe, if a line of amplitudes crosses one. Half of the blocks have
// two different sides.
#pragma once

#include "overturn/mechanics/block.hpp"
#include "overturn/mechanics/region.hpp"
#include "overturn/problem/coordinates.hpp"
#include "overturn/sweep/compute_tile.hpp"
#include "support/given_values.hpp"
#include "support/two_sides.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <random>
#include <utility>

namespace overturn {

/// One block under pulses of these amplitudes and frequencies.
struct PulsesOfBlock {
    Quantities block;     ///< as given in a job, with its restitution
    AxisList amplitudes;  ///< over the smaller uplift acceleration [1]
    AxisList frequencies; ///< over p, that of the side plus [1]
    /// Of blocks with two different sides, whose jobs give dimensional strengths and rates.
    std::optional<double> uplift = std::nullopt; ///< the smaller uplift acceleration over g [1]
    double frequency_parameter = 1;              ///< p of the side plus [1/s]

    Grid grid() const
    {
        const auto times = [](AxisList values, double unit) {
            for (double& value : values) {
                value *= unit;
            }
            return values;
        };
        const Quantities strength_and_rate =
            uplift ? Quantities{axis("pga", times(amplitudes, *uplift)),
                                axis("pulse_frequency",
                                     times(frequencies, frequency_parameter / (2 * pi<double>())))}
                   : Quantities{axis("amplitude", amplitudes), axis("frequency", frequencies)};
        return grid_of({}, block + strength_and_rate);
    }
};

struct RandomGrid {
    Scene scene;
    PulsesOfBlock points;
    bool beside_boundary;
};

class RandomGrids {
public:
    RandomGrids(const Scene& scene, Kernel kernel, std::mt19937_64& generator)
        : scene_(scene), kernel_(kernel), generator_(generator)
    {}

    RandomGrid next()
    {
        Pulse& pulse = std::get<Pulse>(scene_.motion);
        if (has_window(pulse.kind)) {
            pulse.shape.window = uniform() < 0.5 ? 1 : log_between(0.1, 8);
        } else if (traits_of(pulse.kind).form == PulseForm::modulated) {
            pulse.shape.cycles = std::round(uniform() * 5 + 1) / 2;
            pulse.shape.gamma = between(1, 3);
            pulse.shape.nu = between(-pi<double>(), pi<double>());
        }
        const bool real = uniform() < 0.5;
        PulsesOfBlock points = uniform() < 0.5 ? symmetric(real) : two_sides(real);
        points.frequencies =
            sorted([&] { return real ? between(0.5, 9.5) : log_between(0.03, 30); });
        points.amplitudes =
            sorted([&] { return real ? between(1.05, 11.05) : 0.9 + log_between(1e-2, 1e2); });
        const bool drawn = uniform() < 0.5 && draw_close_to_a_boundary(points);
        return {scene_, points, drawn};
    }

private:
    static constexpr int side = 32;

    double uniform() { return std::uniform_real_distribution<double>(0, 1)(generator_); }
    double between(double low, double high) { return low + (high - low) * uniform(); }
    double log_between(double low, double high)
    {
        return std::exp(between(std::log(low), std::log(high)));
    }

    /// Some blocks have no loss.
    double restitution(double of_maximum, bool real)
    {
        const double restitution = real ? of_maximum * between(0.55, 1) : between(0.02, 1);
        return uniform() < 0.1 ? 1 : restitution;
    }

    PulsesOfBlock symmetric(bool real)
    {
        const double slenderness = real ? between(0.08, 0.45) : log_between(0.01, 1.3);
        const double r = restitution(largest_restitution(slenderness), real);
        return {{number("slenderness", slenderness), number("restitution", r)}, {}, {}};
    }

    PulsesOfBlock two_sides(bool real)
    {
        Body body = random_body(generator_);
        while (!real && !(body = wide_body()).stands()) {
        }
        const Block<double> block = body.block(restitution(body.largest_restitution(), real));
        return {
            {number("slenderness_plus", block.slenderness),
             number("slenderness_minus", block.other.slenderness), number("size_plus", block.size),
             number("size_minus", block.other.size), number("radius_of_gyration", body.gyration),
             number("restitution", block.restitution)},
            {},
            {},
            uplift_threshold(scene_.theory, std::min(block.slenderness, block.other.slenderness)),
            block.frequency_parameter};
    }

    /// Bodies with sides that may be very different, some of which do not stand.
    Body wide_body()
    {
        Body body{log_between(0.01, 3), log_between(0.01, 3), log_between(0.3, 3),
                  log_between(0.1, 3)};
        body.incline = between(-1, 1) * std::min(std::atan(body.plus / body.height),
                                                 std::atan(body.minus / body.height));
        return body;
    }

    template <class Value>
    static AxisList sorted(const Value& value)
    {
        AxisList values(side);
        std::generate(values.begin(), values.end(), value);
        std::sort(values.begin(), values.end());
        return values;
    }

    /// Two neighbours among these amplitudes, one of them safe and the other unsafe.
    std::optional<std::pair<double, double>> flip_among(PulsesOfBlock line,
                                                        const AxisList& amplitudes)
    {
        line.amplitudes = amplitudes;
        const Problem problem{.scene = scene_,
                              .grid = line.grid(),
                              .numerics = {Method::taylor, 1e-13},
                              .fields = {Field::region}};
        const TileFields fields = compute_tile(problem, tiling_of(problem)[0], kernel_);
        const auto& regions = std::get<std::vector<std::uint8_t>>(fields.values[0]);
        std::vector<std::pair<double, double>> flips;
        for (std::size_t i = 1; i < regions.size(); ++i) {
            if (is_safe(Region(regions[i - 1])) != is_safe(Region(regions[i]))) {
                flips.emplace_back(amplitudes[i - 1], amplitudes[i]);
            }
        }
        if (flips.empty()) {
            return std::nullopt;
        }
        return flips[std::size_t(uniform() * double(flips.size()))];
    }

    /// False if there is none.
    bool draw_close_to_a_boundary(PulsesOfBlock& points)
    {
        PulsesOfBlock line = points;
        const double frequency = points.frequencies[side / 2];
        line.frequencies = {frequency};
        AxisList amplitudes;
        for (double amplitude = 1.01; amplitude < 30; amplitude *= 1.06) {
            amplitudes.push_back(amplitude);
        }
        auto flip = flip_among(line, amplitudes);
        if (!flip) {
            return false;
        }
        while (flip && flip->second - flip->first > 1e-14 * flip->first) {
            amplitudes.clear();
            for (int i = 0; i < side; ++i) {
                amplitudes.push_back(flip->first + (flip->second - flip->first) * i / (side - 1));
            }
            const auto finer = flip_among(line, amplitudes);
            if (!finer) { // neighbouring doubles
                break;
            }
            flip = finer;
        }
        // Relative distances of 0.3 to 1e-8, some of them down to 1e-15.
        const auto beside = [&](double value) {
            const double distance =
                std::pow(10, -(uniform() < 0.95 ? between(0.5, 8) : between(8, 15)));
            return value * (1 + (uniform() < 0.5 ? distance : -distance));
        };
        points.frequencies = sorted([&] { return beside(frequency); });
        points.amplitudes = sorted([&] { return beside(flip->first); });
        return true;
    }

    Scene scene_;
    Kernel kernel_;
    std::mt19937_64& generator_;
};

} // namespace overturn
