// Into what stretches a straight part of a move is divided where shank or holder are near the stock: in each,
// they are looked for before the cutter removes anything, since it may clear later what they meet now. A
// stretch is so short that they meet hardly anything on it that the cutter clears before. Lengths mm.
#pragma once

#include "core/geometry/tool_pose.h"
#include "core/simulation/removal.h"
#include "core/toolpath/profile.h"

#include <deque>
#include <optional>

namespace millwright::simulation {

/// No stretch of a slope goes farther down: so near over stock a body may count as in it.
inline constexpr double steep_stretch = 0.1;

/// A part of a move, which turns so little that the chord of its axis is even.
struct StraightPart {
    geometry::ToolPose from, to;

    /// `f` from 0 to 1.
    [[nodiscard]] geometry::ToolPose at(double f) const;
};

/// Of a straight part, as shares of it from 0 to 1.
struct PartRange {
    double first = 0.0, last = 1.0;
};

/// Where on the way from `from` to `to` a box around the tip can meet `box`; nullopt: nowhere. `around` is
/// relative to the tip.
[[nodiscard]] std::optional<PartRange>
range_near(const Box3& box, const Box3& around, const Vec3& from, const Vec3& to);

/// What of a tool does not cut.
class AboveCutter {
public:
    struct Body {
        ToolPart part = ToolPart::shank;
        CuttingBody body;
    };

    /// `cutter` is that of the same tool.
    void add(const toolpath::Profile& cutter, ToolPart part, const toolpath::Profile& profile);

    /// Their places do not change: steps point to them.
    [[nodiscard]] const std::deque<Body>& bodies() const { return bodies_; }
    /// Where on a part any of them can reach `box`; nullopt: nowhere.
    [[nodiscard]] std::optional<PartRange> range_near(const Box3& box, const StraightPart& part) const;
    /// How many stretches the part has, none longer than a step of `cutter`.
    [[nodiscard]] double stretch_count(const CuttingBody& cutter, const StraightPart& part) const;

private:
    std::deque<Body> bodies_;
    double descent_ = 1e300; // farthest down the axis
    double longest_ = 1e300;
    double radius_ = 0.0; // of the widest
};

} // namespace millwright::simulation
