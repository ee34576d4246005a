#include "ui/viewport/internal/curves.h"

#include "core/kinematics/inverse.h"
#include "core/toolpath/actual_trajectory.h"
#include "ui/render/convert.h"

#include <algorithm>
#include <cmath>

namespace millwright::viewport {

namespace {

constexpr int most_segments = 16000; // about 30 ms without a graphics card
constexpr int smoothest = 8;
constexpr float usual_width_px = 2.2F;
constexpr float thinnest_px = 0.7F;
constexpr double width_to_gap = 0.3;   // of tracks that lie close in the picture
constexpr double turn_per_step = 0.07; // rad; a loop of 180 deg gets 45 steps

} // namespace

std::vector<Vec3>
on_surface(const geometry::ParametricSurface& patch, const Vec2& a, const Vec2& b, int steps) {
    std::vector<Vec3> points;
    points.reserve(static_cast<std::size_t>(steps) + 1);
    for (int k = 0; k <= steps; ++k) {
        const double t = static_cast<double>(k) / steps;
        const Vec2 uv = (1.0 - t) * a + t * b;
        points.push_back(patch.position(uv.x(), uv.y()));
    }
    return points;
}

std::vector<Vec3>
actual_tips(const plan::CuttingSetup& cutting_setup, const plan::Evaluation& shown, int move, int steps) {
    const auto from = static_cast<std::size_t>(move);
    const kinematics::AxisPositions& a = shown.axes.positions[from];
    const kinematics::AxisPositions& b = shown.axes.positions[from + 1];
    const double turn = kinematics::rotary_travel(cutting_setup.machine, a, b);
    const int needed = std::max(steps, static_cast<int>(std::ceil(turn / turn_per_step)));
    std::vector<Vec3> tips;
    for (const geometry::ToolPose& pose : toolpath::actual_poses(cutting_setup.machine, a, b, needed + 1)) {
        tips.push_back(pose.tip);
    }
    return tips;
}

int smooth_steps(int curves) {
    return std::clamp(most_segments / std::max(curves, 1), 1, smoothest);
}

void append(std::vector<render::LineVertex>& vertices,
            std::span<const Vec3> points,
            const glm::vec4& color,
            float value) {
    for (std::size_t k = 0; k + 1 < points.size(); ++k) {
        vertices.push_back({.position = render::to_float(points[k]), .color = color, .value = value});
        vertices.push_back({.position = render::to_float(points[k + 1]), .color = color, .value = value});
    }
}

glm::vec4 with_opacity(const glm::vec3& color, float opacity) {
    return {color, opacity};
}

PathLines::PathLines(int move_count, const std::function<Move(int)>& make) {
    std::vector<render::LineVertex> vertices;
    for (int move = 0; move < move_count; ++move) {
        first_.push_back(static_cast<int>(vertices.size() / 2));
        const Move made = make(move);
        const std::span<const Vec3> points = made.points;
        const std::size_t stride = made.dashed ? 2 : 1;
        for (std::size_t k = 0; k + 1 < points.size(); k += stride) {
            append(vertices, points.subspan(k, 2), glm::vec4(1.0F), made.value);
        }
    }
    first_.push_back(static_cast<int>(vertices.size() / 2));
    buffer_ = render::LineBuffer(vertices, render::LineTopology::segments);
}

int PathLines::segments_until(int move, double fraction) const {
    if (move < 0 || first_.empty()) {
        return 0;
    }
    const auto at = static_cast<std::size_t>(move);
    if (at + 1 >= first_.size()) {
        return first_.back();
    }
    const double inside = fraction * (first_[at + 1] - first_[at]);
    return first_[at] + static_cast<int>(std::floor(inside));
}

void draw_move(const Canvas& canvas,
               const PathLines& lines,
               std::optional<int> move,
               render::LineStyle style,
               const render::View& view) {
    if (!move) {
        return;
    }
    style.first = lines.segments_until(*move, 0.0);
    style.count = lines.segments_until(*move + 1, 0.0) - style.first;
    style.coloring.opacity = 1.0F;
    style.width_px *= 2.0F;
    draw_seamed(canvas, lines.buffer(), style, view);
}

float track_width_px(const plan::Evaluation* shown, const Canvas& canvas) {
    if (shown == nullptr || shown->toolpath.points.empty()) {
        return usual_width_px;
    }
    Box3 box;
    for (const toolpath::PathPoint& point : shown->toolpath.points) {
        box.extend(point.pose.tip);
    }
    const int tracks = shown->outcome.grid.track_count(shown->toolpath.direction);
    const double between =
        box.diagonal().norm() / std::sqrt(2.0) / tracks; // tracks cross a side, not a diagonal
    const glm::dvec3 middle(canvas.s_T_w * glm::vec4(render::to_float(Vec3(box.center())), 1.0F));
    const double px = between / render::pixel_length(canvas.view, middle) / canvas.view.content_scale;
    return std::clamp(static_cast<float>(width_to_gap * px), thinnest_px, usual_width_px);
}

int segments_done(const PathLines& lines, const std::optional<Moment>& now) {
    return now && now->move >= 0 ? lines.segments_until(now->move, now->fraction) : lines.segment_count();
}

} // namespace millwright::viewport
