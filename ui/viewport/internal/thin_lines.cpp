#include "ui/viewport/internal/thin_lines.h"

#include "ui/render/convert.h"

#include <glm/common.hpp>

#include <algorithm>
#include <numeric>

namespace millwright::viewport {

ThinLines::ThinLines(std::span<const Vec3> points, const std::function<int(std::size_t)>& kind) {
    constexpr std::size_t most_points = render::path_restart - 1;
    for (std::size_t first = 0; first + 1 < points.size(); first += most_points - 1) {
        const auto part = points.subspan(first, std::min(most_points, points.size() - first));
        glm::vec3 min = render::to_float(part.front()), max = min;
        for (const Vec3& point : part) {
            min = glm::min(min, render::to_float(point));
            max = glm::max(max, render::to_float(point));
        }
        std::vector<render::PathVertex> vertices;
        for (std::size_t n = 0; n < part.size(); ++n) {
            const glm::vec3 place = render::to_float(part[n]);
            const auto own = static_cast<std::uint16_t>(kind(first + n));
            vertices.push_back(render::path_vertex(&place.x, own, min, max));
        }
        std::vector<std::uint16_t> indices(vertices.size());
        std::iota(indices.begin(), indices.end(), std::uint16_t{0});
        parts_.push_back({render::PathBuffer(vertices, min, max), std::move(indices)});
    }
}

void ThinLines::draw(const Canvas& canvas, const std::array<glm::vec4, render::path_kinds>& colors) const {
    render::PathStyle style;
    style.color = colors;
    for (const Part& part : parts_) {
        canvas.painter.path(part.buffer, part.indices, style, canvas.view);
    }
}

} // namespace millwright::viewport
