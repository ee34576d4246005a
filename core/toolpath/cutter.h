// The cutter: from the point where it touches the surface (CC) to its tip (CL), and its body. A tool that is
// a point has no cutter. Axis and normal are unit vectors, away from the part; lengths mm, angles rad.
// Source: the seven-parameter cutter of APT without its hollow forms; T = C + r n - r a + f e for a corner of
// radius r around a flat of radius f, where e points from the axis to the contact.
#pragma once

#include "core/toolpath/profile.h"

#include <optional>
#include <string>

namespace millwright::toolpath {

enum class CutterKind { point, ball, flat, bull_nose, cone };

/// As it is ordered. Numbers that a kind does not have are not looked at.
struct CutterShape {
    CutterKind kind = CutterKind::point;
    double diameter = 6.0;      ///< of the shank; not of a point
    double corner_radius = 1.0; ///< of a bull nose's corner; of a cone's tip, where 0 is sharp
    double half_angle = 0.1;    ///< of a cone, between axis and flank
    double length = 40.0;       ///< from the tip to the holder, or to where the shank ends

    friend bool operator==(const CutterShape&, const CutterShape&) = default;
};

/// A cylinder that begins where the cutter ends. Of no diameter there is none.
struct HolderShape {
    double diameter = 0.0;
    double length = 50.0;

    friend bool operator==(const HolderShape&, const HolderShape&) = default;
};

/// What is wrong with a shape as a sentence in mm and degrees; empty if nothing is.
[[nodiscard]] std::string fault_of(const CutterShape& cutter);
[[nodiscard]] std::string fault_of(const HolderShape& holder);

/// The body; nothing for a point. Throws Error with fault_of(shape) if there is one.
[[nodiscard]] std::optional<Profile> body_of(const CutterShape& shape);
/// The body above a cutter of that length; nothing where there is no holder. Throws Error as above.
[[nodiscard]] std::optional<Profile> body_of(const HolderShape& shape, double cutter_length);

/// From the tip to where the body touches a surface of that normal. With the axis along the normal a flat
/// bottom touches with its middle, so that the tip is the contact.
[[nodiscard]] Vec3 contact_from_tip(const Profile& body, const Vec3& normal, const Vec3& axis);

/// The tip for a contact.
[[nodiscard]] Vec3 tip_for(const Profile& body, const Vec3& contact, const Vec3& normal, const Vec3& axis);

} // namespace millwright::toolpath
