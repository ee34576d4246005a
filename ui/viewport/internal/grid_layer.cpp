// The grid on the surface: tracks, the lines across them, nodes; of a fine grid as many lines as stay apart
// in the picture. The grid it began with can lie below, dim.

#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/grid_lines.h"
#include "ui/viewport/internal/layers.h"

#include <algorithm>
#include <optional>
#include <utility>

namespace millwright::viewport {

namespace {

constexpr int most_nodes_marked = 2500; // more would cover the surface

struct GridBuffers {
    render::LineBuffer tracks;
    render::LineBuffer across;
    render::PointBuffer nodes;
};

/// Of 1, 2, 5 ... the first that divides `each` and leaves no more edges than can be drawn quickly: where
/// lines are left out, their own pieces may be longer, but still meet the others at the nodes.
int nodes_per_piece(int each, std::size_t lines, int nodes) {
    constexpr std::size_t most_edges = 40000; // of one direction
    for (const int step : {1, 2, 5, 10, 20, 50, 100, 200, 500}) {
        const bool quick = lines * static_cast<std::size_t>(nodes / step) <= most_edges;
        if (step >= each || (each % step == 0 && quick)) {
            return std::min(step, each);
        }
    }
    return each;
}

/// The lines through the nodes `node(line, place)`, of the lines and of the places at each.
template <class NodeAt>
render::LineBuffer make_lines(const geometry::ParametricSurface& patch,
                              const std::vector<int>& lines,
                              const std::vector<int>& places,
                              const NodeAt& node) {
    std::vector<render::LineVertex> vertices;
    const int steps = smooth_steps(static_cast<int>(2 * lines.size() * places.size()));
    for (const int line : lines) {
        for (std::size_t n = 0; n + 1 < places.size(); ++n) {
            append(vertices, on_surface(patch, node(line, places[n]), node(line, places[n + 1]), steps));
        }
    }
    return {vertices, render::LineTopology::segments};
}

render::PointBuffer make_marks(const grid::NodeArray& nodes, const geometry::ParametricSurface& patch) {
    if (nodes.nodes.size() > most_nodes_marked) {
        return {};
    }
    std::vector<render::PointVertex> points;
    for (const Vec2& node : nodes.nodes) {
        points.push_back({.position = render::to_float(patch.position(node.x(), node.y()))});
    }
    return render::PointBuffer(points);
}

GridBuffers make_grid_buffers(const grid::NodeArray& nodes,
                              const plan::CuttingSetup& cutting_setup,
                              const GridLines& shown) {
    const std::vector<int> rows = line_numbers(nodes.rows, shown.each_row);
    const std::vector<int> columns = line_numbers(nodes.columns, shown.each_column);
    const int down = nodes_per_piece(shown.each_row, columns.size(), nodes.rows);
    const int across = nodes_per_piece(shown.each_column, rows.size(), nodes.columns);
    const geometry::ParametricSurface& patch = cutting_setup.patch;
    render::LineBuffer along_u = make_lines(
        patch, columns, line_numbers(nodes.rows, down), [&](int j, int i) { return nodes.at(i, j); });
    render::LineBuffer along_v = make_lines(
        patch, rows, line_numbers(nodes.columns, across), [&](int i, int j) { return nodes.at(i, j); });
    const bool tracks_along_u = cutting_setup.direction == grid::TrackDirection::along_u;
    return {.tracks = std::move(tracks_along_u ? along_u : along_v),
            .across = std::move(tracks_along_u ? along_v : along_u),
            .nodes = shown.all() ? make_marks(nodes, patch) : render::PointBuffer()};
}

/// A grid of the scene with the results that it came from.
class ShownGrid {
public:
    void update(std::shared_ptr<const void> owner,
                const grid::NodeArray* nodes,
                const std::shared_ptr<const plan::CuttingSetup>& cutting_setup) {
        if (owner == owner_ && cutting_setup == cutting_setup_) {
            return;
        }
        owner_ = std::move(owner);
        cutting_setup_ = cutting_setup;
        nodes_ = cutting_setup ? nodes : nullptr;
        made_for_.reset();
        buffers_ = {};
    }

    /// With as many lines as the picture has room for.
    [[nodiscard]] const GridBuffers& buffers(const Canvas& canvas) const {
        if (nodes_ == nullptr) {
            return buffers_;
        }
        const GridLines wanted =
            readable_lines(*nodes_, cutting_setup_->patch, canvas.view, glm::dmat4(canvas.s_T_w));
        if (made_for_ != wanted) {
            buffers_ = make_grid_buffers(*nodes_, *cutting_setup_, wanted);
            made_for_ = wanted;
        }
        return buffers_;
    }

private:
    std::shared_ptr<const void> owner_; ///< of the nodes
    std::shared_ptr<const plan::CuttingSetup> cutting_setup_;
    const grid::NodeArray* nodes_ = nullptr;
    // Only the picture tells how many lines there are to be.
    mutable GridBuffers buffers_;
    mutable std::optional<GridLines> made_for_;
};

class GridLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        if (scene.layers.grid.shown && scene.watched) {
            grid_.update(scene.watched, &scene.watched->current, scene.cutting_setup);
        } else if (scene.layers.grid.shown) {
            follow(grid_, scene.shown, scene.cutting_setup);
        }
        if (scene.layers.grid.start) {
            follow(start_, scene.start, scene.cutting_setup);
        }
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        const render::ViewColors& colors = canvas.colors;
        if (scene.layers.grid.start) {
            const GridBuffers& start = start_.buffers(canvas);
            const glm::vec4 dim = with_opacity(colors.net, 0.45F);
            draw_lines(canvas, start.across, dim, 1.0F);
            draw_lines(canvas, start.tracks, dim, 1.0F);
        }
        if (scene.layers.grid.shown) {
            // The dark end of a colour map would swallow dark lines.
            const bool is_plain = surface_colors(scene) == SurfaceColors::plain;
            const glm::vec3 line = is_plain ? colors.wire : colors.handle;
            const GridBuffers& grid_lines = grid_.buffers(canvas);
            const float opacity = is_plain ? 0.95F : 0.6F; // light lines look thicker
            const bool tracks_along_u =
                scene.cutting_setup && scene.cutting_setup->direction == grid::TrackDirection::along_u;
            const auto& of_u = colors.chosen.of(render::LayerColor::grid_u);
            const auto& of_v = colors.chosen.of(render::LayerColor::grid_v);
            const glm::vec3 across = (tracks_along_u ? of_v : of_u).value_or(line);
            const glm::vec3 tracks = (tracks_along_u ? of_u : of_v).value_or(line);
            draw_lines(canvas, grid_lines.across, with_opacity(across, 0.55F * opacity), 1.0F);
            draw_lines(canvas, grid_lines.tracks, with_opacity(tracks, opacity), is_plain ? 1.8F : 1.2F);
            canvas.painter.points(grid_lines.nodes,
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
                       const std::shared_ptr<const plan::Evaluation>& evaluation,
                       const std::shared_ptr<const plan::CuttingSetup>& cutting_setup) {
        grid.update(evaluation, evaluation ? &evaluation->outcome.grid.array() : nullptr, cutting_setup);
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
