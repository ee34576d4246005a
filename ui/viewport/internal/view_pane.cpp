#include "ui/viewport/internal/view_pane.h"

#include "core/arm/arm_forward.h"
#include "ui/render/convert.h"
#include "ui/render/imgui_compat.h"
#include "ui/viewport/internal/axis_gizmo.h"
#include "ui/viewport/internal/legends.h"
#include "ui/viewport/internal/view_controls.h"
#include "ui/viewport/internal/view_notes.h"
#include "ui/viewport/machine_sight.h"
#include "ui/viewport/navigation.h"
#include "ui/widgets/canvas.h"

#include <glm/geometric.hpp>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::viewport {

namespace {

using render::Key;
using render::StandardView;

constexpr double between_notches_s = 0.2; // of a wheel that is being turned
constexpr float handle_size = 14.0F;      // of a recorded handle, pixels at scale 1
constexpr std::array<std::pair<Key, StandardView>, 8> side_keys = {{{Key::digit_0, StandardView::iso},
                                                                    {Key::digit_1, StandardView::front},
                                                                    {Key::digit_2, StandardView::top},
                                                                    {Key::digit_3, StandardView::right},
                                                                    {Key::digit_4, StandardView::back},
                                                                    {Key::digit_5, StandardView::bottom},
                                                                    {Key::digit_6, StandardView::left},
                                                                    {Key::digit_7, StandardView::oblique}}};

render::PixelSize size_of(const widgets::Rect& rect) {
    return {.width = std::max(static_cast<int>(std::lround(rect.w)), 1),
            .height = std::max(static_cast<int>(std::lround(rect.h)), 1)};
}

DragKeys held_keys(const widgets::Pointer& pointer) {
    DragKeys keys = {.axis = std::nullopt, .fine = pointer.shift, .snap = pointer.ctrl};
    constexpr std::array<Key, 3> axes = {Key::x, Key::y, Key::z};
    for (int k = 0; k < 3; ++k) {
        if (render::key_down(axes[static_cast<std::size_t>(k)])) {
            keys.axis = k;
        }
    }
    return keys;
}

render::Projection other(render::Projection projection) {
    return projection == render::Projection::perspective ? render::Projection::orthographic
                                                         : render::Projection::perspective;
}

std::string handle_id(const ControlPointId& id) {
    const auto patch = static_cast<int>(id.patch);
    const std::string first = patch == 0 ? "" : std::to_string(patch) + ",";
    return "control_point(" + first + std::to_string(id.i) + "," + std::to_string(id.j) + ")";
}

} // namespace

ViewPane::ViewPane(std::string id, std::string caption, StandardView side, render::Projection projection)
    : id_(std::move(id)), caption_(std::move(caption)),
      first_(render::Camera().seen_from(side).with(projection)) {
    sights_.try_emplace(at_, Sight{.camera = first_});
}

void ViewPane::set_camera(const render::Camera& camera) {
    sight() = {.camera = camera, .fitted = true};
}

void ViewPane::look_at(const Scene& scene) {
    at_ = {scene.sight, scene.arm ? 2 : scene.layers.machine.bodies ? 1 : 0};
    sights_.try_emplace(at_, Sight{.camera = first_});
}

void ViewPane::fit_all() {
    for (auto& [key, sight] : sights_) {
        sight.fitted = false;
    }
}

void ViewPane::fit_unturned() {
    for (auto& [key, sight] : sights_) {
        sight.fitted = sight.fitted && sight.camera.pose() != sight.fitted_pose;
    }
}

std::vector<ViewEvent> ViewPane::draw(const Frame3D& frame, const widgets::Rect& place) {
    const render::PixelSize size = size_of(place);
    look_at(frame.scene);
    if (target_.size() != size) {
        target_.begin(size);
        target_.end();
        drawn_.reset();
    }
    const widgets::Canvas canvas =
        widgets::canvas(frame.ui, id_, {place.x, place.y, place.w, place.h}, target_.texture());
    const widgets::Pointer& pointer = canvas.pointer;
    in_use_ = pointer.hovered || pointer.held || pointer.released;
    take_keys(frame.ui, pointer);
    fit_if_needed(frame, place);
    sight().camera = navigated(camera(), pointer, size);

    const Pane pane = {.rect = place, .view = view_of(frame, size), .colors = frame.colors};
    const bool esc = in_use_ && !frame.ui.keys_claimed() && render::key_pressed(Key::escape);
    std::vector<ViewEvent> events = mouse_tool_.follow({.scene = frame.scene,
                                                        .view = pane.view,
                                                        .picker = frame.picker,
                                                        .pointer = pointer,
                                                        .keys = held_keys(pointer),
                                                        .take_back = esc});
    draw_picture(frame, pane.view, pointer);
    if (frame.view.unfinished()) {
        drawn_.reset();
        frame.ui.change_in(0.0);
    }
    draw_over(frame, pane);
    if (mouse_tool_.wants_fit()) {
        fit();
        frame.ui.change_in(0.0);
    }
    return events;
}

void ViewPane::fit_if_needed(const Frame3D& frame, const widgets::Rect& place) {
    if (!(place.w >= 1.0F && place.h >= 1.0F)) {
        return; // later, where there is room
    }
    Sight& sight = this->sight();
    const bool legends = frame.details && frame.legends;
    widgets::Rect free = legends ? legends_of(frame.ui, place, frame.scene).free : place;
    const float left = free.x - place.x, below = place.bottom() - free.bottom();
    const bool legend_has_come = left > sight.left_out + 1.0F || below > sight.below_out + 1.0F;
    const bool resized =
        std::abs(place.w - sight.fitted_size.x) > 1.0F || std::abs(place.h - sight.fitted_size.y) > 1.0F;
    if ((legend_has_come || resized) && sight.camera.pose() == sight.fitted_pose) {
        sight.fitted = false; // one that goes leaves the view as it is: it may be back soon
    }
    if (!sight.fitted && !is_empty(frame.view.content())) {
        if (frame.details) {
            free.w -= view_controls(frame.ui, place, frame.buttons).taken;
        }
        fit_into(frame, place, free);
        sight.left_out = left;
        sight.below_out = below;
        sight.fitted_size = {place.w, place.h};
    }
}

/// The camera looks at the middle of the whole picture, so that it is moved aside by half of what is taken.
void ViewPane::fit_into(const Frame3D& frame, const widgets::Rect& place, const widgets::Rect& free) {
    Sight& sight = this->sight();
    if (frame.scene.layers.machine.bodies &&
        sight.camera.pose().projection == render::Projection::perspective) {
        sight.camera = part_in_sight(frame.scene, sight.camera);
    }
    std::vector<glm::dvec3> outline = frame.view.outline();
    if (frame.also != nullptr) {
        outline.insert(outline.end(), frame.also->outline().begin(), frame.also->outline().end());
    }
    render::CameraPose pose = sight.camera.fitted(outline, render::aspect(size_of(free))).pose();
    pose.distance *= static_cast<double>(place.h / std::max(free.h, 1.0F));
    const widgets::Point from = place.centre(), to = free.centre();
    const glm::dvec2 aside = {static_cast<double>(to.x - from.x), static_cast<double>(to.y - from.y)};
    sight.camera = render::Camera(pose).panned(aside, size_of(place));
    sight.fitted = true;
    sight.fitted_pose = sight.camera.pose();
}

void ViewPane::take_keys(const widgets::Ui& ui, const widgets::Pointer& pointer) {
    if (!pointer.hovered || pointer.held || ui.was_typing() || pointer.ctrl || pointer.alt) {
        return;
    }
    if (render::key_pressed(Key::f) || render::key_pressed(Key::home)) {
        fit();
    }
    for (const auto& [key, side] : side_keys) {
        if (at_.frame != 2 && render::key_pressed(key)) { // an arm's joints have these keys
            sight().camera = camera().seen_from(side);
            fit();
        }
    }
    if (render::key_pressed(Key::p)) {
        set_camera(camera().with(other(camera().pose().projection)));
    }
}

render::View ViewPane::view_of(const Frame3D& frame, const render::PixelSize& size) const {
    return camera().view(size, frame.view.depth_range(), static_cast<double>(frame.ui.look().scale));
}

/// While something moves, smooth edges can wait: they cost three times as much as all the rest.
void ViewPane::draw_picture(const Frame3D& frame, const render::View& view, const widgets::Pointer& pointer) {
    using render::Edges;
    const double time = ImGui::GetTime();
    if (std::abs(pointer.wheel) > 0.0F) {
        wheel_until_ = time + between_notches_s;
    }
    const bool by_hand = pointer.held || time < wheel_until_;
    Drawn now = {.scene = frame.scene,
                 .camera = camera().pose(),
                 .size = view.size,
                 .theme = frame.colors.theme,
                 .highlight = mouse_tool_.highlight()};
    const bool changed = !drawn_ || *drawn_ != now;
    const bool moving = by_hand || changes_;
    if (changed) {
        drawn_ = std::move(now);
        paint(frame, view, moving ? Edges::rough : Edges::smooth);
    } else if (edges_ == Edges::rough && !by_hand) {
        paint(frame, view, Edges::smooth);
    }
    changes_ = changed;
    if (edges_ == Edges::rough && !pointer.held) {
        frame.ui.change_in(std::max(wheel_until_ - time, 0.0)); // to see it smooth
    }
}

void ViewPane::paint(const Frame3D& frame, const render::View& view, render::Edges edges) {
    target_.begin(view.size, edges);
    frame.view.draw(view, frame.colors, drawn_->highlight, edges);
    target_.end();
    edges_ = edges;
}

/// What no words may cover.
std::vector<widgets::Rect> ViewPane::taken_places(const Frame3D& frame, const Pane& pane) const {
    std::vector<widgets::Rect> taken;
    const widgets::Rect words = caption_place(frame.ui, pane, caption_, view_notes(frame.scene, pane.view));
    if (words.w > 0.0F) {
        taken.push_back(words);
    }
    if (!frame.details) {
        return taken;
    }
    const ViewControls controls = view_controls(frame.ui, pane.rect, frame.buttons);
    taken.insert(taken.end(),
                 {controls.axes, controls.buttons, scale_bar_place(frame.ui, pane, camera().pose().target)});
    if (frame.legends) {
        const LegendPlaces legends = legends_of(frame.ui, pane.rect, frame.scene);
        taken.insert(taken.end(), legends.each.begin(), legends.each.end());
    }
    return taken;
}

void ViewPane::draw_over(const Frame3D& frame, const Pane& pane) {
    const std::vector<Label> labels = visible_labels(frame.view, frame.scene, frame.picker, pane);
    int drawn = 0;
    const std::vector<widgets::Rect> taken = taken_places(frame, pane);
    for (const widgets::Rect& words : draw_labels(frame.ui, pane, labels, taken)) {
        frame.ui.record("label_" + std::to_string(drawn++), words);
    }
    draw_surface_tool(frame.ui, pane, frame.scene, frame.picker, mouse_tool_.surface());
    draw_hint(frame.ui, pane, frame.scene, mouse_tool_, taken);
    if (mouse_tool_.box()) {
        draw_box(pane, *mouse_tool_.box());
    }
    draw_caption(frame.ui, pane, caption_, view_notes(frame.scene, pane.view));
    record_handles(frame, pane);
    if (!frame.details) {
        return;
    }
    draw_scale_bar(frame.ui, pane, camera().pose().target);
    if (frame.legends) {
        draw_legends(frame.ui, legends_of(frame.ui, pane.rect, frame.scene), pane.colors, frame.scene);
    }
    if (const auto side = axis_gizmo(frame.ui, pane)) {
        sight().camera = camera().seen_from(*side);
        fit();
        frame.ui.change_in(0.0);
    }
}

/// The tip, the zero of the part, and a place of each link by which it can be taken hold of.
void ViewPane::record_arm(const Frame3D& frame, const Pane& pane) const {
    const ArmScene& scene = *frame.scene.arm;
    const auto record = [&](const std::string& id, const Vec3& point) {
        if (const auto seen = render::project(pane.view, render::to_glm(point))) {
            const float size = frame.ui.px(handle_size);
            frame.ui.record(id,
                            {pane.rect.x + static_cast<float>(seen->pixel.x) - 0.5F * size,
                             pane.rect.y + static_cast<float>(seen->pixel.y) - 0.5F * size,
                             size,
                             size});
        }
    };
    const std::vector<Frame> joints = arm::base_T_joints(scene.look->arm(), scene.joints);
    const Vec3 tip = arm::base_T_tool(scene.look->arm(), scene.joints).translation();
    record("tip", tip);
    if (scene.part) {
        record("part", scene.part->translation());
    }
    for (std::size_t n = 0; n < joints.size(); ++n) {
        const Vec3 end = n + 1 < joints.size() ? Vec3(joints[n + 1].translation()) : tip;
        record("link_" + scene.look->arm().joint(static_cast<int>(n)).name,
               Vec3(0.5 * (joints[n].translation() + end)));
    }
}

void ViewPane::record_handles(const Frame3D& frame, const Pane& pane) const {
    if (frame.scene.arm) {
        return record_arm(frame, pane);
    }
    if (!frame.scene.layers.design.control_net || !frame.scene.surface) {
        return;
    }
    const Frame s_T_w = scene_from_workpiece(frame.scene);
    const float size = frame.ui.px(handle_size);
    for (int p = 0; p < frame.scene.surface->patch_count(); ++p) {
        const geometry::ControlNet& net = frame.scene.surface->patch(geometry::PatchId{p}).net();
        for (int k = 0; k < net.rows * net.columns; ++k) {
            const ControlPointId id = {geometry::PatchId{p}, k / net.columns, k % net.columns};
            const auto seen = render::project(pane.view, render::to_glm(s_T_w * net.point(id.i, id.j)));
            if (seen) {
                const float x = pane.rect.x + static_cast<float>(seen->pixel.x) - 0.5F * size;
                const float y = pane.rect.y + static_cast<float>(seen->pixel.y) - 0.5F * size;
                frame.ui.record(handle_id(id), {x, y, size, size});
            }
        }
    }
}

} // namespace millwright::viewport
