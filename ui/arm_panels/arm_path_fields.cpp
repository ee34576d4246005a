#include "ui/arm_panels/arm_path_fields.h"

#include "core/base/sentences.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "ui/panels/fields.h"
#include "ui/widgets/notices.h"
#include "ui/workspaces/arm_workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <string>

namespace millwright::panels {

namespace {

constexpr std::array<widgets::Option, 2> sources{
    {{"project", "Project", {}, "Program generated from the project's surface"},
     {"file", "Opened file", {}, "The open G-code file, or the plot's program if no file is open"}}};

void place_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const project::PathPlace& place = now.project.arm.path;
    const widgets::FieldInfo at{
        "at", "Origin", "mm", "Position of the program zero in the base frame", -1e5, 1e5, {}, 1};
    if (const auto v = ui.vec3("at", "Origin", {place.at_mm.x(), place.at_mm.y(), place.at_mm.z()}, at)) {
        ask.edit(
            "Place the path on the arm",
            [to = Vec3((*v)[0], (*v)[1], (*v)[2])](project::Project& draft) { draft.arm.path.at_mm = to; });
    }
    const widgets::FieldInfo turned{"turned",
                                    "Rotation",
                                    "\u00b0",
                                    "Rotation about X, then Y, then Z of the base frame",
                                    -360.0,
                                    360.0,
                                    {},
                                    1};
    const Vec3& t = place.turned_deg;
    if (const auto v = ui.vec3("turned", "Rotation", {t.x(), t.y(), t.z()}, turned)) {
        ask.edit("Rotate the path on the arm",
                 [to = Vec3((*v)[0], (*v)[1], (*v)[2])](project::Project& draft) {
                     draft.arm.path.turned_deg = to;
                 });
    }
    const widgets::FieldInfo lean{
        "lean",
        "Max. tilt",
        "\u00b0",
        "Largest tilt of the tool from the programmed axis where a five-joint arm cannot reach it; 0: none",
        0.0,
        90.0,
        project::PathPlace().most_lean_deg,
        1};
    if (const auto v = ui.number(place.most_lean_deg, lean)) {
        ask.edit("Change the maximum tool tilt",
                 [to = *v](project::Project& draft) { draft.arm.path.most_lean_deg = to; });
    }
}

/// An arm of five joints turns the tool into its own plane, and cuts otherwise than the machine would.
void lean_text(Ui& ui, const arm::ArmReach& reach) {
    constexpr double told = 0.1; // degrees
    const double lean = to_degrees(reach.most_tilt);
    if (lean > told) {
        (void)widgets::banner(
            ui,
            "leans",
            {widgets::Severity::warning,
             fmt::format("The arm cannot reach the programmed tool axis: the tool tilts by up to {}\u00b0.",
                         fixed(lean, 1)),
             {}});
    }
}

/// Short ones are easily overlooked in the drawing.
void holes_text(Ui& ui, const arm::ArmReach& reach) {
    if (reach.holes.empty()) {
        return;
    }
    const std::string what =
        reach.holes.size() == 1 ? "1 section is" : fmt::format("{} sections are", reach.holes.size());
    (void)widgets::banner(
        ui,
        "holes",
        {widgets::Severity::warning, "The arm cannot reach the whole path: " + what + " out of reach.", {}});
}

void reach_text(Ui& ui, const actions::ArmPathAnswer& path) {
    if (!path.track) {
        (void)widgets::banner(ui, "why", {widgets::Severity::warning, with_full_stop(path.why), {}});
        return;
    }
    const arm::ArmReach& reach = path.reach;
    constexpr double nearly = 99.9; // short stretches that are left out are no rounding
    const double share = reach.length > 0.0 ? 100.0 * reach.reached / reach.length : 0.0;
    const double percent = reach.holes.empty() ? share : std::min(share, nearly);
    holes_text(ui, reach);
    ui.value("reached", "Reachable", fixed(percent, 1), fmt::format("% of {} mm", fixed(reach.length, 0)));
    lean_text(ui, reach);
    constexpr std::size_t most_shown = 3;
    for (std::size_t n = 0; n < std::min(most_shown, reach.holes.size()); ++n) {
        const arm::ArmHole& hole = reach.holes[n];
        const std::string place = hole.first().line == 0 ? "" : fmt::format("Line {}: ", hole.first().line);
        const std::string off = to_text(path.wish.arm->arm(), hole.trouble, hole.worst().off);
        ui.note(fmt::format("{}{} mm, {}{}",
                            place,
                            fixed(hole.length, 1),
                            with_full_stop(hole.why),
                            off.empty() ? "" : " Worst case: " + with_full_stop(off)));
    }
    if (reach.holes.size() > most_shown) {
        ui.note(fmt::format("{} more sections out of reach.", reach.holes.size() - most_shown));
    }
}

/// Why there is nothing to show; empty if there is.
std::string why_none(const FrameState& now) {
    if (now.arm_program().program) {
        return {};
    }
    if (!now.view_state.manual.arm_path.of_file || !now.opened) {
        return "The project has no program yet.";
    }
    return now.opened->no_motion.empty() ? "Reading the program \u2026" : now.opened->no_motion;
}

void source_field(Ui& ui, const FrameState& now, ActionQueue& ask) {
    if (!now.opened) {
        return;
    }
    const int source = now.view_state.manual.arm_path.of_file ? 1 : 0;
    if (const auto chosen = ui.segmented("source", "Program", source, sources)) {
        ask.show([of_file = *chosen == 1](actions::ViewState& view_state) {
            view_state.manual.arm_path.of_file = of_file;
        });
    }
}

} // namespace

void arm_path_fields(Ui& ui, const FrameState& now, ActionQueue& ask, const actions::Catalogue& catalogue) {
    const auto section = ui.section("path", "Path on the arm");
    if (!section) {
        return;
    }
    source_field(ui, now, ask);
    const bool shown = now.view_state.manual.arm_path.shown;
    const std::string none = why_none(now);
    const auto can_show = none.empty() ? widgets::Permission{} : widgets::Permission::refused(none);
    if (const auto on =
            ui.toggle("shown", "Show the program", shown, "Green: reachable; red: out of reach", can_show)) {
        ask.show([on = *on](actions::ViewState& view_state) { view_state.manual.arm_path.shown = on; });
    }
    if (!shown || !none.empty()) {
        return;
    }
    place_fields(ui, now, ask);
    if (const auto path = now.arm.path()) {
        reach_text(ui, *path);
    } else {
        ui.note("Computing \u2026");
    }
    action_button(ui, now, ask, catalogue, "arm.send_path");
    if (now.arm.works_out_path_motion()) {
        ui.note("Computing the motion \u2026");
    }
}

} // namespace millwright::panels
