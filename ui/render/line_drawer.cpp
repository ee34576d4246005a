#include "ui/render/line_drawer.h"

#include "core/base/error.h"
#include "ui/render/internal/draw_state.h"
#include "ui/render/internal/gl.h"

#include <algorithm>
#include <cstddef>
#include <vector>

namespace millwright::render {

LineBuffer::LineBuffer(std::span<const LineVertex> vertices, LineTopology topology) : topology_(topology) {
    const int count = static_cast<int>(vertices.size());
    expects(topology == LineTopology::strip || count % 2 == 0, "a segment has two ends");
    segment_count_ = topology == LineTopology::strip ? std::max(count - 1, 0) : count / 2;
    if (segment_count_ > 0) {
        std::vector<LineVertex> padded(vertices.begin(), vertices.end());
        padded.push_back(vertices.back()); // the last segment asks where the line goes on, too
        vertices_ = Buffer(std::as_bytes(std::span(padded)));
        layout_.emplace();
    }
}

GlId LineBuffer::vertex_array_from(int first) const {
    expects(layout_ && first >= 0 && first < segment_count_, "the first segment is one of the buffer's");
    // Instances are segments. OpenGL 3.3 has no first instance, so the attributes start at it instead.
    constexpr std::ptrdiff_t vertex_bytes = sizeof(LineVertex);
    const std::ptrdiff_t stride = topology_ == LineTopology::strip ? vertex_bytes : 2 * vertex_bytes;
    for (unsigned end = 0; end < 2; ++end) {
        const std::ptrdiff_t at = first * stride + end * vertex_bytes;
        const std::ptrdiff_t position = offsetof(LineVertex, position);
        const std::ptrdiff_t color = offsetof(LineVertex, color);
        const std::ptrdiff_t value = offsetof(LineVertex, value);
        layout_->attach(vertices_, {3 * end, 3, stride, at + position, true});
        layout_->attach(vertices_, {3 * end + 1, 4, stride, at + color, true});
        layout_->attach(vertices_, {3 * end + 2, 1, stride, at + value, true});
    }
    const std::ptrdiff_t next = topology_ == LineTopology::strip ? 2 * vertex_bytes : vertex_bytes;
    const std::ptrdiff_t next_position = offsetof(LineVertex, position);
    layout_->attach(vertices_, {6, 3, stride, first * stride + next + next_position, true});
    return layout_->id();
}

LineDrawer::LineDrawer() : program_(shader_source("line.vert"), shader_source("line.frag")) {}

void LineDrawer::draw(const LineBuffer& buffer,
                      const LineStyle& style,
                      const View& view,
                      const Texture& maps) const {
    const int first = std::clamp(style.first, 0, buffer.segment_count());
    const int rest = buffer.segment_count() - first;
    const int count = style.count < 0 ? rest : std::min(style.count, rest);
    if (count == 0) {
        return;
    }
    const auto scale = static_cast<float>(view.content_scale);
    const float width = style.width_px * scale;
    program_.use();
    set_view(program_, view, style.model);
    set_coloring(program_, style.coloring, maps);
    program_.set("half_width", 0.5F * std::max(width, 1.0F));
    program_.set("faintness", std::clamp(width, 0.0F, 1.0F));
    program_.set("dash", scale * glm::vec2(style.dash.on_px, style.dash.off_px));
    program_.set("joined", buffer.topology() == LineTopology::strip ? 1 : 0);
    program_.set("last", count - 1);
    glBindVertexArray(buffer.vertex_array_from(first));
    draw_smooth(program_, style.depth, [count] { glDrawArraysInstanced(GL_TRIANGLE_STRIP, 0, 4, count); });
    glBindVertexArray(0);
}

} // namespace millwright::render
