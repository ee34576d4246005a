#include "core/plot/picture/internal/square_pixels.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace millwright::plot::internal {

Picture with_rows(const Picture& picture, int rows) {
    Picture result = picture;
    result.height = rows;
    result.gray.assign(static_cast<std::size_t>(rows) * static_cast<std::size_t>(picture.width), 0);
    const double step = static_cast<double>(picture.height) / rows;
    std::vector<double> sums(static_cast<std::size_t>(picture.width));
    for (int row = 0; row < rows; ++row) {
        std::ranges::fill(sums, 0.0);
        const double from = row * step;
        const double to = std::min<double>(from + step, picture.height);
        for (int n = static_cast<int>(from); n < picture.height && n < to; ++n) {
            const double share = std::min(to, n + 1.0) - std::max<double>(from, n);
            for (int column = 0; column < picture.width; ++column) {
                sums[static_cast<std::size_t>(column)] += share * picture.at(n, column);
            }
        }
        for (std::size_t column = 0; column < sums.size(); ++column) {
            result.gray[static_cast<std::size_t>(row) * sums.size() + column] =
                static_cast<std::uint16_t>(std::clamp(std::round(sums[column] / (to - from)), 0.0, 65535.0));
        }
    }
    return result;
}

} // namespace millwright::plot::internal
