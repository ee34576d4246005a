// What every layer of the 3D view is: something that follows the scene and draws itself.
#pragma once

#include "ui/render/convert.h"
#include "ui/render/painter.h"
#include "ui/viewport/scene_view.h"

#include <vector>

namespace millwright::viewport {

/// Where and how a layer draws.
struct Canvas {
    const render::Painter& painter;
    const render::View& view;
    const render::ViewColors& colors;
    glm::mat4 s_T_w{1.0F};  ///< workpiece to scene
    render::Bounds content; ///< of everything that is shown, in scene coordinates
    Highlight highlight;
    render::Edges edges = render::Edges::smooth;
};

/// The same picture with everything `length` nearer to the eye: what lies that far under a surface is then
/// drawn over it, while what is on its far side stays hidden.
[[nodiscard]] render::View nearer(const Canvas& canvas, double length);

/// Lines with a dark or light seam, so that any colour stands out from any ground.
void draw_seamed(const Canvas& canvas,
                 const render::LineBuffer& lines,
                 const render::LineStyle& style,
                 const render::View& view);

/// Marks of `size` pixels with a ring of `ring` around them, seen through what hides them; `inside`: their
/// opacity.
void draw_rings(const Canvas& canvas,
                const render::PointBuffer& points,
                float size,
                float ring,
                const glm::vec3& color,
                float inside);

class Layer {
public:
    Layer() = default;
    Layer(const Layer&) = delete;
    Layer& operator=(const Layer&) = delete;
    virtual ~Layer() = default;

    /// Makes buffers anew where the results that are shown are others.
    virtual void update(const Scene& scene) = 0;
    virtual void draw(const Scene& scene, const Canvas& canvas) const = 0;

    /// Points that a view of everything has to hold, in scene coordinates.
    [[nodiscard]] virtual std::vector<glm::dvec3> outline(const Scene&) const { return {}; }
    /// The last update() left something for the next.
    [[nodiscard]] virtual bool unfinished() const { return false; }
    [[nodiscard]] virtual std::vector<Label> labels(const Scene&, const Canvas&) const { return {}; }
};

} // namespace millwright::viewport
