// The grid on the surface: tracks, the lines across them, nodes. The grid it began with can lie below, dim.

#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"

namespace millwright::viewport {

namespace {

constexpr int most_nodes_marked = 2500; // more would cover the surface

struct GridBuffers {
    render::LineBuffer tracks;
    render::LineBuffer across;
    render::PointBuffer nodes;
};

void append_edge(std::vector<render::LineVertex>& lines,
                 const geometry::BezierPatch& patch,
                 const Vec2& a,
                 const Vec2& b,
                 int steps) {
    append(lines, on_surface(patch, a, b, steps));
}

GridBuffers make_buffers(const grid::NodeArray& nodes, const project::Workpiece& workpiece) {
    std::vector<render::LineVertex> along_u;
    std::vector<render::LineVertex> along_v;
    std::vector<render::PointVertex> points;
    const geometry::BezierPatch& patch = workpiece.patch;
    const int steps = smooth_steps(2 * nodes.rows * nodes.columns);
    for (int i = 0; i < nodes.rows; ++i) {
        for (int j = 0; j < nodes.columns; ++j) {
            const Vec2& node = nodes.at(i, j);
            points.push_back({.position = render::to_float(patch.position(node.x(), node.y()))});
            if (i + 1 < nodes.rows) {
                append_edge(along_u, patch, node, nodes.at(i + 1, j), steps);
            }
            if (j + 1 < nodes.columns) {
                append_edge(along_v, patch, node, nodes.at(i, j + 1), steps);
            }
        }
    }
    const bool tracks_along_u = workpiece.direction == grid::TrackDirection::along_u;
    const render::LineTopology segments = render::LineTopology::segments;
    return {.tracks = render::LineBuffer(tracks_along_u ? along_u : along_v, segments),
            .across = render::LineBuffer(tracks_along_u ? along_v : along_u, segments),
            .nodes =
                points.size() <= most_nodes_marked ? render::PointBuffer(points) : render::PointBuffer()};
}

/// A grid of the scene with the results that it came from.
class ShownGrid {
public:
    void update(std::shared_ptr<const void> owner,
                const grid::NodeArray* nodes,
                const std::shared_ptr<const project::Workpiece>& workpiece) {
        if (owner == owner_ && workpiece == workpiece_) {
            return;
        }
        owner_ = std::move(owner);
        workpiece_ = workpiece;
        buffers_ = nodes != nullptr && workpiece ? make_buffers(*nodes, *workpiece) : GridBuffers{};
    }

    [[nodiscard]] const GridBuffers& buffers() const { return buffers_; }

private:
    std::shared_ptr<const void> owner_;
    std::shared_ptr<const project::Workpiece> workpiece_;
    GridBuffers buffers_;
};

class GridLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        if (scene.layers.grid && scene.watched) {
            grid_.update(scene.watched, &scene.watched->current, scene.workpiece);
        } else if (scene.layers.grid) {
            follow(grid_, scene.shown, scene.workpiece);
        }
        if (scene.layers.start_grid) {
            follow(start_, scene.start, scene.workpiece);
        }
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        const render::ViewColors& colors = canvas.colors;
        if (scene.layers.start_grid) {
            const glm::vec4 dim = with_opacity(colors.net, 0.45F);
            draw_lines(canvas, start_.buffers().across, dim, 1.0F);
            draw_lines(canvas, start_.buffers().tracks, dim, 1.0F);
        }
        if (scene.layers.grid) {
            // The dark end of a colour map would swallow dark lines.
            const bool is_plain = surface_colors(scene) == SurfaceColors::plain;
            const glm::vec3 line = is_plain ? colors.wire : colors.handle;
            const float opacity = is_plain ? 0.95F : 0.6F; // light lines look thicker
            draw_lines(canvas, grid_.buffers().across, with_opacity(line, 0.55F * opacity), 1.0F);
            draw_lines(canvas, grid_.buffers().tracks, with_opacity(line, opacity), is_plain ? 1.8F : 1.2F);
            canvas.painter.points(grid_.buffers().nodes,
                                  {.coloring = {.color = with_opacity(colors.handle, 1.0F)},
                                   .model = canvas.s_T_w,
                                   .size_px = 5.0F,
                                   .ring_px = 1.2F,
                                   .ring_color = with_opacity(colors.wire, 1.0F)},
                                  canvas.view);
        }
    }

private:
    static void follow(ShownGrid& grid,
                       const std::shared_ptr<const project::Evaluation>& evaluation,
                       const std::shared_ptr<const project::Workpiece>& workpiece) {
        grid.update(evaluation, evaluation ? &evaluation->outcome.grid.array() : nullptr, workpiece);
    }

    static void
    draw_lines(const Canvas& canvas, const render::LineBuffer& lines, const glm::vec4& color, float width) {
        canvas.painter.lines(
            lines, {.coloring = {.color = color}, .model = canvas.s_T_w, .width_px = width}, canvas.view);
    }

    ShownGrid grid_;
    ShownGrid start_;
};

} // namespace

std::unique_ptr<Layer> make_grid_layer() {
    return std::make_unique<GridLayer>();
}

} // namespace millwright::viewport
