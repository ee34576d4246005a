// A convex body of revolution, by half of its section: flat bottom, corner arc, flank, shank, flat top. What
// cuts and what holds it are both such bodies. Coordinates (rho, z): distance from the axis, height above
// the tip, which need not be the body's bottom. The hollow forms of the APT cutter are left out.
#pragma once

#include "core/geometry/tool_pose.h"

#include <array>
#include <vector>

namespace millwright::toolpath {

/// Lengths mm, angle rad.
struct ProfileShape {
    double flat = 0.0;       ///< radius of the flat bottom
    double corner = 0.0;     ///< radius of the arc between bottom and flank; 0: a sharp edge
    double half_angle = 0.0; ///< between axis and flank, 0 to below a right angle
    double radius = 1.0;     ///< of the shank, where the flank ends
    double bottom = 0.0;     ///< z
    double top = 1.0;        ///< z

    friend bool operator==(const ProfileShape&, const ProfileShape&) = default;
};

class Profile {
public:
    /// Throws Defect unless the numbers are finite, none is negative, the shank is not thinner than the
    /// corner and the top not below the flank's end.
    explicit Profile(const ProfileShape& shape);

    [[nodiscard]] const ProfileShape& shape() const { return shape_; }
    /// Height at which the flank ends and the shank begins.
    [[nodiscard]] double flank_end() const { return flank_to_.y(); }
    /// The farthest point in a direction (rho >= 0). Of a flat that is square to it: the middle of the bottom
    /// or the top, the lower end of the flank.
    [[nodiscard]] Vec2 support(const Vec2& direction) const;

    /// What the boundary is like, seen from a point.
    struct Near {
        double distance = 0.0;           ///< mm; negative inside
        Vec2 normal = Vec2::Zero();      ///< unit, outwards; the gradient of `distance`
        double meridian_curvature = 0.0; ///< of the surface of equal distance, in the section, 1/mm
    };
    /// `point` has rho >= 0.
    [[nodiscard]] Near near(const Vec2& point) const;

    /// The section from the bottom on the axis to the top on the axis; chords of the arc leave it by no more
    /// than `tolerance` mm.
    [[nodiscard]] std::vector<Vec2> outline(double tolerance) const;

private:
    struct Line {
        Vec2 from, to, normal;
    };
    [[nodiscard]] bool faces_corner(const Vec2& from_center) const;
    [[nodiscard]] bool inside(const Vec2& point) const;

    ProfileShape shape_;
    Vec2 center_ = Vec2::Zero(); // of the arc
    Vec2 flank_normal_ = Vec2::Zero();
    Vec2 flank_from_ = Vec2::Zero(), flank_to_ = Vec2::Zero();
    std::array<Line, 4> lines_; // bottom, flank, shank, top; those without length are points
};

/// The same in space: the body where `pose` takes it (tip on z = 0 of the profile), seen from `point`.
struct BodyNear {
    double distance = 0.0;       ///< mm; negative inside
    Vec3 normal = Vec3::Zero();  ///< unit, away from the body
    Mat3 hessian = Mat3::Zero(); ///< of the distance, 1/mm
};
[[nodiscard]] BodyNear near(const Profile& body, const geometry::ToolPose& pose, const Vec3& point);
/// The distance alone.
[[nodiscard]] double distance(const Profile& body, const geometry::ToolPose& pose, const Vec3& point);

/// The height over `point`, along the unit `direction`, at which the body begins: infinity where it does not.
/// Of a point inside the body less than 0: so deep below it the body ends.
[[nodiscard]] double
height_over(const Profile& body, const geometry::ToolPose& pose, const Vec3& point, const Vec3& direction);

// How high over a point of the surface a body of revolution begins, where only what is lower than something
// counts.

/// As height_over(); what is not below `enough` may be given as any other height that is not.
[[nodiscard]] double height_below(const Profile& body,
                                  const geometry::ToolPose& pose,
                                  const Vec3& point,
                                  const Vec3& direction,
                                  double enough);

} // namespace millwright::toolpath
