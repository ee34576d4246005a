#include "ui/toolpath_panels/tool_fields.h"

#include "core/base/counted.h"
#include "core/base/sentences.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/plan/cut_remarks.h"
#include "core/plan/cut_study.h"
#include "core/project/tool_settings.h"
#include "core/toolpath/shortest_sequence.h"
#include "ui/panels/fields.h"
#include "ui/panels/numbers_text.h"
#include "ui/widgets/notices.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::panels {

namespace {

using project::Project;
using toolpath::CutterKind;

/// The scallop of a strategy is asked for there; a point without a length is not called by a number.
bool is_asked_for(const Project& project, std::string_view id) {
    const project::ToolInput& tool = project.tool;
    const bool of_no_holder = id == "holder_length_mm" && !(tool.holder_diameter_mm > 0.0);
    const bool of_strategy =
        id == "scallop_mm" && project.toolpath.strategy == project::StrategyInput::constant_scallop;
    const bool of_no_call = id == "number" && !project::gauge_length_mm(tool);
    return project::has_number(tool.cutter, id) && !of_no_holder && !of_strategy && !of_no_call;
}

void bites_text(Ui& ui, const Project& project, const plan::CutStudy& cut) {
    std::ptrdiff_t of_holder = 0;
    for (const plan::BlockBite& bite : cut.bites) {
        of_holder += bite.by_holder ? 1 : 0;
    }
    const std::ptrdiff_t of_cutter = std::ssize(cut.bites) - of_holder;
    ui.value("deepest",
             "Max. gouge",
             length_text(cut.deepest),
             "mm",
             "Maximum depth of the cutter below the surface");
    ui.note(as_sentence(plan::checked_text(project)));
    ui.value("bites",
             "Gouging blocks",
             fmt::format("{}", counted(of_cutter, "block")),
             "",
             "Blocks in which the cutter goes below the surface; listed in the Gouges tab");
    ui.value("holder_bites",
             "Holder collisions",
             fmt::format("{}", counted(of_holder, "block")),
             "",
             "Blocks in which the holder touches the part");
    ui.value("local",
             "Nodes too tight",
             fmt::format("{}", counted(cut.local_gouges.size(), "node")),
             "",
             "Nodes at which the surface is curved more tightly than the cutter");
    if (!cut.bites.empty() || !cut.local_gouges.empty()) {
        (void)widgets::banner(
            ui, "gouges", {widgets::Severity::warning, "This tool gouges the part on this path.", {}});
    }
}

/// Before and after, where the program's angles are not the nearest ones.
void gain_text(Ui& ui, const FrameState& now) {
    const plan::Plan& plan = now.plan->plan;
    const auto after = plan.program_path(now.plan->project);
    if (plan.unsequenced_failure) {
        ui.note("The program with nearest angles, to compare with, could not be computed: " +
                to_text(*plan.unsequenced_failure));
        return;
    }
    if (!plan.unsequenced || !after || !plan.trajectory) {
        return;
    }
    const plan::Evaluation& before = *plan.unsequenced;
    const auto both = [](const std::string& from, const std::string& to) { return from + " \u2192 " + to; };
    ui.note("Program with nearest angles and no added points \u2192 with the settings chosen here:");
    ui.value("both_points",
             "Points",
             both(fmt::format("{}", before.toolpath.points.size()),
                  fmt::format("{}", after->toolpath.points.size())));
    ui.value("both_max",
             "Largest error",
             both(length_text(before.closest.max), length_text(after->closest.max)),
             "mm");
    ui.value("both_mean",
             "Mean error",
             both(length_text(before.closest.mean), length_text(after->closest.mean)),
             "mm");
    ui.value("both_axis",
             "Axis deviation",
             both(angle_text(before.closest.axis_max), angle_text(after->closest.axis_max)),
             "deg");
    const auto whole = [](double angle) { return fixed(to_degrees(angle), 0); };
    ui.value("both_travel",
             "Rotation",
             both(whole(before.axes.rotary_travel), whole(after->axes.rotary_travel)),
             "deg");
    if (plan.unsequenced_time) {
        ui.value("both_time",
                 "Time",
                 both(clock_time(*plan.unsequenced_time), clock_time(plan.trajectory->duration())));
    }
}

/// Where the points that are added make the uniform grid the better one.
void sequencing_warning(Ui& ui, const FrameState& now) {
    const std::string remark = plan::sequencing_remark(now.plan->project, now.plan->plan);
    if (!remark.empty()) {
        (void)widgets::banner(ui, "uniform_better", {widgets::Severity::warning, as_sentence(remark), {}});
    }
}

/// Where a part is not cut, what stands there is higher than any ridge.
void highest_left(Ui& ui, const plan::Plan& plan) {
    const double on_cut = plan.cut->scallops.max;
    if (const auto least = plan::left_at_least(plan)) {
        ui.value("scallop_max",
                 "Max. scallop",
                 "at least " + length_text(*least),
                 "mm",
                 "Includes areas that no pass reaches; the exact height there is not computed");
        ui.value("scallop_cut",
                 "On machined area",
                 length_text(on_cut),
                 "mm",
                 "Maximum scallop height on the machined area");
    } else {
        ui.value("scallop_max", "Max. scallop", length_text(on_cut), "mm", "Maximum scallop height");
    }
}

} // namespace

void tool_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto section = ui.section("tool", "Tool");
    if (!section) {
        return;
    }
    const project::ToolInput& tool = now.project.tool;
    choice_field<CutterKind>(ui,
                             ask,
                             "cutter",
                             "Cutter",
                             "Change the cutter",
                             project::cutter_kinds(),
                             tool.cutter,
                             [](Project& p, CutterKind kind) { p.tool.cutter = kind; });
    for (const auto& setting : project::tool_numbers()) {
        if (is_asked_for(now.project, setting.id)) {
            number_fields<project::ToolInput>(
                ui, ask, {&setting, 1}, tool, [](Project& p) -> project::ToolInput& { return p.tool; });
        }
    }
}

void cut_fields(Ui& ui, const FrameState& now) {
    if (now.project.tool.cutter == CutterKind::point) {
        return;
    }
    const auto section = ui.section("cut", "Surface finish and gouges");
    if (!section) {
        return;
    }
    if (!now.plan || !now.plan->plan.cut) {
        ui.note(now.failure().empty() ? "Computing \u2026" : now.failure());
        return;
    }
    const plan::CutStudy& cut = *now.plan->plan.cut;
    highest_left(ui, now.plan->plan);
    ui.value("scallop_mean",
             "Mean scallop",
             length_text(cut.scallops.mean),
             "mm",
             "Mean scallop height on the machined area");
    ui.value("not_cut",
             "Not machined",
             fixed(100.0 * cut.scallops.not_cut, 1),
             "%",
             "Share of the surface that no pass reaches");
    if (std::isfinite(cut.step_over)) {
        ui.value("step_over",
                 "Step-over",
                 length_text(cut.step_over),
                 "mm",
                 "Maximum track distance for the required scallop height");
    }
    if (const std::string why = plan::why_higher(now.plan->project, now.plan->plan); !why.empty()) {
        (void)widgets::banner(ui, "left_higher", {widgets::Severity::warning, why + ".", {}});
    }
    bites_text(ui, now.plan->project, cut);
}

void sequencing_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto section = ui.section("sequencing", "Rotary axes along the path");
    if (!section) {
        return;
    }
    const project::SequencingInput& input = now.project.sequencing;
    choice_field<toolpath::SequencingGoal>(
        ui,
        ask,
        "goal",
        "Sequencing",
        "Change the sequencing",
        project::sequencing_goals(),
        input.goal,
        [](Project& p, toolpath::SequencingGoal goal) { p.sequencing.goal = goal; });
    number_fields<project::SequencingInput>(
        ui, ask, project::sequencing_numbers(), input, [](Project& p) -> project::SequencingInput& {
            return p.sequencing;
        });
    const auto shown = now.shown();
    if (shown && now.plan->plan.cutting_setup) {
        const double step = toolpath::largest_rotary_step(
            now.plan->plan.cutting_setup->machine, shown->toolpath, shown->axes, toolpath::MoveKind::track);
        ui.value("points",
                 "Points",
                 fmt::format("{}", shown->toolpath.points.size()),
                 "",
                 "Points of the displayed path");
        ui.value("travel",
                 "Rotation",
                 angle_text(shown->axes.rotary_travel),
                 "deg",
                 "Total travel of all rotary axes");
        ui.value("step",
                 "Largest step",
                 angle_text(step),
                 "deg",
                 "Largest rotation of a rotary axis within one move of a track");
        gain_text(ui, now);
        sequencing_warning(ui, now);
    }
}

} // namespace millwright::panels
