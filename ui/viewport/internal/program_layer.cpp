// The path of an opened program, and the tool on it.

#include "core/base/error.h"
#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"
#include "ui/viewport/internal/path_buffers.h"
#include "ui/viewport/internal/tool_mark.h"

#include <algorithm>

namespace millwright::viewport {

namespace {

constexpr float rapid_opacity = 0.55F;
constexpr float current_width_px = 3.0F;

std::array<glm::vec4, render::path_kinds>
kind_colors(const glm::vec3& feed, const glm::vec3& rapid, const glm::vec3& probe) {
    return {glm::vec4(0.0F),
            with_opacity(rapid, rapid_opacity),
            with_opacity(feed, 1.0F),
            with_opacity(probe, 1.0F)};
}

class ProgramLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        unfinished_ = false;
        if (!scene.opened) {
            path_.clear();
            return;
        }
        tool_.prepare();
        unfinished_ = !path_.follow(scene.opened->path.chunks);
        if (scene.opened_now != at_) {
            at_ = scene.opened_now;
            current_ = at_ ? lines_of(scene.opened->path, at_->first, at_->end) : render::LineBuffer();
        }
    }

    [[nodiscard]] bool unfinished() const override { return unfinished_; }

    [[nodiscard]] std::vector<glm::dvec3> outline(const Scene& scene) const override {
        if (!scene.opened || scene.opened->path.empty() || scene.plot) { // a plot tells where it lies itself
            return {};
        }
        return moved_corners(scene.opened->path.bounds(), scene_from_workpiece(scene));
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (!scene.opened) {
            return;
        }
        if (scene.layers.path.intended && !scene.plot) { // a plot has its own colours
            draw_path(scene, canvas);
        }
        if (canvas.highlight.path_point) {
            const std::int64_t point = *canvas.highlight.path_point;
            draw_thick(canvas, lines_of(scene.opened->path, point, point + 1), canvas.colors.accent);
        }
        if (scene.opened_now) {
            draw_thick(canvas, current_, canvas.colors.selected);
            const bool has_its_own = scene.layers.machine.bodies && scene.opened->machine;
            if (scene.layers.machine.tool && !has_its_own && !scene.table_tip) {
                tool_.draw(canvas, scene.opened_now->tip, scene.opened_now->axis);
            }
        }
    }

private:
    static render::LineBuffer lines_of(const gcode::PreviewPath& path, std::int64_t first, std::int64_t end) {
        constexpr std::int64_t most_pieces = 4000; // one step of a program may be a long spline
        std::vector<render::LineVertex> vertices;
        for (std::int64_t n = std::max<std::int64_t>(first, 1); n < std::min(end, first + most_pieces); ++n) {
            const std::array<Vec3, 2> piece{path.point(n - 1).position(), path.point(n).position()};
            append(vertices, piece);
        }
        return {vertices, render::LineTopology::segments};
    }

    void draw_path(const Scene& scene, const Canvas& canvas) const {
        const render::ViewColors& colors = canvas.colors;
        render::PathStyle style;
        style.color = kind_colors(colors.path, colors.rapid, colors.warning);
        style.done_color = kind_colors(colors.selected, colors.rapid, colors.selected);
        style.model = canvas.s_T_w;
        const bool moving = canvas.edges == render::Edges::rough || !scene.opened->finished;
        const std::int64_t done =
            scene.opened_now && scene.layers.path.trace ? scene.opened_now->place.point - 1 : 0;
        path_.draw(scene, canvas, style, moving, done);
    }

    static void draw_thick(const Canvas& canvas, const render::LineBuffer& lines, const glm::vec3& color) {
        draw_seamed(canvas,
                    lines,
                    {.coloring = {.color = with_opacity(color, 1.0F)},
                     .model = canvas.s_T_w,
                     .width_px = current_width_px},
                    canvas.view);
    }

    PathBuffers path_;
    std::optional<ProgramMoment> at_;
    render::LineBuffer current_; ///< the step at `at_`
    ToolMark tool_;
    bool unfinished_ = false;
};

} // namespace

std::unique_ptr<Layer> make_program_layer() {
    return std::make_unique<ProgramLayer>();
}

} // namespace millwright::viewport
