// The intended tool path on the surface: cutting moves in tracks, the moves between tracks dashed, an arrow
// in the middle of each track, start and end. While stepping, what is still to come is dim.

#include "ui/viewport/internal/curves.h"
#include "ui/viewport/internal/layers.h"

#include <algorithm>

namespace millwright::viewport {

namespace {

constexpr float remaining_path_opacity = 0.5F;
constexpr std::ptrdiff_t most_arrows = 10;
constexpr double arrow_share = 0.45; // of the move's length
constexpr double hair_share = 0.05;  // of the part's diagonal

using toolpath::MoveKind;
using toolpath::PathPoint;

int move_count(const toolpath::Toolpath& path) {
    return std::max(static_cast<int>(path.points.size()) - 1, 0);
}

const PathPoint& end_of(const toolpath::Toolpath& path, int move) {
    return path.points[static_cast<std::size_t>(move) + 1];
}

std::vector<Vec3>
move_points(const geometry::ParametricSurface& patch, const toolpath::Toolpath& path, int move, int steps) {
    return on_surface(
        patch, path.points[static_cast<std::size_t>(move)].origin.uv, end_of(path, move).origin.uv, steps);
}

PathLines
lines_of(const geometry::ParametricSurface& patch, const toolpath::Toolpath& path, MoveKind kind, int steps) {
    return PathLines(move_count(path), [&](int move) -> PathLines::Move {
        if (end_of(path, move).reached_by != kind) {
            return {};
        }
        return {.points = move_points(patch, path, move, steps), .dashed = kind == MoveKind::cross};
    });
}

/// Two barbs at the middle of a move, lying on the surface.
void append_arrow(std::vector<render::LineVertex>& lines,
                  const geometry::ParametricSurface& patch,
                  const PathPoint& from,
                  const PathPoint& to) {
    const Vec3 middle = on_surface(patch, from.origin.uv, to.origin.uv, 2)[1];
    const Vec3 along = to.pose.tip - from.pose.tip;
    const Vec3 across = 0.45 * along.cross(from.pose.axis + to.pose.axis).normalized() * along.norm();
    const Vec3 tip = middle + 0.5 * arrow_share * along;
    const Vec3 back = middle - 0.5 * arrow_share * along;
    append(lines, std::array{Vec3(back + arrow_share * across), tip, Vec3(back - arrow_share * across)});
}

/// At most `most_arrows`, on tracks at equal steps.
std::vector<render::LineVertex> arrows(const geometry::ParametricSurface& patch,
                                       const toolpath::Toolpath& path) {
    const auto points = std::ssize(path.points);
    const auto tracks = points - std::ranges::count(path.points, MoveKind::track, &PathPoint::reached_by);
    const auto each = (tracks + most_arrows - 1) / most_arrows;
    std::vector<render::LineVertex> lines;
    int first = 0;
    std::ptrdiff_t track = 0;
    for (int move = 0; move <= move_count(path); ++move) {
        const bool ends = move == move_count(path) || end_of(path, move).reached_by != MoveKind::track;
        if (ends && move > first && track++ % each == 0) {
            const auto middle = static_cast<std::size_t>((first + move) / 2);
            append_arrow(lines, patch, path.points[middle], path.points[middle + 1]);
        }
        first = ends ? move + 1 : first;
    }
    return lines;
}

std::vector<render::LineVertex> hairs(const toolpath::Toolpath& path) {
    Box3 box;
    for (const PathPoint& point : path.points) {
        box.extend(point.pose.tip);
    }
    const double length = hair_share * box.diagonal().norm();
    std::vector<render::LineVertex> lines;
    for (const PathPoint& point : path.points) {
        append(lines, std::array{point.pose.tip, Vec3(point.pose.tip + length * point.pose.axis)});
    }
    return lines;
}

render::PointBuffer one_point(const Vec3& position) {
    const render::PointVertex vertex = {.position = render::to_float(position)};
    return render::PointBuffer(std::span(&vertex, 1));
}

struct Buffers {
    PathLines tracks;
    PathLines crossings;
    render::LineBuffer arrows;
    render::LineBuffer hairs;
    render::PointBuffer begin;
    render::PointBuffer end;
};

Buffers make_toolpath_buffers(const geometry::ParametricSurface& patch, const toolpath::Toolpath& path) {
    if (path.points.empty()) {
        return {};
    }
    const int steps = smooth_steps(move_count(path));
    return {.tracks = lines_of(patch, path, MoveKind::track, steps),
            .crossings = lines_of(patch, path, MoveKind::cross, 2 * steps - 1),
            .arrows = render::LineBuffer(arrows(patch, path), render::LineTopology::segments),
            .hairs = render::LineBuffer(hairs(path), render::LineTopology::segments),
            .begin = one_point(path.points.front().pose.tip),
            .end = one_point(path.points.back().pose.tip)};
}

class ToolpathLayer final : public Layer {
public:
    void update(const Scene& scene) override {
        const bool wanted = scene.layers.path.intended || scene.layers.path.tool_axes;
        if (!wanted || (scene.shown == shown_ && scene.cutting_setup == cutting_setup_)) {
            return;
        }
        shown_ = scene.shown;
        cutting_setup_ = scene.cutting_setup;
        buffers_ = shown_ && cutting_setup_ ? make_toolpath_buffers(cutting_setup_->patch, shown_->toolpath)
                                            : Buffers{};
    }

    void draw(const Scene& scene, const Canvas& canvas) const override {
        const render::ViewColors& colors = canvas.colors;
        const float width = track_width_px(shown_.get(), canvas);
        if (scene.layers.path.tool_axes) {
            draw_lines(canvas, buffers_.hairs, line_style(canvas, colors.tool, 0.5F * width, 0.8F));
        }
        if (!scene.layers.path.intended) {
            return;
        }
        const render::LineStyle style = line_style(canvas, colors.path, width, 1.0F);
        draw_moves(scene, canvas, buffers_.tracks, style);
        draw_move(canvas, buffers_.tracks, canvas.highlight.move, style, canvas.view);
        draw_moves(scene, canvas, buffers_.crossings, line_style(canvas, colors.rapid, 0.6F * width, 0.9F));
        if (scene.layers.machine.bodies) {
            return;
        }
        draw_seamed(canvas, buffers_.arrows, line_style(canvas, colors.path, width, 1.0F), canvas.view);
        draw_end(canvas, buffers_.begin, colors.good);
        draw_end(canvas, buffers_.end, colors.path);
    }

    [[nodiscard]] std::vector<Label> labels(const Scene& scene, const Canvas& canvas) const override {
        if (!scene.layers.path.intended || scene.layers.machine.bodies || !shown_ ||
            shown_->toolpath.points.empty()) {
            return {};
        }
        const auto& points = shown_->toolpath.points;
        return {{render::to_glm(points.front().pose.tip), "start", canvas.colors.good},
                {render::to_glm(points.back().pose.tip), "end", canvas.colors.path}};
    }

private:
    static render::LineStyle
    line_style(const Canvas& canvas, const glm::vec3& color, float width, float opacity) {
        return {
            .coloring = {.color = with_opacity(color, opacity)}, .model = canvas.s_T_w, .width_px = width};
    }

    static void
    draw_lines(const Canvas& canvas, const render::LineBuffer& lines, const render::LineStyle& style) {
        canvas.painter.lines(lines, style, canvas.view);
    }

    static void
    draw_moves(const Scene& scene, const Canvas& canvas, const PathLines& lines, render::LineStyle style) {
        const int done = segments_done(lines, scene.now);
        style.coloring.opacity = remaining_path_opacity;
        style.first = done;
        draw_lines(canvas, lines.buffer(), style);
        style.coloring.opacity = 1.0F;
        style.first = 0;
        style.count = done;
        draw_seamed(canvas, lines.buffer(), style, canvas.view);
    }

    static void draw_end(const Canvas& canvas, const render::PointBuffer& point, const glm::vec3& color) {
        canvas.painter.points(point,
                              {.coloring = {.color = with_opacity(color, 1.0F)},
                               .model = canvas.s_T_w,
                               .size_px = 10.0F,
                               .ring_px = 2.0F,
                               .ring_color = with_opacity(canvas.colors.background_bottom, 1.0F)},
                              canvas.view);
    }

    std::shared_ptr<const plan::Evaluation> shown_;
    std::shared_ptr<const plan::CuttingSetup> cutting_setup_;
    Buffers buffers_;
};

} // namespace

std::unique_ptr<Layer> make_toolpath_layer() {
    return std::make_unique<ToolpathLayer>();
}

} // namespace millwright::viewport
