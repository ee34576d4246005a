#include "ui/design_panels/design_panel.h"

#include "core/base/text.h"
#include "core/geometry/presets.h"
#include "core/project/reshaped_surface.h"
#include "ui/design_panels/import_panel.h"
#include "ui/panels/fields.h"
#include "ui/viewport/symmetric_points.h"
#include "ui/widgets/icons.h"
#include "ui/workspaces/pending_import.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <limits>
#include <utility>

namespace millwright::panels {

namespace {

using geometry::ControlNet;
using viewport::ControlPointId;
using viewport::SharedPoint;

constexpr double farthest = project::farthest_point_mm;

ControlNet& net_of(project::Project& project, const ControlPointId& id) {
    return project.surface.patches[static_cast<std::size_t>(id.patch)];
}
const ControlNet& net_of(const project::Project& project, const ControlPointId& id) {
    return project.surface.patches[static_cast<std::size_t>(id.patch)];
}

/// The points and their images, with what each takes of the way of the first one.
std::vector<SharedPoint> shared_by(const FrameState& now, const std::vector<ControlPointId>& ids) {
    const auto net = [&](geometry::PatchId patch) -> const ControlNet& {
        return now.project.surface.patches[static_cast<std::size_t>(patch)];
    };
    return with_images(net, now.view_state.symmetry, ids, ids.front());
}

/// Moves the first point of `ids` by `by`, the others and the images along.
void move_shared_points(const FrameState& now,
                        ActionQueue& ask,
                        const std::vector<ControlPointId>& ids,
                        const Vec3& by) {
    const std::vector<SharedPoint> points = shared_by(now, ids);
    ask.edit(points.size() == 1 ? "Move a control point"
                                : fmt::format("Move {} control points", points.size()),
             [points, by](project::Project& draft) {
                 for (const SharedPoint& point : points) {
                     net_of(draft, point.id).point(point.id.i, point.id.j) += point.share.cwiseProduct(by);
                 }
                 draft.surface.preset.clear();
             });
}

void set_weights(const FrameState& now,
                 ActionQueue& ask,
                 const std::vector<ControlPointId>& ids,
                 double weight) {
    ask.edit("Change a weight", [points = shared_by(now, ids), weight](project::Project& draft) {
        for (const SharedPoint& point : points) {
            net_of(draft, point.id).weight(point.id.i, point.id.j) = weight;
        }
        draft.surface.preset.clear();
    });
}

/// What is done to one side of the net is done to the other one, too.
void symmetry_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const geometry::NetSymmetry& symmetry = now.view_state.symmetry;
    constexpr const char* tip = "Edits of a control point are mirrored to its counterpart in the net; points "
                                "in the middle stay in the middle";
    if (const auto on = ui.toggle("symmetric_x", "Symmetric in X", symmetry.x, tip)) {
        ask.show([x = *on](actions::ViewState& view_state) { view_state.symmetry.x = x; });
    }
    if (const auto on = ui.toggle("symmetric_y", "Symmetric in Y", symmetry.y, tip)) {
        ask.show([y = *on](actions::ViewState& view_state) { view_state.symmetry.y = y; });
    }
}

std::vector<widgets::Option> preset_options() {
    std::vector<widgets::Option> options{{"own", "Custom shape", {}, "The surface was edited manually", {}}};
    for (const geometry::SurfacePreset& preset : geometry::surface_presets()) {
        options.push_back({preset.id, preset.title, {}, preset.source, {}});
    }
    return options;
}

int preset_index(const std::string& id) {
    const auto presets = geometry::surface_presets();
    for (std::size_t n = 0; n < presets.size(); ++n) {
        if (presets[n].id == id) {
            return static_cast<int>(n) + 1;
        }
    }
    return 0;
}

void set_preset(project::Project& draft, const geometry::SurfacePreset& preset) {
    draft.surface = project::project_from_preset(preset.id).surface;
}

constexpr int weight_column = 3; // of the choices above the table of the net

double number_of(const ControlNet& net, int i, int j, int coordinate) {
    return coordinate == weight_column ? net.weight(i, j) : net.point(i, j)[coordinate];
}

/// What there is to know of a surface whose control points stay as they are.
void draw_face(Ui& ui, const project::FaceInput& face) {
    const auto section = ui.section("face", "Exact face");
    if (!section) {
        return;
    }
    const auto times = [](int a, int b) { return fmt::format("{} x {}", a, b); };
    const auto spans = [](const std::vector<double>& knots) {
        return static_cast<int>(std::ssize(geometry::span_ends(knots))) - 1;
    };
    ui.value("degree", "Degree", times(face.net.degree_u, face.net.degree_v));
    ui.value("spans", "Spans", times(spans(face.net.knots_u), spans(face.net.knots_v)));
    ui.value("points", "Control points", times(face.net.rows, face.net.columns));
    ui.note("A face of a CAD model without a fit. To change control points, import it as patches.");
}

/// Of faces that are machined as one surface, and how they were spread out.
void draw_joined(Ui& ui, const project::JoinedInput& joined, const FrameState& now) {
    const auto section = ui.section("joined", "Joined faces");
    if (!section) {
        return;
    }
    ui.value("count", "Faces", std::to_string(joined.faces.size()));
    if (const auto made = now.plan ? now.plan->plan.joined : nullptr) {
        ui.value("distortion",
                 "Distortion",
                 fixed(made->flattening.distortion, 3),
                 "",
                 "Symmetric Dirichlet energy of the mapping; 1 means none");
        ui.value("boundary_off",
                 "Boundary error",
                 fixed(made->boundary_off, 4),
                 "mm",
                 "Largest distance between the border of the mapping and the boundary of the faces");
    }
    ui.note("Exact faces of a CAD model, machined as one surface. To change control points, import them as "
            "patches.");
}

int decimals_of(int coordinate) {
    return coordinate == weight_column ? 3 : 2;
}

/// As many as have room for their longest number: all of them in a net of usual degrees.
int columns_shown(const Ui& ui, const ControlNet& net, int coordinate) {
    constexpr float digit_px = 9.0F;
    constexpr float border_px = 22.0F; // of a field, and between two
    std::size_t digits = 1;
    for (int i = 0; i < net.rows; ++i) {
        for (int j = 0; j < net.columns; ++j) {
            digits =
                std::max(digits, fixed(number_of(net, i, j, coordinate), decimals_of(coordinate)).size());
        }
    }
    const float field = ui.px(digit_px * static_cast<float>(digits) + border_px);
    return std::clamp(static_cast<int>(ui.rest().w / field), 1, net.columns);
}

} // namespace

void DesignPanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    if (now.import.is_open()) {
        import_panel(ui, now, ask, catalogue_);
        return;
    }
    draw_surface(ui, now, ask);
    if (now.project.surface.joined) {
        draw_joined(ui, *now.project.surface.joined, now);
        return;
    }
    if (now.project.surface.face) {
        draw_face(ui, *now.project.surface.face);
        return;
    }
    patch_.draw(ui, now, ask);
    draw_point(ui, now, ask);
    draw_net(ui, now, ask);
}

void DesignPanel::draw_surface(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto section = ui.section("surface", "Surface");
    if (!section) {
        return;
    }
    const auto options = preset_options();
    if (const auto chosen =
            ui.choice("preset",
                      "Preset",
                      preset_index(now.project.surface.preset),
                      options,
                      "Replace the surface with one from the literature; Undo restores the previous one");
        chosen && *chosen > 0) {
        const geometry::SurfacePreset preset =
            geometry::surface_presets()[static_cast<std::size_t>(*chosen - 1)];
        ask.edit("Load preset " + std::string(preset.title),
                 [preset](project::Project& draft) { set_preset(draft, preset); });
        ask.run("view.fit");
    }
    if (now.project.surface.patches.size() > 1) {
        const widgets::FieldInfo info{"machined",
                                      "Machined patch",
                                      "",
                                      "Patch that the toolpath covers, numbered from 0",
                                      0.0,
                                      static_cast<double>(now.project.surface.patches.size() - 1),
                                      0.0,
                                      0};
        if (const auto patch = ui.integer(now.project.surface.machined_patch, info)) {
            ask.edit("Choose the machined patch",
                     [n = *patch](project::Project& draft) { draft.surface.machined_patch = n; });
        }
    }
    if (const auto flipped =
            ui.toggle("flipped",
                      "Opposite side",
                      now.project.surface.flipped,
                      "Machine the opposite side: the tool axis points against the normal S_u x S_v")) {
        ask.edit("Machine the opposite side",
                 [on = *flipped](project::Project& draft) { draft.surface.flipped = on; });
    }
    draw_turn(ui, ask);
}

void DesignPanel::draw_turn(Ui& ui, ActionQueue& ask) {
    const widgets::FieldInfo info{"turn",
                                  "Rotate part by",
                                  "\u00b0",
                                  "Rotate the whole part; its origin stays in place",
                                  -360.0,
                                  360.0,
                                  90.0,
                                  3};
    if (const auto degrees = ui.number(turn_deg_, info)) {
        turn_deg_ = *degrees;
    }
    const auto row = ui.row(3);
    for (int axis = 0; axis < 3; ++axis) {
        const std::string name(1, "XYZ"[axis]);
        const std::string tip = fmt::format("By {:.6g}\u00b0 about {} through the origin", turn_deg_, name);
        if (ui.button("turn_" + name, "About " + name, {}, {{}, widgets::Rank::normal, -1.0F, tip})) {
            ask.edit("Rotate the part", [by = Vec3(turn_deg_ * Vec3::Unit(axis))](project::Project& draft) {
                draft.surface = project::with_turn(draft.surface, by);
            });
            ask.run("view.fit");
        }
    }
}

void DesignPanel::draw_point(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto section = ui.section("point", "Control point");
    if (!section) {
        return;
    }
    symmetry_fields(ui, now, ask);
    const std::vector<ControlPointId>& selected = now.view_state.selected;
    if (selected.empty()) {
        ui.note(
            "Click a control point in the view; Ctrl adds to the selection. Drag to move it, with X, Y or Z "
            "held along one axis.");
        return;
    }
    const ControlPointId& id = selected.front();
    const ControlNet& net = net_of(now.project, id);
    const Vec3& at = net.point(id.i, id.j);
    ui.value("which",
             "Selected",
             selected.size() == 1 ? fmt::format("row {}, column {}", id.i, id.j)
                                  : fmt::format("{} points, first ({},{})", selected.size(), id.i, id.j));
    const std::array<std::pair<const char*, const char*>, 3> names{{{"x", "X"}, {"y", "Y"}, {"z", "Z"}}};
    for (int axis = 0; axis < 3; ++axis) {
        const auto& [name, label] = names[static_cast<std::size_t>(axis)];
        const widgets::FieldInfo info{
            name,
            label,
            "mm",
            "Coordinate of the control point; the other selected points move by the same distance",
            -farthest,
            farthest};
        if (const auto value = ui.number(at[axis], info)) {
            Vec3 by = Vec3::Zero();
            by[axis] = *value - at[axis];
            move_shared_points(now, ask, selected, by);
        }
    }
    const widgets::FieldInfo weight{
        "weight", "Weight", "", "Rational weight; 1 everywhere gives a polynomial patch", 1e-6, 1e6, 1.0, 4};
    if (const auto value = ui.number(net.weight(id.i, id.j), weight)) {
        set_weights(now, ask, selected, *value);
    }
    action_button(ui, now, ask, catalogue_, "edit.smooth");
}

/// Which columns are shown, where not all are: by hand, and that of a point that is selected.
void DesignPanel::draw_columns(Ui& ui, const FrameState& now, const ControlNet& net, int shown) {
    const auto selected =
        now.view_state.selected.empty() ? std::nullopt : std::optional(now.view_state.selected.front());
    if (std::exchange(followed_, selected) != selected && selected) {
        first_column_ = std::clamp(first_column_, selected->j - shown + 1, selected->j);
    }
    const int last_first = net.columns - shown;
    first_column_ = std::clamp(first_column_, 0, last_first);
    if (last_first == 0) {
        return;
    }
    const auto before = first_column_ > 0 ? widgets::Permission{}
                                          : widgets::Permission::refused("These are the first columns.");
    if (ui.icon_button("columns_back", widgets::icons::back, "Previous columns", before)) {
        first_column_ = std::max(0, first_column_ - shown);
    }
    ui.beside();
    const auto after = first_column_ < last_first
                           ? widgets::Permission{}
                           : widgets::Permission::refused("These are the last columns.");
    if (ui.icon_button("columns_on", widgets::icons::forward, "Next columns", after)) {
        first_column_ = std::min(last_first, first_column_ + shown);
    }
    ui.beside();
    ui.words(
        fmt::format("columns {} to {} of 0 to {}", first_column_, first_column_ + shown - 1, net.columns - 1),
        widgets::Tone::muted);
}

void DesignPanel::draw_net_row(Ui& ui, const FrameState& now, ActionQueue& ask, int row, int columns) {
    const int patch = edited_patch(now);
    const ControlNet& net = now.project.surface.patches[static_cast<std::size_t>(patch)];
    const bool weights = shown_coordinate_ == weight_column;
    const auto scope = ui.scope(fmt::format("row{}", row));
    const auto line = ui.row(columns);
    for (int j = first_column_; j < first_column_ + columns; ++j) {
        const std::string id = fmt::format("column{}", j);
        const widgets::FieldInfo info{id,
                                      "",
                                      "",
                                      weights ? "Rational weight" : "mm; rows follow u, columns v",
                                      weights ? 1e-6 : -farthest,
                                      weights ? 1e6 : farthest,
                                      std::numeric_limits<double>::quiet_NaN(),
                                      decimals_of(shown_coordinate_)};
        const double value = number_of(net, row, j, shown_coordinate_);
        if (const auto changed = ui.number(value, info)) {
            const std::vector<ControlPointId> cell{{static_cast<geometry::PatchId>(patch), row, j}};
            if (weights) {
                set_weights(now, ask, cell, *changed);
            } else {
                move_shared_points(now, ask, cell, (*changed - value) * Vec3::Unit(shown_coordinate_));
            }
        }
    }
}

void DesignPanel::draw_net(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto section = ui.section("net", "Control net");
    if (!section) {
        return;
    }
    const std::array<widgets::Option, 4> coordinates{{{"x", "X"}, {"y", "Y"}, {"z", "Z"}, {"w", "Weight"}}};
    if (const auto chosen = ui.segmented("coordinate", "", shown_coordinate_, coordinates)) {
        shown_coordinate_ = *chosen;
    }
    const ControlNet& net = now.project.surface.patches[static_cast<std::size_t>(edited_patch(now))];
    const int shown = columns_shown(ui, net, shown_coordinate_);
    draw_columns(ui, now, net, shown);
    {
        const auto fields = ui.enter_goes_on();
        for (int i = 0; i < net.rows; ++i) {
            draw_net_row(ui, now, ask, i, shown);
        }
    }
    ui.note("X, Y, Z in mm. Rows follow u, columns follow v. Expressions such as 25.4/2 are allowed. Enter "
            "moves to the next field.");
}

} // namespace millwright::panels
