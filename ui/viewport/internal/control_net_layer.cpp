// The control net: handles and the lines between neighbours. What lies behind the surface shows through, so
// that every handle can be found.

#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"

#include <algorithm>

namespace millwright::viewport {

namespace {

constexpr float handle_px = 9.0F;
constexpr float selected_px = 12.0F;
constexpr float hovered_px = 14.0F;
constexpr float hidden_net_opacity = 0.35F; // where the surface is in front

void append_net(const geometry::ControlNet& net, std::vector<render::LineVertex>& vertices) {
    for (int i = 0; i < net.rows; ++i) {
        for (int j = 0; j < net.columns; ++j) {
            if (i + 1 < net.rows) {
                append(vertices, std::array{net.point(i, j), net.point(i + 1, j)});
            }
            if (j + 1 < net.columns) {
                append(vertices, std::array{net.point(i, j), net.point(i, j + 1)});
            }
        }
    }
}

class ControlNetLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        if (scene.surface == surface_ && scene.selected == selected_) {
            return;
        }
        surface_ = scene.surface;
        selected_ = scene.selected;
        std::vector<render::LineVertex> lines;
        std::vector<render::PointVertex> points;
        outline_.clear();
        for (int p = 0; surface_ && p < surface_->patch_count(); ++p) {
            const geometry::ControlNet& net = surface_->patches()[static_cast<std::size_t>(p)].net();
            append_net(net, lines);
            append_points(net, geometry::PatchId{p}, points);
        }
        lines_ = render::LineBuffer(lines, render::LineTopology::segments);
        points_ = render::PointBuffer(points);
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (!scene.layers.design.control_net || !surface_) {
            return;
        }
        draw_lines(canvas, render::Depth::overlay, 0.5F * hidden_net_opacity);
        draw_lines(canvas, render::Depth::tested, 0.85F);
        draw_points(canvas, points_, style(canvas, render::Depth::overlay, hidden_net_opacity));
        draw_points(canvas, points_, style(canvas, render::Depth::tested, 1.0F));
        if (canvas.highlight.point) {
            draw_hovered(canvas, *canvas.highlight.point);
        }
    }

    [[nodiscard]] std::vector<glm::dvec3> outline(const Scene& scene) const override {
        return scene.layers.design.control_net ? moved(outline_, scene_from_workpiece(scene))
                                               : std::vector<glm::dvec3>{};
    }

private:
    void append_points(const geometry::ControlNet& net,
                       geometry::PatchId patch,
                       std::vector<render::PointVertex>& points) {
        for (int i = 0; i < net.rows; ++i) {
            for (int j = 0; j < net.columns; ++j) {
                const ControlPointId id = {.patch = patch, .i = i, .j = j};
                const bool selected = std::ranges::binary_search(selected_, id);
                points.push_back(
                    {.position = render::to_float(net.point(i, j)), .selected = selected ? 1.0F : 0.0F});
                outline_.push_back(net.point(i, j));
            }
        }
    }

    static render::PointStyle style(const Canvas& canvas, render::Depth depth, float opacity) {
        const render::ViewColors& colors = canvas.colors;
        return {.coloring = {.color = with_opacity(colors.handle, 1.0F), .opacity = opacity},
                .model = canvas.s_T_w,
                .size_px = handle_px,
                .ring_px = 1.5F,
                .ring_color = with_opacity(colors.background_bottom, opacity),
                .selected_size_px = selected_px,
                .selected_color = with_opacity(colors.selected, opacity),
                .depth = depth};
    }

    void draw_lines(const Canvas& canvas, render::Depth depth, float opacity) const {
        canvas.painter.lines(lines_,
                             {.coloring = {.color = with_opacity(canvas.colors.net, opacity)},
                              .model = canvas.s_T_w,
                              .width_px = 1.3F,
                              .depth = depth},
                             canvas.view);
    }

    static void
    draw_points(const Canvas& canvas, const render::PointBuffer& points, const render::PointStyle& style) {
        canvas.painter.points(points, style, canvas.view);
    }

    void draw_hovered(const Canvas& canvas, const ControlPointId& id) const {
        const auto patch = static_cast<int>(id.patch);
        if (patch >= surface_->patch_count()) {
            return;
        }
        const geometry::ControlNet& net = surface_->patch(id.patch).net();
        if (id.i >= net.rows || id.j >= net.columns) {
            return;
        }
        const render::PointVertex point = {.position = render::to_float(net.point(id.i, id.j))};
        render::PointStyle hovered = style(canvas, render::Depth::overlay, 1.0F);
        hovered.size_px = hovered_px;
        hovered.ring_px = 3.0F;
        hovered.ring_color = with_opacity(canvas.colors.accent, 1.0F);
        if (std::ranges::binary_search(selected_, id)) {
            hovered.coloring.color = with_opacity(canvas.colors.selected, 1.0F);
        }
        draw_points(canvas, render::PointBuffer(std::span(&point, 1)), hovered);
    }

    std::shared_ptr<const geometry::Surface> surface_;
    std::vector<ControlPointId> selected_;
    render::LineBuffer lines_;
    render::PointBuffer points_;
    std::vector<Vec3> outline_;
};

} // namespace

std::unique_ptr<Layer> make_control_net_layer() {
    return std::make_unique<ControlNetLayer>();
}

} // namespace millwright::viewport
