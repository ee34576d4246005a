#include "ui/viewport/surface_mouse_tool.h"

#include "core/base/units.h"
#include "ui/render/convert.h"
#include "ui/viewport/internal/pointer_pixel.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>

namespace millwright::viewport {

namespace {

using widgets::MouseButton;

constexpr double corner_reach_px = 9.0; // at scale 1
constexpr double dabs_per_radius = 4.0; // as far apart as those of a stroke (core/grid/weight_mix.h)
constexpr int places_on_ring = 64;
constexpr int chords_per_side = 16;

/// How far from `from` along `way` in the parameters [0,1]^2 end.
double room(const Vec2& from, const Vec2& way) {
    double most = 1e9;
    for (const Eigen::Index k : {0, 1}) {
        if (way[k] > 0.0) {
            most = std::min(most, (1.0 - from[k]) / way[k]);
        } else if (way[k] < 0.0) {
            most = std::min(most, -from[k] / way[k]);
        }
    }
    return std::max(most, 0.0);
}

} // namespace

void SurfaceMouseTool::leave() {
    at_.reset();
    if (!dragging_) {
        corner_.reset();
    }
}

std::vector<ViewEvent> SurfaceMouseTool::follow(const SurfaceMouseToolInput& input) {
    std::vector<ViewEvent> events;
    leave();
    if (input.hit && input.hit->patch == input.scene.surface_tool.patch) {
        at_ = input.hit->uv;
    }
    if (input.take_back) {
        if (works()) {
            finish(DragStage::cancelled, events);
        } else if (input.scene.surface_tool.kind == SurfaceToolKind::outline) {
            events.emplace_back(DropOutline{});
        }
        return events;
    }
    if (works() && input.pointer.held != MouseButton::left && input.pointer.released != MouseButton::left) {
        finish(DragStage::finished, events); // let go somewhere else
    }
    if (input.scene.surface_tool.kind == SurfaceToolKind::brush) {
        paint(input, events);
    } else {
        draw_outline(input, events);
    }
    return events;
}

void SurfaceMouseTool::finish(DragStage stage, std::vector<ViewEvent>& events) {
    if (last_) {
        events.emplace_back(PaintSurface{.stage = stage});
    } else if (dragging_) {
        events.emplace_back(MoveOutlineCorner{.stage = stage});
    }
    last_.reset();
    dragging_ = false;
}

void SurfaceMouseTool::paint(const SurfaceMouseToolInput& input, std::vector<ViewEvent>& events) {
    if (input.pointer.pressed == MouseButton::left && at_) {
        last_ = at_;
        events.emplace_back(PaintSurface{*at_, *at_, DragStage::going_on});
    } else if (last_ && input.pointer.held == MouseButton::left && at_) {
        const geometry::ParametricSurface& patch = worked_surface(input.scene);
        const double way =
            (patch.position(at_->x(), at_->y()) - patch.position(last_->x(), last_->y())).norm();
        if (way * dabs_per_radius >= input.scene.surface_tool.radius_mm) {
            events.emplace_back(PaintSurface{*last_, *at_, DragStage::going_on});
            last_ = at_;
        }
    }
    if (last_ && input.pointer.released == MouseButton::left) {
        finish(DragStage::finished, events);
    }
}

void SurfaceMouseTool::draw_outline(const SurfaceMouseToolInput& input, std::vector<ViewEvent>& events) {
    if (!dragging_ && input.pointer.hovered) {
        corner_ = pick_corner(
            input.scene, input.view, pixel_of(input.pointer), corner_reach_px * input.view.content_scale);
    }
    if (input.pointer.pressed == MouseButton::left) {
        press_outline(input, events);
    }
    if (dragging_ && input.pointer.held == MouseButton::left && at_) {
        events.emplace_back(MoveOutlineCorner{*corner_, *at_, DragStage::going_on});
    }
    if (dragging_ && input.pointer.released == MouseButton::left) {
        finish(DragStage::finished, events);
    }
}

/// Of an open outline the first corner closes it.
void SurfaceMouseTool::press_outline(const SurfaceMouseToolInput& input, std::vector<ViewEvent>& events) {
    const SurfaceTool& tool = input.scene.surface_tool;
    if (corner_ && !tool.closed && *corner_ == 0) {
        events.emplace_back(CloseOutline{});
    } else if (corner_) {
        dragging_ = true;
    } else if (at_) {
        events.emplace_back(AddOutlineCorner{*at_});
    }
}

std::optional<int>
pick_corner(const Scene& scene, const render::View& view, const glm::dvec2& pixel, double within_px) {
    const Frame s_T_w = scene_from_workpiece(scene);
    std::optional<int> found;
    double nearest = within_px;
    for (std::size_t k = 0; k < scene.surface_tool.outline.size(); ++k) {
        const Vec2& uv = scene.surface_tool.outline[k];
        const Vec3 place = s_T_w * worked_surface(scene).position(uv.x(), uv.y());
        if (const auto seen = render::project(view, render::to_glm(place))) {
            const double away = glm::length(seen->pixel - pixel);
            if (away <= nearest) {
                nearest = away;
                found = static_cast<int>(k);
            }
        }
    }
    return found;
}

std::vector<Vec3> ring_on(const geometry::ParametricSurface& patch, const Vec2& uv, double radius) {
    constexpr int corrections = 6;
    const geometry::SurfaceDerivatives d = patch.derivatives(uv.x(), uv.y());
    const Vec3 middle = patch.position(uv.x(), uv.y());
    std::vector<Vec3> ring;
    for (int k = 0; k <= places_on_ring; ++k) {
        const double turn = 2.0 * pi * k / places_on_ring;
        const double stretch_u = d.du.norm() > 0.0 ? 1.0 / d.du.norm() : 1.0;
        const double stretch_v = d.dv.norm() > 0.0 ? 1.0 / d.dv.norm() : 1.0;
        const Vec2 way(std::cos(turn) * stretch_u, std::sin(turn) * stretch_v);
        const double most = room(uv, way);
        double length = std::min(radius, most);
        Vec3 there = middle;
        for (int n = 0; n < corrections; ++n) {
            const Vec2 at = uv + length * way;
            there = patch.position(std::clamp(at.x(), 0.0, 1.0), std::clamp(at.y(), 0.0, 1.0));
            const double away = (there - middle).norm();
            if (!(away > 0.0)) {
                break;
            }
            length = std::min(length * radius / away, most);
        }
        ring.push_back(there);
    }
    return ring;
}

std::vector<Vec3>
outline_on(const geometry::ParametricSurface& patch, const std::vector<Vec2>& corners, bool closed) {
    std::vector<Vec3> places;
    const std::size_t sides =
        closed ? corners.size() : corners.size() - std::min<std::size_t>(1, corners.size());
    for (std::size_t k = 0; k < sides; ++k) {
        const Vec2& a = corners[k];
        const Vec2& b = corners[(k + 1) % corners.size()];
        for (int n = 0; n <= chords_per_side; ++n) {
            const Vec2 uv = a + static_cast<double>(n) / chords_per_side * (b - a);
            places.push_back(patch.position(uv.x(), uv.y()));
        }
    }
    return places;
}

} // namespace millwright::viewport
