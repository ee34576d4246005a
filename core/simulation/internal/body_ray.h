// Where a line parallel to a coordinate axis goes through a cutter, in closed form. The body is cut into
// zones along its axis: corner (sphere, or torus by Newton's method), flank (cone), shank (cylinder). Lengths
// mm.
#pragma once

#include "core/toolpath/profile.h"

#include <optional>

namespace millwright::simulation {

/// A cutter at one instant, and how it moves there. Velocities are per fraction of the move.
struct MovingPose {
    Vec3 tip, axis;           ///< of the pose; the axis is a unit vector
    Vec3 tip_rate, axis_rate; ///< their derivatives
};

/// The part of a line that lies in the body. Places are coordinates along the line.
struct BodyCrossing {
    /// What the line passes through at an end.
    enum class Part : unsigned char { bottom, corner, flank, shank, top };

    double enter = 0.0, leave = 0.0;
    Part enter_part = Part::bottom, leave_part = Part::top;
};

/// A cutter's zones along its axis.
struct BodyZones {
    toolpath::ProfileShape shape;
    double tangent = 0.0;       ///< of the half angle
    double center = 0.0;        ///< z of the corner's circle
    double corner_end = 0.0;    ///< z where the flank begins
    double corner_radius = 0.0; ///< rho there
    double flank_end = 0.0;     ///< z where the shank begins
};

struct EndRate {
    double rate = 0.0;  ///< mm per fraction of the move; infinite where the line is tangent
    double slope = 0.0; ///< sine of the angle between line and surface
};

class BodyRay {
public:
    explicit BodyRay(const toolpath::ProfileShape& shape);

    [[nodiscard]] const toolpath::ProfileShape& shape() const { return zones_.shape; }
    [[nodiscard]] const BodyZones& zones() const { return zones_; }
    /// The body of all points that are no farther away than `distance` mm, or a little more at its top rim.
    [[nodiscard]] BodyRay grown(double distance) const;

    /// The crossing of the line through `origin` along coordinate axis `k` (0 to 2), nullopt where it misses.
    /// Precise where `origin` is near the body; its coordinate k counts.
    [[nodiscard]] std::optional<BodyCrossing>
    crossing(const Vec3& tip, const Vec3& axis, const Vec3& origin, int k) const;

    /// How fast the place of one end of the crossing moves.
    [[nodiscard]] EndRate
    rate_of(const MovingPose& pose, const Vec3& at, BodyCrossing::Part part, int k) const;

private:
    struct Line; // in the coordinates of the body
    void add_corner(const Line& line, std::optional<BodyCrossing>& found) const;
    void add_flank(const Line& line, std::optional<BodyCrossing>& found) const;
    void add_shank(const Line& line, std::optional<BodyCrossing>& found) const;
    [[nodiscard]] bool clip_to_torus(const Line& line, BodyCrossing& part) const;

    BodyZones zones_;
};

} // namespace millwright::simulation
