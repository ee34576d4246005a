#include "ui/viewport/internal/layer.h"

#include "ui/viewport/internal/curves.h"

#include <glm/ext/matrix_transform.hpp>

#include <algorithm>

namespace millwright::viewport {

namespace {

constexpr float seam_px = 1.0F;    // at each side
constexpr float seam_share = 0.4F; // of the line's width, at most
constexpr float seam_opacity = 0.65F;
constexpr double least_scale = 0.5; // never further than half way to the eye

} // namespace

render::View nearer(const Canvas& canvas, double length) {
    render::View view = canvas.view;
    if (is_empty(canvas.content)) {
        return view;
    }
    if (view.projection[3][3] > 0.5) {
        view.view[3][2] += length;
        return view;
    }
    // Seen from the eye, a smaller scene nearer by looks the same.
    const double distance = -(view.view * glm::dvec4(center(canvas.content), 1.0)).z;
    const double scale = distance > 0.0 ? std::max(1.0 - length / distance, least_scale) : 1.0;
    view.view = glm::scale(glm::dmat4(1.0), glm::dvec3(scale)) * view.view;
    return view;
}

void draw_seamed(const Canvas& canvas,
                 const render::LineBuffer& lines,
                 const render::LineStyle& style,
                 const render::View& view) {
    render::LineStyle seam = style;
    seam.coloring.from = render::ColorFrom::style;
    seam.coloring.color = {canvas.colors.wire, seam_opacity};
    seam.width_px = style.width_px + 2.0F * std::min(seam_px, seam_share * style.width_px);
    seam.depth = render::Depth::ghost;
    canvas.painter.lines(lines, seam, view);
    canvas.painter.lines(lines, style, view);
}

void draw_rings(const Canvas& canvas,
                const render::PointBuffer& points,
                float size,
                float ring,
                const glm::vec3& color,
                float inside) {
    canvas.painter.points(points,
                          {.coloring = {.color = with_opacity(color, inside)},
                           .model = canvas.s_T_w,
                           .size_px = size,
                           .ring_px = ring,
                           .ring_color = with_opacity(color, 1.0F),
                           .depth = render::Depth::ghost},
                          canvas.view);
}

} // namespace millwright::viewport
