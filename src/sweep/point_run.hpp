// The forced stages of a set of points, as often and as finely as their verdicts need.
#pragma once

#include "sweep_kernel.hpp"

#include "overturn/mechanics/region.hpp"
#include "overturn/sweep/plane.hpp"
#include "overturn/sweep/tile.hpp"

#include <vector>

namespace overturn {

/// The arrays behind PointEnds; those that the records do not ask for are empty.
struct Ends {
    Ends(std::size_t points, const Records& recorded);

    PointEnds pointers();
    int size() const { return int(tilt.size()); }

    Records records;
    std::vector<double> tilt, rate, side;
    std::vector<std::uint8_t> flags, region;
    std::vector<double> margin, impacts, error, steps, phase, peak;
};

/// The points of a tile, row by row, frequency fastest.
std::vector<PlanePoint> points_of(const Plane& plane, const Tile& tile);

/// Each push once, as long as neighbours share it; in the order of the points.
struct Pushes {
    Pushes(const GroundMotion<double>& motion, Theory theory,
           const std::vector<PlanePoint>& points);

    const Push& operator[](int point) const
    {
        return pushes[std::size_t(of_point[std::size_t(point)])];
    }

    std::vector<Push> pushes;
    std::vector<int> of_point;
};

/// Points of one scene, made ready to run. Whatever takes long throws TileDropped once it is
/// requested.
class PointRun {
public:
    PointRun(const Scene& scene, std::vector<PlanePoint> points, Kernel kernel,
             DropRequested drop_requested = nullptr);

    int size() const { return int(points_.size()); }

    /// Integrates every point, or the chosen ones, in ascending order.
    void run(const Numerics& numerics, Ends& ends,
             OnUnknownError on_unknown_error = OnUnknownError::go_on,
             const std::vector<int>* chosen = nullptr) const;

    /// Integrates one point in more digits, T: long double or Digits50. Region, margin and error
    /// are found before the end is rounded to doubles.
    template <class T>
    void run_exactly(int point, Ends& ends) const;

    /// Settles a point that provably only bounces low: it is safe, its margin what is left open by
    /// bound_of_low_bounces(). If its bounces were too many to follow, it is at rest but for that.
    bool settle_low_bounces(int point, Ends& ends) const;

    /// The largest |theta| / alpha, and the time from the first uplift to |theta| = pi/2 [1/p],
    /// both during the pulse and after it; infinite where the block falls, or does not. Ends with
    /// regions, and with peaks or phases.
    std::vector<double> peaks(const Ends& ends) const;
    std::vector<double> fall_times(const Ends& ends) const;

private:
    void throw_if_dropped() const;

    Scene scene_;
    GroundMotion<double> motion_;
    Kernel kernel_;
    DropRequested drop_requested_;
    std::vector<PlanePoint> points_;
    Pushes pushes_;
};

/// Where the points end: integrated once; or, if verdicts are to be resolved, those in doubt again,
/// with more and more digits. What stays in doubt gets end_flag::unresolved. See resolve.cpp.
Ends ends_of(const PointRun& points, const Numerics& numerics, const Records& records);

} // namespace overturn
