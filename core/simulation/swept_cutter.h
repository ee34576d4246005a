// What a cutter removes on its way from one pose to the next: the tip goes straight, the axis turns evenly in
// one plane. Along a line parallel to a coordinate axis that is an interval. Lengths mm, angles rad.
//
// An end of the interval is the least, over the fraction f of the move, of where the line enters the body at
// f. For a tool that does not turn this is a convex function of f, because the body is convex; for the small
// turns allowed here it is one but for less than the tolerance. Its tangents, known in closed form for every
// part of the body, bound how much lower it can be elsewhere: the search ends when that is less than
// `sweep_tolerance`. Only true tool positions are evaluated, so that never too much is removed.
#pragma once

#include "core/geometry/tool_pose.h"
#include "core/simulation/internal/body_ray.h"
#include "core/simulation/interval.h"
#include "core/toolpath/profile.h"

#include <array>
#include <cstddef>
#include <optional>
#include <span>

namespace millwright::simulation {

/// By how much an end of a swept interval may lie within the true one along the line, mm.
inline constexpr double sweep_tolerance = 2e-4;
/// The largest turn of the axis in one step, rad (2.4 degrees). Moves that turn farther are divided.
inline constexpr double largest_turn = 0.042;

inline constexpr Interval whole_line{-1e300, 1e300};

/// How a cutter goes in one step.
struct StepMotion {
    Vec3 tip, way;       ///< from, and to the end
    Vec3 middle, across; ///< axis at f = 0.5, and the unit vector towards which it turns
    double turn = 0.0;   ///< rad
    double bend = 0.0;   ///< mm: the second derivative of an end is not below -bend / slope
    bool moves = false;
};

class SweptCutter {
public:
    /// Throws Defect if the axes are no unit vectors or the turn is larger than `largest_turn`. `body` must
    /// outlive it.
    SweptCutter(const BodyRay& body, const geometry::ToolPose& from, const geometry::ToolPose& to);

    /// The part of the line through `at` along coordinate axis `k` (0 to 2) that the cutter passes through;
    /// nullopt where it misses. Ends that are beyond `material` need not be exact.
    [[nodiscard]] std::optional<Interval>
    swept(const Vec3& at, int k, const Interval& material = whole_line) const;

    [[nodiscard]] geometry::ToolPose pose(double f) const;
    /// Around all that is removed.
    [[nodiscard]] Box3 bounds() const;
    /// No point of the body is farther from where it is at f = 0.5, mm.
    [[nodiscard]] double half_motion() const;
    [[nodiscard]] const BodyRay& body() const { return body_; }
    [[nodiscard]] const StepMotion& motion() const { return motion_; }

private:
    struct Instant; // the crossing at one f
    struct Bracket;
    struct Search;
    [[nodiscard]] MovingPose moving(double f) const;
    [[nodiscard]] std::optional<Instant>
    instant(double f, const Vec3& at, int k, const std::array<double, 2>& enough) const;
    [[nodiscard]] std::optional<Interval> searched(const Search& search) const;
    [[nodiscard]] std::optional<Instant> any_hit(const Search& search) const;
    [[nodiscard]] double
    least_of(std::span<const std::optional<Instant>> tried, const Search& search, std::size_t end) const;
    [[nodiscard]] double lowest(Bracket bracket, const Search& search, std::size_t end) const;

    const BodyRay& body_;
    StepMotion motion_;
};

} // namespace millwright::simulation
