#include "core/kinematics/rotary_tilt.h"

#include "core/base/numbers.h"
#include "core/base/units.h"

#include <cmath>

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

} // namespace millwright::kinematics
