// Heights at the middles of square pixels. Lengths mm; z = 0 is the top of the work, up is positive.
#pragma once

#include "core/geometry/vectors.h"
#include "core/plot/picture/picture.h"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace millwright::plot {

/// Pixel (row i from the top, column j) is at x = j pitch, y = (rows - 1 - i) pitch, as in the KMITL thesis
/// of 2006.
struct HeightField {
    int columns = 0;
    int rows = 0;
    double pitch = 1.0;
    std::vector<float> z;       ///< rows from the top, each from the left
    Vec2 corner = Vec2::Zero(); ///< where the lower left pixel lies in the drawing

    [[nodiscard]] std::span<const float> row(int i) const {
        const auto width = static_cast<std::size_t>(columns);
        return std::span(z).subspan(static_cast<std::size_t>(i) * width, width);
    }
    [[nodiscard]] double y_of_row(double i) const { return (rows - 1 - i) * pitch; }
};

/// The brightness that stays at the top, as PictureSettings::ground of a relief.
inline constexpr std::uint16_t relief_top = 0;

/// z = -depth G / white: bright is deep, as in plates that are looked at against the light; a picture that
/// was inverted while it was read makes bright high. Throws Error unless pitch and depth are above 0 and
/// finite.
[[nodiscard]] HeightField height_field(const Picture& picture, double pitch, double depth);

/// Whether any of it lies below the top: else a relief of it cuts nothing.
[[nodiscard]] bool is_cut(const HeightField& field);

} // namespace millwright::plot
