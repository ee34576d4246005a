#include "core/exchange/cad_file.h"

#include "core/exchange/internal/file_kind.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <string_view>

namespace millwright::exchange {

Vec3 CadFace::position(const Vec2& at) const {
    const int row = std::clamp(static_cast<int>(at.x()), 0, rows - 1);
    const int column = std::clamp(static_cast<int>(at.y()), 0, columns - 1);
    return patches[static_cast<std::size_t>(row * columns + column)].position(at.x() - row, at.y() - column);
}

std::vector<geometry::Trim::Loop> CadFace::loops() const {
    std::vector<geometry::Trim::Loop> all;
    if (trimmed()) {
        all.push_back(outline);
        all.insert(all.end(), holes.begin(), holes.end());
    }
    return all;
}

std::optional<geometry::Trim> CadFace::trim_of(int row, int column) const {
    return trimmed() ? geometry::trim_in_square(loops(), Vec2(row, column)) : geometry::Trim{};
}

geometry::Trim CadFace::trim() const {
    geometry::Trim trim{loops()};
    for (geometry::Trim::Loop& loop : trim.loops) {
        for (Vec2& corner : loop) {
            corner = {corner.x() / rows, corner.y() / columns};
        }
    }
    return trim;
}

geometry::Trim CadFace::bspline_trim() const {
    const std::vector<double> u = geometry::span_ends(bspline.value().knots_u);
    const std::vector<double> v = geometry::span_ends(bspline.value().knots_v);
    const auto within = [](const std::vector<double>& ends, double place) {
        const auto span =
            std::clamp<std::ptrdiff_t>(static_cast<std::ptrdiff_t>(place), 0, std::ssize(ends) - 2);
        const double low = ends[static_cast<std::size_t>(span)],
                     high = ends[static_cast<std::size_t>(span) + 1];
        return std::clamp(low + (place - static_cast<double>(span)) * (high - low), 0.0, 1.0);
    };
    geometry::Trim trim{loops()};
    for (geometry::Trim::Loop& loop : trim.loops) {
        for (Vec2& corner : loop) {
            corner = {within(u, corner.x()), within(v, corner.y())};
        }
    }
    return trim;
}

bool is_cad_file(const std::filesystem::path& file) {
    constexpr std::array<std::string_view, 4> kinds{"step", "stp", "iges", "igs"};
    return std::ranges::find(kinds, kind_of(file)) != kinds.end();
}

} // namespace millwright::exchange
