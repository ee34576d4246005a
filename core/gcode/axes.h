// The nine axes of RS-274/NGC, in the order in which LinuxCNC counts them.
#pragma once

#include <array>
#include <cstddef>

namespace millwright::gcode {

enum class Axis : std::size_t { x, y, z, a, b, c, u, v, w };

inline constexpr std::size_t axis_count = 9;

/// The letters of the axes, in their order.
inline constexpr std::array<char, axis_count> axis_letters{'X', 'Y', 'Z', 'A', 'B', 'C', 'U', 'V', 'W'};

/// A length turns with the unit of the program; A, B and C are degrees in either.
[[nodiscard]] constexpr bool is_rotary(std::size_t axis) {
    return axis >= 3 && axis <= 5;
}

/// One value an axis: positions or offsets.
class AxisValues {
public:
    [[nodiscard]] constexpr double& operator[](Axis axis) { return values_[static_cast<std::size_t>(axis)]; }
    [[nodiscard]] constexpr double operator[](Axis axis) const {
        return values_[static_cast<std::size_t>(axis)];
    }
    [[nodiscard]] constexpr double& operator[](std::size_t axis) { return values_[axis]; }
    [[nodiscard]] constexpr double operator[](std::size_t axis) const { return values_[axis]; }

    constexpr AxisValues& operator+=(const AxisValues& other) {
        for (std::size_t n = 0; n < axis_count; ++n) {
            values_[n] += other.values_[n];
        }
        return *this;
    }
    constexpr AxisValues& operator-=(const AxisValues& other) {
        for (std::size_t n = 0; n < axis_count; ++n) {
            values_[n] -= other.values_[n];
        }
        return *this;
    }
    friend constexpr AxisValues operator+(AxisValues a, const AxisValues& b) { return a += b; }
    friend constexpr AxisValues operator-(AxisValues a, const AxisValues& b) { return a -= b; }

    /// The lengths times `factor`, the angles as they are.
    [[nodiscard]] constexpr AxisValues lengths_scaled(double factor) const {
        AxisValues scaled = *this;
        for (std::size_t n = 0; n < axis_count; ++n) {
            scaled.values_[n] *= is_rotary(n) ? 1.0 : factor;
        }
        return scaled;
    }

private:
    std::array<double, axis_count> values_{};
};

} // namespace millwright::gcode
