#include "core/kinematics/rotary_tilt.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <cmath>
#include <string>
#include <utility>

namespace millwright::kinematics {

namespace {

/// Of a component of a unit normal that is 0 but for rounding: the formulas of the original jump there, by
/// the whole tilt, from one sign of it to the other.
constexpr double rounded_zero = 1e-12;

bool is_zero_component(double component) {
    return std::abs(component) <= rounded_zero;
}

double sign(double value) {
    return value < 0.0 ? -1.0 : 1.0;
}

RotaryTiltAngles consistent_angles(double i, double j, double k) {
    const double A = exactly_equal(i, 0.0) ? -sign(j) * pi / 2.0 : -std::atan(j / i);
    const double s = i * std::cos(A) - j * std::sin(A);
    return {A, std::atan2(k, s), false};
}

/// Ch. 3's table: applies the 180 deg shift of A and the sign flip of B together where one alone is right.
RotaryTiltAngles text_angles(double i, double j, double k) {
    const double r = std::hypot(i, j);
    if (is_zero_component(i)) {
        return {-sign(j) * pi / 2.0, std::atan2(r, k), false};
    }
    if (i > 0.0) {
        return {-std::atan(j / i), std::atan2(r, k), false};
    }
    return {pi - std::atan(j / i), -std::atan2(r, k), false};
}

RotaryTiltAngles listing_angles(double i, double j, double k) {
    const double r = std::hypot(i, j);
    const double tilt = is_zero_component(k) ? pi / 2.0 : std::atan(r / k);
    if (is_zero_component(i)) {
        return {-sign(j) * pi / 2.0, tilt, false};
    }
    const double B = is_zero_component(k) ? tilt : sign(i) * tilt;
    return {-sign(i) * std::atan(j / i), B, false};
}

} // namespace

Vec3 machine_from_workpiece(const RotaryTilt& machine, const Vec3& p_w, double A, double B) {
    const auto& [a, b, c, e, AB, B4, OF] = machine;
    const double x = p_w.x(), y = p_w.y(), z = p_w.z();
    const double cA = std::cos(A), sA = std::sin(A), cB = std::cos(B), sB = std::sin(B);

    const double q = e + (a + x) * cA - (b + y) * sA;
    const double h = AB - c - z;
    const double X_m = h * cB + q * sB;
    const double Y_m = -(b + y) * cA - (a + x) * sA;
    const double Z_m = -B4 + OF + q * cB - h * sB;
    return {X_m, Y_m, Z_m};
}

Vec3 workpiece_from_machine(const RotaryTilt& machine, const Vec3& M, double A, double B) {
    const auto& [a, b, c, e, AB, B4, OF] = machine;
    const double X_m = M.x(), Y_m = M.y(), Z_m = M.z();
    const double cA = std::cos(A), sA = std::sin(A), cB = std::cos(B), sB = std::sin(B);

    const double q = -e + (B4 - OF + Z_m) * cB + X_m * sB;
    const double x = -a - Y_m * sA + q * cA;
    const double y = -b - Y_m * cA - q * sA;
    const double z = AB - c - X_m * cB + (B4 - OF + Z_m) * sB;
    return {x, y, z};
}

Vec3 faulty_listing_machine_from_workpiece(const RotaryTilt& machine, const Vec3& p_w, double A, double B) {
    const auto& [a, b, c, e, AB, B4, OF] = machine;
    const double x = p_w.x(), y = p_w.y(), z = p_w.z();
    const double cA = std::cos(A), sA = std::sin(A), cB = std::cos(B), sB = std::sin(B);

    const double h = AB - c - z;
    const double X_m = h * cB + e + (a + x) * cA - (b + y) * sA * sB;
    const double Y_m = -(b + y) * cA - (a + x) * sA;
    const double Z_m = -B4 + OF + (e + (a + x) * cA) * cB - (b + y) * sA - h * sB;
    return {X_m, Y_m, Z_m};
}

RotaryTiltAngles rotary_tilt_angles(AngleMode mode, const Vec3& normal) {
    const double i = normal.x(), j = normal.y(), k = normal.z();
    const bool vertical = std::hypot(i, j) <= vertical_threshold;
    switch (mode) {
    case AngleMode::consistent: {
        if (std::hypot(i, j) <= 0.0) {
            return {0.0, sign(k) * pi / 2.0, true};
        }
        RotaryTiltAngles angles = consistent_angles(i, j, k);
        angles.A_is_free = vertical;
        return angles;
    }
    case AngleMode::faulty_text:
        return vertical ? RotaryTiltAngles{0.0, 0.0, true} : text_angles(i, j, k);
    case AngleMode::faulty_listing:
        return vertical ? RotaryTiltAngles{0.0, 0.0, true} : listing_angles(i, j, k);
    }
    return {};
}

namespace {

constexpr double same_mm = 1e-9;
constexpr double same_angle = 1e-9; // rad, or of a unit vector

bool lies_at(const Vec3& a, const Vec3& b) {
    return (a - b).cwiseAbs().maxCoeff() <= same_mm;
}

bool goes_along(const MachineAxis& axis, char letter, AxisKind kind, const Vec3& direction) {
    return axis.letter == letter && axis.kind == kind && lies_at(axis.direction, direction);
}

/// A point on a rotary axis can lie anywhere along it.
bool passes_through(const MachineAxis& axis, const Vec3& point) {
    return (axis.point - point).cross(axis.direction).norm() <= same_mm;
}

} // namespace

std::optional<RotaryTilt> rotary_tilt_of(const MachineModel& machine) {
    const MachineDescription& of = machine.description();
    if (of.angle_formulas != AngleFormulas::rotary_tilt || of.table.size() != 2 || of.head.size() != 3) {
        return std::nullopt;
    }
    const MachineAxis &tilt = of.table[0], &rotary = of.table[1];
    const double e = of.table_origin.x();
    const bool axes =
        goes_along(tilt, 'B', AxisKind::rotary, Vec3::UnitY()) && passes_through(tilt, Vec3::Zero()) &&
        std::abs(tilt.zero_offset + pi / 2.0) <= same_angle &&
        goes_along(rotary, 'A', AxisKind::rotary, Vec3::UnitZ()) &&
        passes_through(rotary, Vec3(e, 0.0, 0.0)) && std::abs(rotary.zero_offset) <= same_angle &&
        goes_along(of.head[0], 'X', AxisKind::linear, Vec3::UnitX()) &&
        goes_along(of.head[1], 'Y', AxisKind::linear, -Vec3::UnitY()) &&
        goes_along(of.head[2], 'Z', AxisKind::linear, Vec3::UnitZ());
    const bool points = lies_at(of.table_origin, Vec3(e, 0.0, of.table_origin.z())) &&
                        lies_at(of.tool_tip, Vec3(0.0, 0.0, of.tool_tip.z())) &&
                        lies_at(of.tool_axis, Vec3::UnitZ());
    if (!axes || !points) {
        return std::nullopt;
    }
    const double OF = of.tip_to_base.value_or(0.0) + of.tool_length_offset;
    return RotaryTilt{.a = of.workpiece_offset.x(),
                      .b = of.workpiece_offset.y(),
                      .c = of.workpiece_offset.z(),
                      .e = e,
                      .AB = -of.table_origin.z(),
                      .B4 = of.tool_tip.z() + OF,
                      .OF = OF};
}

MachineModel with_rotary_tilt(const MachineModel& machine, const RotaryTilt& constants) {
    if (!rotary_tilt_of(machine)) {
        throw Error(fmt::format(
            "machine '{}' is not a rotary-tilt table like that of the thesis: it has no e, OF, AB and B4",
            machine.name()));
    }
    MachineDescription changed = machine.description();
    changed.workpiece_offset = Vec3(constants.a, constants.b, constants.c);
    changed.table[1].point = Vec3(constants.e, 0.0, 0.0);
    changed.table_origin = Vec3(constants.e, 0.0, -constants.AB);
    changed.tool_tip = Vec3(0.0, 0.0, constants.B4 - constants.OF);
    changed.tip_to_base = constants.OF - changed.tool_length_offset;
    return MachineModel(std::move(changed));
}

} // namespace millwright::kinematics
