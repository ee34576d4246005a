#include "ui/render/point_drawer.h"

#include "ui/render/internal/draw_state.h"
#include "ui/render/internal/gl.h"

#include <cstddef>

namespace millwright::render {

PointBuffer::PointBuffer(std::span<const PointVertex> points) : count_(static_cast<int>(points.size())) {
    if (points.empty()) {
        return;
    }
    vertices_ = Buffer(std::as_bytes(points));
    constexpr std::ptrdiff_t stride = sizeof(PointVertex);
    layout_.emplace();
    layout_->attach(vertices_, {0, 3, stride, offsetof(PointVertex, position), true});
    layout_->attach(vertices_, {1, 4, stride, offsetof(PointVertex, color), true});
    layout_->attach(vertices_, {2, 1, stride, offsetof(PointVertex, value), true});
    layout_->attach(vertices_, {3, 1, stride, offsetof(PointVertex, selected), true});
}

PointDrawer::PointDrawer() : program_(shader_source("point.vert"), shader_source("point.frag")) {}

void PointDrawer::draw(const PointBuffer& buffer,
                       const PointStyle& style,
                       const View& view,
                       const Texture& maps) const {
    if (buffer.count() == 0) {
        return;
    }
    const auto scale = static_cast<float>(view.content_scale);
    program_.use();
    set_view(program_, view, style.model);
    set_coloring(program_, style.coloring, maps);
    program_.set("radius_px", 0.5F * scale * style.size_px);
    program_.set("selected_radius_px", 0.5F * scale * style.selected_size_px);
    program_.set("ring_px", scale * style.ring_px);
    program_.set("ring_color", style.ring_color);
    program_.set("selected_color", style.selected_color);
    glBindVertexArray(buffer.vertex_array());
    const int count = buffer.count();
    draw_smooth(program_, style.depth, [count] { glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count); });
    glBindVertexArray(0);
}

} // namespace millwright::render
