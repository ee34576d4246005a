#include "ui/viewport/mouse_tool.h"

#include "ui/viewport/internal/boxes.h"
#include "ui/viewport/internal/pointer_pixel.h"
#include "ui/viewport/navigation.h"
#include "ui/viewport/program_picking.h"
#include "ui/viewport/stock_sight.h"
#include "ui/viewport/symmetric_points.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <limits>

namespace millwright::viewport {

namespace {

using widgets::MouseButton;

// Pixels at scale 1.
constexpr double handle_reach_px = 9.0;
constexpr double move_reach_px = 6.0;
constexpr double click_slack_px = 4.0; // a click may move this far

constexpr std::size_t quickly_looked_at = 100'000; // points of a path, in about 5 ms

constexpr double hidden_share = 0.05; // of the surface's size: further behind it, a move cannot be pointed at

/// What lies before the surface, or beside it.
std::optional<int> face_at(const MouseToolInput& input) {
    const auto& reference = input.scene.reference;
    if (!reference || !input.scene.layers.design.reference) {
        return std::nullopt;
    }
    const render::Ray ray = render::ray(input.view, pixel_of(input.pointer));
    const Frame s_T_w = scene_from_workpiece(input.scene);
    const auto hit = input.picker.hit(ray, s_T_w);
    return pick_face(*reference, ray, s_T_w, hit ? hit->distance : std::numeric_limits<double>::infinity());
}

bool editable(const Scene& scene) {
    return scene.layers.design.control_net && scene.surface;
}

/// A selection may be older than the surface.
bool exists(const geometry::Surface& surface, const ControlPointId& id) {
    const auto patch = static_cast<int>(id.patch);
    if (patch < 0 || patch >= surface.patch_count()) {
        return false;
    }
    const geometry::ControlNet& net = surface.patch(id.patch).net();
    return id.i >= 0 && id.i < net.rows && id.j >= 0 && id.j < net.columns;
}

Vec3 position_of(const geometry::Surface& surface, const ControlPointId& id) {
    return surface.patch(id.patch).net().point(id.i, id.j);
}

/// Sorted, each once, those of the surface only.
std::vector<ControlPointId> tidied(std::vector<ControlPointId> points) {
    std::ranges::sort(points);
    points.erase(std::unique(points.begin(), points.end()), points.end());
    return points;
}

std::vector<ControlPointId> toggled(std::vector<ControlPointId> selected, const ControlPointId& point) {
    const auto found = std::ranges::find(selected, point);
    if (found == selected.end()) {
        selected.push_back(point);
    } else {
        selected.erase(found);
    }
    return tidied(std::move(selected));
}

bool contains(const std::vector<ControlPointId>& points, const ControlPointId& point) {
    return std::ranges::find(points, point) != points.end();
}

/// Where the mouse is on the surface; on joined faces by the parameters of all of them.
std::optional<SurfaceHit> hit_of(const MouseToolInput& input, const Frame& s_T_w) {
    std::optional<SurfaceHit> hit = input.picker.hit(render::ray(input.view, pixel_of(input.pointer)), s_T_w);
    const region::Region* joined = joined_faces(input.scene);
    if (hit && joined != nullptr) {
        hit->uv = joined->nearest(hit->position).parameters;
        hit->patch = geometry::PatchId{0};
    }
    return hit;
}

} // namespace

void MouseTool::leave() {
    highlight_ = {};
    under_mouse_ = {};
    surface_.leave();
}

/// The mouse is on the surface alone.
std::vector<ViewEvent> MouseTool::follow_tool(const MouseToolInput& input) {
    leave();
    const auto hit = input.pointer.hovered || surface_.works()
                         ? hit_of(input, scene_from_workpiece(input.scene))
                         : std::nullopt;
    if (hit) {
        under_mouse_.on_surface = hit->position;
        under_mouse_.uv = hit->uv;
    }
    return surface_.follow({input.scene, input.view, input.pointer, hit, input.take_back});
}

std::vector<ViewEvent> MouseTool::follow_arm(const MouseToolInput& input) {
    std::vector<ViewEvent> events =
        arm_.follow({*input.scene.arm, input.view, input.pointer, input.keys, input.take_back});
    highlight_ = {};
    highlight_.arm = arm_.grip();
    under_mouse_ = {};
    wants_fit_ = arm_.wants_fit();
    return events;
}

std::vector<ViewEvent> MouseTool::follow(const MouseToolInput& input) {
    if (input.scene.arm) {
        return follow_arm(input);
    }
    std::vector<ViewEvent> events;
    wants_fit_ = false;
    if (navigates(input.pointer)) {
        leave();
        return events;
    }
    if (input.scene.surface && input.scene.surface_tool.kind != SurfaceToolKind::none) {
        return follow_tool(input);
    }
    if (drag_ && input.pointer.held != MouseButton::left && input.pointer.released != MouseButton::left) {
        let_go(events); // somewhere else
    }
    if (!drag_ && !box_) {
        point_at(input);
    }
    if (input.pointer.pressed == MouseButton::left) {
        press(input);
    }
    if (pressed_ && input.take_back) {
        take_back(events);
    }
    if (pressed_ && input.pointer.held == MouseButton::left) {
        hold(input, events);
    }
    if (pressed_ && input.pointer.released == MouseButton::left) {
        release(input, events);
    }
    return events;
}

/// What hides what is behind it; its distance, if the mouse is on it.
std::optional<double> MouseTool::point_at_solid(const MouseToolInput& input, const Frame& s_T_w) {
    const render::Ray ray = render::ray(input.view, pixel_of(input.pointer));
    if (shows_stock(input.scene)) {
        const auto hit = pick_stock(*input.scene.stock, ray, s_T_w, input.scene.stock_section);
        if (hit) {
            under_mouse_.on_surface = hit->position;
            under_mouse_.stock_height = hit->height;
        }
        return hit ? std::optional(hit->distance) : std::nullopt;
    }
    const auto hit = hit_of(input, s_T_w);
    if (hit) {
        under_mouse_.on_surface = hit->position;
        under_mouse_.uv = hit->uv;
    }
    return hit ? std::optional(hit->distance) : std::nullopt;
}

void MouseTool::point_at(const MouseToolInput& input) {
    leave();
    move_fraction_.reset();
    if (!input.pointer.hovered) {
        return;
    }
    const Scene& scene = input.scene;
    const Frame s_T_w = scene_from_workpiece(scene);
    const glm::dvec2 pixel = pixel_of(input.pointer);
    const double scale = input.view.content_scale;
    if (scene.opened) {
        const auto place = pick_path(scene.opened->path,
                                     path_view(input.view, scene),
                                     pixel,
                                     move_reach_px * scale,
                                     quickly_looked_at);
        highlight_.path_point = place ? std::optional(place->point) : std::nullopt;
        return;
    }
    const std::optional<double> sight = point_at_solid(input, s_T_w);
    if (editable(scene)) {
        highlight_.point =
            pick_control_point(*scene.surface, s_T_w, input.view, pixel, handle_reach_px * scale);
    }
    if (!highlight_.point) {
        const double size = scene.surface ? scene.surface->control_box().diagonal().norm() : 0.0;
        const auto move =
            pick_move(scene, input.view, pixel, move_reach_px * scale, sight, hidden_share * size);
        if (move) {
            highlight_.move = move->move;
            move_fraction_ = move->fraction;
        }
    }
    under_mouse_.point = highlight_.point;
    under_mouse_.move = highlight_.move;
}

void MouseTool::press(const MouseToolInput& input) {
    pressed_ = Pressed{.pixel = pixel_of(input.pointer), .point = highlight_.point};
    wants_fit_ =
        input.pointer.double_clicked && !highlight_.point && !highlight_.move && !highlight_.path_point;
}

void MouseTool::hold(const MouseToolInput& input, std::vector<ViewEvent>& events) {
    const glm::dvec2 pixel = pixel_of(input.pointer);
    const bool moved = glm::length(pixel - pressed_->pixel) > click_slack_px * input.view.content_scale;
    if (!drag_ && !box_ && moved && editable(input.scene)) {
        if (pressed_->point) {
            begin_drag(input, events); // nothing, if an edit from elsewhere has taken the point away
        } else {
            box_ = Box{.corner = pressed_->pixel, .opposite = pixel};
        }
    }
    if (box_) {
        box_->opposite = pixel;
    }
    if (drag_) {
        const Vec3 before = drag_->moved();
        drag_->move_to(input.view, pixel, input.keys);
        if (drag_->moved() != before) {
            events.emplace_back(MoveControlPoints{.points = drag_->points(), .stage = DragStage::going_on});
        }
    }
}

void MouseTool::begin_drag(const MouseToolInput& input, std::vector<ViewEvent>& events) {
    const Scene& scene = input.scene;
    if (!exists(*scene.surface, *pressed_->point)) {
        return;
    }
    std::vector<ControlPointId> ids = scene.selected;
    if (!contains(ids, *pressed_->point)) {
        ids = {*pressed_->point};
        events.emplace_back(SelectControlPoints{.points = ids});
    }
    std::erase_if(ids, [&](const ControlPointId& id) { return !exists(*scene.surface, id); });
    const auto net_of = [&](geometry::PatchId patch) -> const geometry::ControlNet& {
        return scene.surface->patch(patch).net();
    };
    std::vector<MovedControlPoint> points;
    std::vector<Vec3> shares;
    std::size_t grabbed = 0;
    for (const SharedPoint& shared : with_images(net_of, scene.symmetry, ids, *pressed_->point)) {
        grabbed = shared.id == *pressed_->point ? points.size() : grabbed;
        points.push_back({.id = shared.id, .position = position_of(*scene.surface, shared.id)});
        shares.push_back(shared.share);
    }
    drag_.emplace(
        std::move(points), grabbed, scene_from_workpiece(scene), pressed_->pixel, std::move(shares));
}

void MouseTool::let_go(std::vector<ViewEvent>& events) {
    events.emplace_back(MoveControlPoints{.points = drag_->points(), .stage = DragStage::finished});
    drag_.reset();
    pressed_.reset();
}

void MouseTool::take_back(std::vector<ViewEvent>& events) {
    if (drag_) {
        events.emplace_back(MoveControlPoints{.points = {}, .stage = DragStage::cancelled});
    }
    drag_.reset();
    box_.reset();
    pressed_.reset();
}

void MouseTool::release(const MouseToolInput& input, std::vector<ViewEvent>& events) {
    if (drag_) {
        events.emplace_back(MoveControlPoints{.points = drag_->points(), .stage = DragStage::finished});
    } else if (box_ && editable(input.scene)) {
        std::vector<ControlPointId> found = control_points_in(*input.scene.surface,
                                                              scene_from_workpiece(input.scene),
                                                              input.view,
                                                              box_->corner,
                                                              box_->opposite);
        if (input.pointer.ctrl) {
            found.insert(found.end(), input.scene.selected.begin(), input.scene.selected.end());
        }
        events.emplace_back(SelectControlPoints{.points = tidied(std::move(found))});
    } else if (!box_) {
        click(input, events);
    }
    drag_.reset();
    box_.reset();
    pressed_.reset();
}

void MouseTool::click(const MouseToolInput& input, std::vector<ViewEvent>& events) const {
    const std::vector<ControlPointId>& selected = input.scene.selected;
    if (input.scene.opened) {
        const auto place = pick_path(input.scene.opened->path,
                                     path_view(input.view, input.scene),
                                     pressed_->pixel,
                                     move_reach_px * input.view.content_scale);
        if (place) {
            events.emplace_back(GoToPathPlace{*place});
        }
    } else if (pressed_->point) {
        const ControlPointId point = *pressed_->point;
        events.emplace_back(SelectControlPoints{
            .points = input.pointer.ctrl ? toggled(selected, point) : std::vector<ControlPointId>{point}});
    } else if (highlight_.move) {
        events.emplace_back(GoToMove{.move = *highlight_.move, .fraction = move_fraction_.value_or(0.0)});
    } else if (const auto face = face_at(input)) {
        events.emplace_back(ChooseFace{*face});
    } else if (!selected.empty() && !input.pointer.ctrl) {
        events.emplace_back(SelectControlPoints{});
    }
}

} // namespace millwright::viewport
