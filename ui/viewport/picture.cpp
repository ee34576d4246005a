#include "ui/viewport/picture.h"

#include "core/base/error.h"
#include "ui/render/camera.h"
#include "ui/render/framebuffer.h"
#include "ui/viewport/internal/axis_gizmo.h"
#include "ui/viewport/internal/desk.h"
#include "ui/viewport/internal/legends.h"
#include "ui/viewport/internal/overlay.h"
#include "ui/viewport/internal/sheet.h"
#include "ui/viewport/internal/view_notes.h"
#include "ui/viewport/machine_sight.h"
#include "ui/viewport/picture_facts.h"
#include "ui/viewport/scene_view.h"

#include <algorithm>
#include <array>
#include <memory>
#include <string>
#include <utility>

namespace millwright::viewport {

namespace {

using project::GridMethod;
using render::PixelSize;

constexpr double machine_moment = 0.4; // of the path: where a machine is shown

/// One 3D picture on the sheet.
struct Part {
    Scene scene;
    std::string caption;
};

Moment moment_at(const plan::Evaluation& shown, double share) {
    const auto& positions = shown.axes.positions;
    const auto at = static_cast<std::size_t>(share * static_cast<double>(positions.size() - 1));
    return {.axes = positions[at], .move = static_cast<int>(at), .fraction = 0.0};
}

std::vector<Part> parts_of(const project::Project& project,
                           const plan::Plan& plan,
                           ViewKind kind,
                           const MachineSolids& machine_solids) {
    Part part = {.scene = scene_of(project, plan, kind), .caption = {}};
    part.scene.machine_solids = machine_solids;
    if (kind == ViewKind::machine && part.scene.shown && !part.scene.shown->axes.positions.empty()) {
        part.scene.now = moment_at(*part.scene.shown, machine_moment);
    }
    if (kind == ViewKind::produced) {
        if (std::string note = produced_note(part.scene); !note.empty()) {
            throw Error(std::move(note), {}, "use --view toolpath or --view error to draw this path");
        }
        part.caption = "Produced";
        Part designed = {.scene = part.scene, .caption = "Designed"};
        designed.scene.layers.design.surface = designed.scene.layers.design.lines = true;
        designed.scene.layers.design.produced = false;
        return {designed, part};
    }
    const bool compared = kind == ViewKind::grid || kind == ViewKind::error;
    if (!compared || !part.scene.start || part.scene.start == part.scene.shown) {
        return {part};
    }
    // Before and after, both in the colours of what was before.
    part.caption = program_title(project);
    Part before = {.scene = part.scene, .caption = std::string(title(GridMethod::uniform))};
    before.scene.shown = part.scene.start;
    part.scene.error.high = before.scene.error.high = error_colors(before.scene, {}).high;
    return {before, part};
}

/// Space in perspective, planes without.
render::Camera camera_from(render::StandardView side) {
    const render::Camera camera = render::Camera().seen_from(side);
    const bool plane = side != render::StandardView::iso && side != render::StandardView::oblique;
    return plane ? camera.with(render::Projection::orthographic) : camera;
}

/// A part on the sheet with what it is drawn by.
class DrawnPart {
public:
    DrawnPart(Part part,
              render::StandardView side,
              const widgets::Rect& place,
              const widgets::Rect& free,
              double scale)
        : part_(std::move(part)), place_(place) {
        scene_.update(part_.scene);
        picker_.follow(part_.scene.surface);
        const render::Camera seen = camera_from(side);
        const bool in_machine = part_.scene.layers.machine.bodies && side == render::StandardView::iso;
        const render::Camera turned = in_machine ? part_in_sight(part_.scene, seen) : seen;
        camera_ = turned.fitted(scene_.outline(), render::aspect(pixel_size(free)));
        view_ = framed(camera_, place, free, scene_.depth_range(), scale);
    }

    void draw(widgets::Ui& ui, const render::ViewColors& colors) {
        target_.begin(view_.size);
        scene_.draw(view_, colors, {});
        target_.end();
        ImGui::SetCursorScreenPos({place_.x, place_.y});
        render::show(target_, {place_.w, place_.h});
        const Pane pane = {.rect = place_, .view = view_, .colors = colors};
        draw_labels(ui, pane, visible_labels(scene_, part_.scene, picker_, pane));
        draw_caption(ui, pane, {}, view_notes(part_.scene, view_));
    }

    [[nodiscard]] Pane pane(const widgets::Rect& free, const render::ViewColors& colors) const {
        return {.rect = free, .view = view_, .colors = colors};
    }
    [[nodiscard]] const Part& part() const { return part_; }
    [[nodiscard]] const render::Camera& camera() const { return camera_; }

private:
    Part part_;
    widgets::Rect place_;
    SceneView scene_;
    SurfacePicker picker_;
    render::ViewTarget target_;
    render::Camera camera_;
    render::View view_;
};

} // namespace

void show_plan(Scene& scene, const plan::Plan& plan) {
    scene.surface = plan.surface;
    scene.trims = plan.trims;
    scene.cutting_setup = plan.cutting_setup;
    scene.singular_points = plan.singular_points;
    scene.weight = plan.weight;
}

Scene scene_of(const project::Project& project, const plan::Plan& plan, ViewKind kind) {
    const auto& chosen = plan.program_path(project);
    Scene scene;
    scene.layers = layers_of(kind);
    show_plan(scene, plan);
    scene.shown = chosen ? chosen : plan.grid(GridMethod::uniform).evaluation;
    scene.start = plan.grid(GridMethod::uniform).evaluation;
    scene.cut = plan.cut;
    return scene;
}

render::Picture render_view(const project::Project& project,
                            const plan::Plan& plan,
                            ViewKind kind,
                            const PixelSize& size,
                            render::Theme theme,
                            const MachineSolids& machine_solids,
                            const PictureLook& look) {
    expects(size.width > 0 && size.height > 0, "a picture has an area");
    const PictureFacts facts = picture_facts(project, plan, kind);
    std::vector<Part> parts = parts_of(project, plan, kind, machine_solids);
    for (Part& part : parts) {
        part.scene.colors = look.colors;
    }
    const bool has_legend = parts.front().scene.layers.path.errors && parts.front().scene.shown;
    const Sheet sheet = sheet_for(size, static_cast<int>(parts.size()), facts, has_legend);
    const render::ViewColors colors = render::view_colors(theme, look.colors);
    Desk desk(size, sheet.scale, theme);
    std::vector<std::unique_ptr<DrawnPart>> drawn;
    for (std::size_t k = 0; k < parts.size(); ++k) {
        drawn.push_back(std::make_unique<DrawnPart>(
            parts[k], look.side, sheet.parts[k].place, sheet.parts[k].free, sheet.line_scale));
    }
    return desk.picture([&](widgets::Ui& ui) {
        for (std::size_t k = 0; k < drawn.size(); ++k) {
            const auto scope = ui.scope("part" + std::to_string(k));
            drawn[k]->draw(ui, colors);
            draw_part_caption(ui, sheet, k, parts[k].caption);
        }
        draw_sheet(ui, sheet, facts);
        if (sheet.details) {
            const Pane first = drawn.front()->pane(sheet.signs, colors);
            draw_scale_bar(ui, first, drawn.front()->camera().pose().target);
            const Scene& last = parts.back().scene;
            const Scene& first_scene = parts.front().scene; // the same one where nothing is compared
            draw_legends(ui, upright_legends(ui, sheet.signs, last), colors, last, &first_scene);
            (void)axis_gizmo(ui, drawn.back()->pane(sheet.signs, colors));
        }
    });
}

} // namespace millwright::viewport
