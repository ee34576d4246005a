// Lines made from curves on the part, for the layers that draw them.
#pragma once

#include "core/geometry/parametric_surface.h"
#include "ui/render/line_drawer.h"
#include "ui/viewport/internal/layer.h"

#include <functional>
#include <span>
#include <vector>

namespace millwright::viewport {

/// The surface over the straight way from `a` to `b` in the parameters: `steps` + 1 points.
[[nodiscard]] std::vector<Vec3>
on_surface(const geometry::ParametricSurface& patch, const Vec2& a, const Vec2& b, int steps);

/// Where the tip really goes during a move of `shown`: at least `steps` + 1 points, and more where the axes
/// turn far.
[[nodiscard]] std::vector<Vec3>
actual_tips(const plan::CuttingSetup& cutting_setup, const plan::Evaluation& shown, int move, int steps);

/// So many steps for each of `curves` curves that they look smooth, and that all together stay quick to draw.
[[nodiscard]] int smooth_steps(int curves);

/// Adds a polyline as segments, each end with `color` and `value`.
void append(std::vector<render::LineVertex>& vertices,
            std::span<const Vec3> points,
            const glm::vec4& color = glm::vec4(1.0F),
            float value = 0.0F);

[[nodiscard]] glm::vec4 with_opacity(const glm::vec3& color, float opacity);

/// The moves of a path as one buffer of segments of which any stretch of moves can be drawn alone.
class PathLines {
public:
    struct Move {
        std::vector<Vec3> points; ///< empty: not drawn
        float value = 0.0F;
        bool dashed = false; ///< every other step left out
    };

    PathLines() = default;
    PathLines(int move_count, const std::function<Move(int)>& make);

    [[nodiscard]] const render::LineBuffer& buffer() const { return buffer_; }
    /// Segments before `fraction` of `move`; moves before the first and after the last count as the ends.
    [[nodiscard]] int segments_until(int move, double fraction) const;
    [[nodiscard]] int segment_count() const { return buffer_.segment_count(); }

private:
    render::LineBuffer buffer_;
    std::vector<int> first_; ///< segment with which each move begins, and the count of all
};

/// One move alone, thick, over everything that lies at the same place.
void draw_move(const Canvas& canvas,
               const PathLines& lines,
               std::optional<int> move,
               render::LineStyle style,
               const render::View& view);

/// The width of lines along the tracks of `shown`, px: thinner than usual where the tracks lie so close in
/// the picture that they would run together.
[[nodiscard]] float track_width_px(const plan::Evaluation* shown, const Canvas& canvas);

/// The segments of `lines` that are done at `now`; all of them without it and before the path begins, when a
/// person wants to see the whole.
[[nodiscard]] int segments_done(const PathLines& lines, const std::optional<Moment>& now);

} // namespace millwright::viewport
