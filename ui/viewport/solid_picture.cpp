#include "ui/viewport/solid_picture.h"

#include "core/base/error.h"
#include "ui/render/camera.h"
#include "ui/render/convert.h"
#include "ui/render/framebuffer.h"
#include "ui/render/offscreen_context.h"
#include "ui/render/painter.h"

#include <cstddef>

namespace millwright::viewport {

namespace {

constexpr float full = 255.0F;

glm::vec4 color_of(const std::array<std::uint8_t, 3>& rgb) {
    return {static_cast<float>(rgb[0]) / full,
            static_cast<float>(rgb[1]) / full,
            static_cast<float>(rgb[2]) / full,
            1.0F};
}

/// Each triangle with corners of its own, so that edges stay sharp.
render::MeshBuffer buffer_of(const ColoredSolid& solid) {
    std::vector<render::MeshVertex> vertices;
    std::vector<std::uint32_t> indices;
    vertices.reserve(3 * solid.triangles.size());
    for (const auto& triangle : solid.triangles) {
        const auto corner = [&](std::size_t n) -> const Vec3& {
            return solid.points[static_cast<std::size_t>(triangle[n])];
        };
        const Vec3 normal = (corner(1) - corner(0)).cross(corner(2) - corner(0));
        const double length = normal.norm();
        for (std::size_t n = 0; n < 3; ++n) {
            indices.push_back(static_cast<std::uint32_t>(vertices.size()));
            vertices.push_back(
                {.position = render::to_float(corner(n)),
                 .normal = render::to_float(length > 0.0 ? Vec3(normal / length) : Vec3::UnitZ()),
                 .color = color_of(solid.colors[static_cast<std::size_t>(triangle[n])])});
        }
    }
    return {vertices, indices};
}

} // namespace

render::Picture solid_picture(const ColoredSolid& solid, const render::PixelSize& size, render::Theme theme) {
    expects(!solid.points.empty() && solid.colors.size() == solid.points.size(),
            "a body has points, and a colour for each");
    Box3 box;
    for (const Vec3& point : solid.points) {
        box.extend(point);
    }
    render::OffscreenContext context(size, 1.0);
    context.begin();
    const render::Painter painter;
    const render::MeshBuffer buffer = buffer_of(solid);
    const render::Camera camera = render::Camera()
                                      .seen_from(render::StandardView::iso)
                                      .fitted(render::to_glm(box), render::aspect(size));
    const render::View view = camera.view(size, render::to_glm(box));
    render::ViewTarget target;
    target.begin(size);
    painter.background(render::view_colors(theme, {}));
    painter.mesh(buffer, {.coloring = {.from = render::ColorFrom::vertex}, .closed = solid.closed}, view);
    target.end();
    return target.read();
}

} // namespace millwright::viewport
