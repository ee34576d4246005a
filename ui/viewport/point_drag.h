// Dragging control points with the mouse: the points follow the mouse in the plane through the grabbed one
// across the line of sight, or along an axis of the workpiece. Positions in workpiece coordinates, mm.
#pragma once

#include "ui/render/view.h"
#include "ui/viewport/events.h"

#include <optional>
#include <vector>

namespace millwright::viewport {

/// Along an axis of the workpiece: 0 x, 1 y, 2 z.
using HeldAxis = std::optional<int>;

/// What is held down while dragging.
struct DragKeys {
    HeldAxis axis;     ///< nothing: in the screen plane
    bool fine = false; ///< a tenth of the way from here on
    bool snap = false; ///< the grabbed point goes to round coordinates, where it moves
};

inline constexpr double fine_factor = 0.1;

/// The step of round coordinates for the eye: 1, 2, 5 times a power of ten mm, about eight pixels at
/// `point_s`.
[[nodiscard]] double snap_step(const render::View& view, const Vec3& point_s);

class PointDrag {
public:
    /// `points` are where they are now; the button went down at `pixel` on `points[grabbed]`. `shares`: what
    /// each takes of its way, in each coordinate; empty: all of it.
    PointDrag(std::vector<MovedControlPoint> points,
              std::size_t grabbed,
              const Frame& s_T_w,
              const glm::dvec2& pixel,
              std::vector<Vec3> shares = {});

    /// The mouse is at `pixel` now. Another axis counts from the beginning of the drag.
    void move_to(const render::View& view, const glm::dvec2& pixel, const DragKeys& keys);

    /// All points by their shares of the way.
    [[nodiscard]] std::vector<MovedControlPoint> points() const;
    [[nodiscard]] const std::vector<MovedControlPoint>& start() const { return start_; }
    [[nodiscard]] const MovedControlPoint& grabbed() const { return start_[grabbed_]; }
    /// What the grabbed point has moved by.
    [[nodiscard]] const Vec3& moved() const { return moved_; }
    [[nodiscard]] const HeldAxis& axis() const { return axis_; }

private:
    /// Where a line of sight puts the grabbed point.
    [[nodiscard]] std::optional<Vec3> place(const render::View& view, const glm::dvec2& pixel) const;
    [[nodiscard]] Vec3 snapped(const render::View& view) const;

    std::vector<MovedControlPoint> start_;
    std::vector<Vec3> shares_; ///< one per point
    std::size_t grabbed_ = 0;
    Frame s_T_w_;
    glm::dvec2 start_pixel_{};
    glm::dvec2 last_pixel_{};
    HeldAxis axis_;
    Vec3 way_ = Vec3::Zero(); ///< without rounding
    Vec3 moved_ = Vec3::Zero();
};

} // namespace millwright::viewport
