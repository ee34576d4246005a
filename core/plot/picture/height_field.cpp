#include "core/plot/picture/height_field.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::plot {

HeightField height_field(const Picture& picture, double pitch, double depth) {
    constexpr double largest = 1e6;
    if (!(pitch > 0.0 && pitch < largest)) {
        throw Error(fmt::format("the pixel width is {} mm, but must be above 0", pitch));
    }
    if (!(depth > 0.0 && depth < largest)) {
        throw Error(fmt::format("the depth is {} mm, but must be above 0", depth));
    }
    HeightField field{picture.width, picture.height, pitch, {}};
    field.z.reserve(picture.gray.size());
    for (const std::uint16_t gray : picture.gray) {
        field.z.push_back(static_cast<float>(-depth * gray / white));
    }
    return field;
}

bool is_cut(const HeightField& field) {
    return std::ranges::any_of(field.z, [](float z) { return z < 0.0F; });
}

} // namespace millwright::plot
