// The path of an opened program: millions of pieces, of which each picture shows as many as there is time
// for, those first that matter most on the screen.

#include "core/base/error.h"
#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"
#include "ui/viewport/internal/solids.h"
#include "ui/viewport/program_sight.h"

#include <glm/ext/matrix_transform.hpp>
#include <glm/geometric.hpp>

#include <algorithm>

namespace millwright::viewport {

namespace {

using gcode::PathChunk;
using gcode::PathKind;

constexpr int chunks_an_update = 2; // about 2 ms each without a graphics card
// What takes a processor of 2 GHz about 25 and 100 ms without a graphics card.
constexpr std::size_t points_while_moving = 25'000;
constexpr std::size_t points_at_rest = 100'000;
// Of ten thousand passes from afar most cover each other: drawing them all takes longer than their points.
constexpr double same_while_moving_px = 1.0;
constexpr double tool_share = 0.025; // radius of the tool to that of the path
constexpr float rapid_opacity = 0.55F;
constexpr float current_width_px = 3.0F;

render::PathBuffer buffer_of(const PathChunk& chunk) {
    const glm::vec3 min(chunk.min[0], chunk.min[1], chunk.min[2]);
    const glm::vec3 max(chunk.max[0], chunk.max[1], chunk.max[2]);
    std::vector<render::PathVertex> vertices;
    vertices.reserve(chunk.points.size());
    for (const gcode::PathPoint& point : chunk.points) {
        vertices.push_back(
            render::path_vertex(point.xyz(), static_cast<std::uint16_t>(point.kind()), min, max));
    }
    return {vertices, min, max};
}

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
            buffers_.clear();
            shown_.clear();
            return;
        }
        if (!tool_) {
            tool_.emplace(tool_solid());
        }
        follow_chunks(scene.opened->path.chunks);
        if (scene.opened_now != at_) {
            at_ = scene.opened_now;
            current_ = at_ ? lines_of(scene.opened->path, at_->first, at_->end) : render::LineBuffer();
        }
    }

    [[nodiscard]] bool unfinished() const override { return unfinished_; }

    [[nodiscard]] std::vector<glm::dvec3> outline(const Scene& scene) const override {
        if (!scene.opened || scene.opened->path.empty()) {
            return {};
        }
        return moved_corners(scene.opened->path.bounds(), scene_from_workpiece(scene));
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        if (!scene.opened) {
            return;
        }
        if (scene.layers.toolpath) {
            draw_path(scene, canvas);
        }
        if (canvas.highlight.path_point) {
            const std::int64_t point = *canvas.highlight.path_point;
            draw_thick(canvas, lines_of(scene.opened->path, point, point + 1), canvas.colors.accent);
        }
        if (scene.opened_now) {
            draw_thick(canvas, current_, canvas.colors.selected);
            const bool has_its_own = scene.layers.machine && scene.opened->machine;
            if (scene.layers.tool && !has_its_own) {
                draw_tool(*scene.opened_now, canvas);
            }
        }
    }

private:
    /// A stretch of the same program only grows; of another one, or read again, every chunk is another.
    void follow_chunks(const std::vector<std::shared_ptr<const PathChunk>>& chunks) {
        const auto [ours, theirs] = std::mismatch(shown_.begin(), shown_.end(), chunks.begin(), chunks.end());
        const auto kept = static_cast<std::size_t>(ours - shown_.begin());
        shown_.resize(kept);
        buffers_.resize(kept);
        for (auto next = theirs; next != chunks.end(); ++next) {
            if (next - theirs == chunks_an_update) {
                unfinished_ = true;
                return;
            }
            shown_.push_back(*next);
            buffers_.push_back(buffer_of(**next));
        }
    }

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
        const auto chosen = pieces_in_sight(shown_,
                                            path_view(canvas.view, scene),
                                            moving ? points_while_moving : points_at_rest,
                                            moving ? same_while_moving_px : 0.0);
        const std::int64_t done =
            scene.opened_now && scene.layers.trace ? scene.opened_now->place.point - 1 : 0;
        for (std::size_t k = 0; k < shown_.size(); ++k) {
            style.done = static_cast<int>(
                std::clamp<std::int64_t>(done - shown_[k]->first, -1, PathChunk::most_points));
            canvas.painter.path(buffers_[k], chosen[k], style, canvas.view);
        }
    }

    static void draw_thick(const Canvas& canvas, const render::LineBuffer& lines, const glm::vec3& color) {
        draw_seamed(canvas,
                    lines,
                    {.coloring = {.color = with_opacity(color, 1.0F)},
                     .model = canvas.s_T_w,
                     .width_px = current_width_px},
                    canvas.view);
    }

    void draw_tool(const ProgramMoment& now, const Canvas& canvas) const {
        Frame placed = Frame::Identity();
        placed.linear() = frame_along(now.axis);
        placed.translation() = now.tip;
        const auto size = static_cast<float>(tool_share * radius(canvas.content));
        const glm::mat4 model = canvas.s_T_w * glm::mat4(render::to_glm(placed));
        tool_->draw(canvas, glm::scale(model, glm::vec3(size)), canvas.colors.tool);
    }

    std::vector<std::shared_ptr<const PathChunk>> shown_;
    std::vector<render::PathBuffer> buffers_; ///< of `shown_`
    std::optional<ProgramMoment> at_;
    render::LineBuffer current_; ///< the step at `at_`
    std::optional<SolidBuffers> tool_;
    bool unfinished_ = false;
};

} // namespace

std::unique_ptr<Layer> make_program_layer() {
    return std::make_unique<ProgramLayer>();
}

} // namespace millwright::viewport
