// Half of a cutter's section as heights over its tip, and where it comes to rest when it is lowered along its
// axis onto a point, an edge or a plane. Frame: the tool's axis is +Z. Lengths mm. docs/reference/meshes.md.
#pragma once

#include "core/geometry/vectors.h"
#include "core/toolpath/profile.h"

#include <optional>

namespace millwright::mesh_finish {

/// Where a lowered cutter rests.
struct Rest {
    double z = 0.0;              ///< of its tip
    Vec3 contact = Vec3::Zero(); ///< where it touches
};

/// The profile's height over the tip grows with the distance from the axis and is convex, up to the shank;
/// above it the shank goes on without an end, so that nothing stands over a path.
class CutterOutline {
public:
    explicit CutterOutline(const toolpath::Profile& body);

    /// All that is nearer to it than `by`; the tip stays where it is.
    [[nodiscard]] CutterOutline grown(double by) const;

    [[nodiscard]] double radius() const { return radius_; }
    /// Every point of the boundary lies on a ball of this radius inside the cutter; 0 of one with an edge.
    [[nodiscard]] double corner() const { return corner_; }
    [[nodiscard]] double flat() const { return flat_; }
    /// At a distance from the axis, 0 to radius().
    [[nodiscard]] double height(double rho) const;
    /// d height / d rho; infinity on the rim of an upright flank.
    [[nodiscard]] double slope(double rho) const;

    /// Lowered along the axis through `at` onto a point; nothing where it passes by.
    [[nodiscard]] std::optional<Rest> on_point(const Vec2& at, const Vec3& point) const;
    /// The same of the straight edge between two points, with its ends.
    [[nodiscard]] std::optional<Rest> on_edge(const Vec2& at, const Vec3& a, const Vec3& b) const;
    /// The same of a plane through `point`, of which either side may be up. Nothing of an upright one.
    [[nodiscard]] std::optional<Rest> on_plane(const Vec2& at, const Vec3& point, const Vec3& normal) const;

private:
    /// Along an edge that rises with `slope` >= 0 and passes the axis at `off`: how far after the passing.
    [[nodiscard]] double along_edge(double off, double slope) const;
    [[nodiscard]] double along_corner(double off, double slope) const;

    double flat_ = 0.0, corner_ = 0.0, radius_ = 0.0, bottom_ = 0.0;
    double flank_from_ = 0.0;           ///< distance from the axis where the flank begins
    double flank_height_ = 0.0;         ///< there
    double flank_slope_ = 0.0;          ///< infinity if upright
    double largest_corner_angle_ = 0.0; ///< of the corner's normal from the axis, rad
};

} // namespace millwright::mesh_finish
