#include "ui/render/color_map.h"

#include "core/base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace millwright::render {

namespace {

using Table = std::array<std::uint32_t, 16>;

constexpr Table viridis_table = {0x440154,
                                 0x481a6c,
                                 0x472f7d,
                                 0x414487,
                                 0x39568c,
                                 0x31688e,
                                 0x2a788e,
                                 0x23888e,
                                 0x1f988b,
                                 0x22a884,
                                 0x35b779,
                                 0x54c568,
                                 0x7ad151,
                                 0xa5db36,
                                 0xd2e21b,
                                 0xfde725};

constexpr Table cividis_table = {0x00224e,
                                 0x002e6c,
                                 0x1e3a6f,
                                 0x35456c,
                                 0x47516c,
                                 0x575d6d,
                                 0x666970,
                                 0x757575,
                                 0x848279,
                                 0x948e77,
                                 0xa59c74,
                                 0xb7a96e,
                                 0xc8b866,
                                 0xdbc75a,
                                 0xeed649,
                                 0xfee838};

// The transfer curve of IEC 61966-2-1.
double to_linear(double encoded) {
    return encoded <= 0.04045 ? encoded / 12.92 : std::pow((encoded + 0.055) / 1.055, 2.4);
}

double to_encoded(double linear) {
    return linear <= 0.0031308 ? 12.92 * linear : 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

double channel(std::uint32_t color, int index) {
    const std::uint32_t byte = (color >> (16U - 8U * static_cast<unsigned>(index))) & 0xffU;
    return byte / 255.0;
}

const Table& table(ColorMap map) {
    return map == ColorMap::viridis ? viridis_table : cividis_table;
}

} // namespace

std::string_view name(ColorMap map) {
    return map == ColorMap::viridis ? "viridis" : "cividis";
}

glm::vec3 sample(ColorMap map, double t) {
    expects(!std::isnan(t), "the argument of a colour map is a number");
    const Table& colors = table(map);
    const double place = std::clamp(t, 0.0, 1.0) * static_cast<double>(colors.size() - 1);
    const std::size_t below = std::min(static_cast<std::size_t>(place), colors.size() - 2);
    const double fraction = place - static_cast<double>(below);
    glm::vec3 color{};
    for (int i = 0; i < 3; ++i) {
        const double a = to_linear(channel(colors[below], i));
        const double b = to_linear(channel(colors[below + 1], i));
        color[i] = static_cast<float>(to_encoded((1.0 - fraction) * a + fraction * b));
    }
    return color;
}

double luminance(const glm::vec3& color) {
    const double r = to_linear(static_cast<double>(color.r));
    const double g = to_linear(static_cast<double>(color.g));
    const double b = to_linear(static_cast<double>(color.b));
    return 0.2126 * r + 0.7152 * g + 0.0722 * b;
}

double contrast(const glm::vec3& a, const glm::vec3& b) {
    const double lighter = std::max(luminance(a), luminance(b));
    const double darker = std::min(luminance(a), luminance(b));
    return (lighter + 0.05) / (darker + 0.05);
}

glm::vec3 color_of(const ColorScale& scale, double value) {
    if (scale.limit && value > *scale.limit) {
        return scale.over_limit;
    }
    return sample(scale.map, scale.high > scale.low ? (value - scale.low) / (scale.high - scale.low) : 0.0);
}

} // namespace millwright::render
