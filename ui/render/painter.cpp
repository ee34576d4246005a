#include "ui/render/painter.h"

#include "ui/render/internal/draw_state.h"
#include "ui/render/internal/gl.h"

namespace millwright::render {

Painter::Painter()
    : background_(shader_source("background.vert"), shader_source("background.frag")),
      maps_(color_map_texture()) {}

void Painter::background(const ViewColors& colors) const {
    glDepthMask(GL_TRUE);
    glClear(GL_DEPTH_BUFFER_BIT | GL_STENCIL_BUFFER_BIT);
    glDisable(GL_DEPTH_TEST);
    glDisable(GL_BLEND);
    background_.use();
    background_.set("top", colors.background_top);
    background_.set("bottom", colors.background_bottom);
    glBindVertexArray(nothing_.id());
    glDrawArrays(GL_TRIANGLES, 0, 3);
    glBindVertexArray(0);
}

void Painter::mesh(const MeshBuffer& buffer, const MeshStyle& style, const View& view) const {
    mesh_.draw(buffer, style, view, maps_);
}

void Painter::lines(const LineBuffer& buffer, const LineStyle& style, const View& view) const {
    line_.draw(buffer, style, view, maps_);
}

void Painter::path(const PathBuffer& buffer,
                   std::span<const std::uint16_t> indices,
                   const PathStyle& style,
                   const View& view) const {
    path_.draw(buffer, indices, style, view);
}

void Painter::points(const PointBuffer& buffer, const PointStyle& style, const View& view) const {
    point_.draw(buffer, style, view, maps_);
}

} // namespace millwright::render
