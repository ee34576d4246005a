// The rotary-tilt machine of the thesis in closed form, as an oracle for the general chain and for comparison
// with the original. Source: Parasilmongkol 1997, ch. 3 eqs 4-8 and listing. The corrections of the printed
// formulas are derived in docs/reference/kinematics.md. Lengths mm, angles rad.
#pragma once

#include "core/geometry/vectors.h"
#include "core/kinematics/machine_model.h"

#include <optional>

namespace millwright::kinematics {

/// Set-up and machine constants, with the thesis's letters.
struct RotaryTilt {
    double a = 0.0, b = 0.0, c = 0.0; ///< workpiece on the rotary table
    double e = 0.0;                   ///< eccentricity of the tilt axis
    double AB = 0.0;                  ///< rotary table to tilt axis
    double B4 = 0.0;                  ///< tilt axis to machine base
    double OF = 0.0;                  ///< tool tip to machine base
};

/// Appendix listing; chapter 3 (which gives no workpiece position: zero); the values of the GUI's dialog.
inline constexpr RotaryTilt listing_values{-15.0, 0.0, 175.0, 0.08, 251.286, 371.943, 119.644};
inline constexpr RotaryTilt chapter_3_values{0.0, 0.0, 0.0, 0.08, 251.286, 371.943, 119.644};
inline constexpr RotaryTilt gui_values{115.0, 0.0, 125.0, 0.001, 251.168, 371.313, 119.0};

/// Eqs 4-5 with the product form of Z_m.
[[nodiscard]] Vec3 machine_from_workpiece(const RotaryTilt& machine, const Vec3& p_w, double A, double B);

/// The listing's inverse: undoes machine_from_workpiece exactly.
[[nodiscard]] Vec3 workpiece_from_machine(const RotaryTilt& machine, const Vec3& M, double A, double B);

/// The listing's forward lines with their early parenthesis. Wrong; kept to reproduce the original's numbers.
[[nodiscard]] Vec3
faulty_listing_machine_from_workpiece(const RotaryTilt& machine, const Vec3& p_w, double A, double B);

/// Which formulas turn a surface normal into A and B. Only `consistent` points the tool along the normal; the
/// other two reproduce faults of the original and serve for regression only.
enum class AngleMode {
    consistent,    ///< A = -atan(j/i), B = atan2(k, i cos A - j sin A)
    faulty_text,   ///< the table of ch. 3: tilt from the vertical where eqs 4-5 need the elevation
    faulty_listing ///< the listing: also a wrong sign of A for i < 0, j != 0
};

struct RotaryTiltAngles {
    double A = 0.0;
    double B = 0.0;
    bool A_is_free = false; ///< the normal is vertical within `vertical_threshold`
};

inline constexpr double vertical_threshold = 0.01; // of sqrt(i^2 + j^2); ch. 3 and listing

/// The principal branch: A in (-90, 90] deg for `consistent`.
[[nodiscard]] RotaryTiltAngles rotary_tilt_angles(AngleMode mode, const Vec3& normal);

// The constants of the thesis's rotary-tilt machine in a machine file: read from its axes, and put there.
// Source: Parasilmongkol 1997, ch. 3 and the dialog Tool Set (a, b, c, e, OF, AB, B4).

/// The constants of `machine`; nothing where it is built otherwise. A machine has only the difference
/// B4 - OF, the height of the tool tip over the tilt axis: OF is its `tip_to_base` (0 without one) for the
/// machine file's own tool, and as much more as the tool in the spindle is longer.
[[nodiscard]] std::optional<RotaryTilt> rotary_tilt_of(const MachineModel& machine);

/// `machine` with these constants and this place of the part; its bodies stay where its file has them. Throws
/// Error where rotary_tilt_of() knows none.
[[nodiscard]] MachineModel with_rotary_tilt(const MachineModel& machine, const RotaryTilt& constants);

} // namespace millwright::kinematics
