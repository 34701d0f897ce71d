// A block under a recorded ground motion, and random ones.
#pragma once

#include "overturn/mechanics/block.hpp"
#include "overturn/mechanics/record_excitation.hpp"

#include <algorithm>
#include <cmath>
#include <random>
#include <utility>

namespace overturn {

struct RecordPoint {
    Accelerogram record;
    Block<double> block;
    double scale;     ///< [1]
    double frequency; ///< samples per unit of time 1/p [1]
};

/// The time step does not matter: the frequency contains it.
inline Accelerogram accelerogram(std::vector<double> horizontal, std::vector<double> upwards = {})
{
    return {std::move(horizontal), std::move(upwards), 0.01};
}

template <Theory theory, Directions directions, class S = double>
RecordExcitation<S, directions> excitation_of(const RecordPoint& point)
{
    return {
        .motion = record_motion<S>(point.record),
        .acceleration = S(point.scale),
        .frequency = S(point.frequency),
        .to_plus = Equations<theory>::uplift_acceleration(BlockSide{S(point.block.slenderness)}),
        .to_minus =
            Equations<theory>::uplift_acceleration(BlockSide{S(point.block.other.slenderness)})};
}

/// From none of the samples to most of them lift a block with this threshold.
inline double random_threshold(std::mt19937_64& generator, const Accelerogram& record, double scale)
{
    std::uniform_real_distribution<double> uniform(0, 1.2);
    return scale * record.peak() * uniform(generator);
}

/// Standard normal numbers by the polar method. Those of std::normal_distribution are in another
/// order in libc++ than in libstdc++.
class NormalNumbers {
public:
    double operator()(std::mt19937_64& generator)
    {
        if (std::exchange(has_saved_, false)) {
            return saved_;
        }
        std::uniform_real_distribution<double> uniform(0, 1);
        double x = 0;
        double y = 0;
        double square = 0;
        do {
            x = 2 * uniform(generator) - 1;
            y = 2 * uniform(generator) - 1;
            square = x * x + y * y;
        } while (square > 1 || square == 0);
        const double factor = std::sqrt(-2 * std::log(square) / square);
        saved_ = x * factor;
        has_saved_ = true;
        return y * factor;
    }

private:
    double saved_ = 0;
    bool has_saved_ = false;
};

/// Noise whose neighbouring samples are similar, most of it within -1 and 1.
inline std::vector<double> random_samples(std::mt19937_64& generator, int samples)
{
    NormalNumbers normal;
    std::vector<double> noise;
    double last = 0;
    for (int i = 0; i < samples; ++i) {
        last = 0.8 * last + 0.35 * normal(generator);
        noise.push_back(last);
    }
    return noise;
}

inline Accelerogram random_record(std::mt19937_64& generator, int samples, Directions directions)
{
    std::vector<double> horizontal = random_samples(generator, samples);
    return accelerogram(std::move(horizontal), directions == Directions::both
                                                   ? random_samples(generator, samples)
                                                   : std::vector<double>());
}

/// Slenderness 0.08 to 0.45, restitution 0.3 to 0.9, a record of 2 to 15 units of time 1/p with up
/// to six times the acceleration that lifts the block. Gravity stays above a tenth.
inline RecordPoint random_record_point(std::mt19937_64& generator, int samples,
                                       Directions directions)
{
    std::uniform_real_distribution<double> uniform(0, 1);
    const Accelerogram record = random_record(generator, samples, directions);
    const double slenderness = 0.08 + 0.37 * uniform(generator);
    const double restitution = 0.3 + 0.6 * uniform(generator);
    const double strength = uniform(generator);
    const double most = (1.05 + 5 * strength * strength) * slenderness / record.peak();
    return {.record = record,
            .block = {slenderness, restitution},
            .scale = std::min(most, 0.9 * record.free_fall_scale()),
            .frequency = samples / (2 + 13 * uniform(generator))};
}

/// The samples with `parts` - 1 more between any two, on the straight line.
inline std::vector<double> refined(const std::vector<double>& samples, int parts)
{
    std::vector<double> all;
    for (std::size_t i = 0; i + 1 < samples.size(); ++i) {
        for (int j = 0; j < parts; ++j) {
            all.push_back(samples[i] + (samples[i + 1] - samples[i]) * j / parts);
        }
    }
    if (!samples.empty()) {
        all.push_back(samples.back());
    }
    return all;
}

/// The same point with more samples of the same motion.
inline RecordPoint refined(const RecordPoint& point, int parts)
{
    RecordPoint finer = point;
    finer.record = accelerogram(refined(point.record.horizontal(), parts),
                                refined(point.record.upwards(), parts));
    finer.frequency = parts * point.frequency;
    return finer;
}

} // namespace overturn
