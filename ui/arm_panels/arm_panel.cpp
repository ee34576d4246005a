#include "ui/arm_panels/arm_panel.h"

#include "core/base/sentences.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/kinematics/tool_rotation.h"
#include "core/project/assets.h"
#include "ui/arm_panels/arm_path_fields.h"
#include "ui/arm_panels/internal/joint_units.h"
#include "ui/panels/fields.h"
#include "ui/widgets/notices.h"
#include "ui/widgets/slider.h"
#include "ui/widgets/table.h"
#include "ui/workspaces/arm_workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>
#include <iterator>
#include <span>

namespace millwright::panels {

namespace {

using actions::ArmWorkspace;
using arm::ArmJoint;
using arm::JointKind;

constexpr double least_manipulability = 1e-3; // below: next to singular

widgets::Permission by_hand(const FrameState& now) {
    return now.arm_connected() ? widgets::Permission::refused(
                                     "The view follows the connected controller: jog the arm instead.")
                               : widgets::Permission{};
}

/// "12 s", from a minute on "00:01:12".
std::string whole_seconds(double time) {
    constexpr double minute = 60.0;
    return time < minute ? fixed(std::floor(time), 0) + " s" : clock_time(time);
}

/// How far the card is: "Line 12 of 40, 31 %, 7 s of 22 s, 15 s left."
std::string place_text(const actions::CardPlace& place) {
    constexpr double whole = 100.0;
    const std::string share = fmt::format("{:.0f} %", std::floor(whole * place.share));
    if (place.sending) {
        return fmt::format("Sending line {} of {} to the card, {}.", place.line, place.lines, share);
    }
    const std::string line = fmt::format("Line {} of {}", place.line, place.lines);
    if (!(place.duration > 0.0)) {
        return fmt::format("{}; duration unknown.", line);
    }
    // Of whole seconds, so that what is shown adds up.
    const double all = std::round(place.duration), gone = std::min(std::floor(place.time), all);
    return fmt::format("{}, {}, {} of {}, {} left.",
                       line,
                       share,
                       whole_seconds(gone),
                       whole_seconds(all),
                       whole_seconds(all - gone));
}

/// Of one that did not come to its end.
std::string broken_off_text(const actions::CardPlace& place) {
    const std::string line = fmt::format("Ended early at line {} of {}", place.line, place.lines);
    return place.sending || !(place.duration > 0.0) ? line + "."
                                                    : fmt::format("{}, at {:.0f} % and {} of {}.",
                                                                  line,
                                                                  std::floor(100.0 * place.share),
                                                                  whole_seconds(place.time),
                                                                  whole_seconds(std::round(place.duration)));
}

bool slides(const arm::ArmModel& arm) {
    for (int n = 0; n < arm.joint_count(); ++n) {
        if (arm.joint(n).kind == arm::JointKind::prismatic) {
            return true;
        }
    }
    return false;
}

/// Whether the goal's roll matters, and which it is.
void roll_fields(Ui& ui, const ArmWorkspace& workspace, ActionQueue& ask) {
    const auto& roll = workspace.goal_roll();
    if (const auto on = ui.toggle("roll_matters",
                                  "Set roll",
                                  roll.has_value(),
                                  "Off: the rotation of the tool about its axis is free")) {
        ask.arm([on = *on](ArmWorkspace& b) {
            b.set_goal_roll(on ? std::optional(kinematics::roll_of(b.tool().linear())) : std::nullopt);
        });
    }
    if (roll) {
        const widgets::FieldInfo field{"roll",
                                       "Roll",
                                       "\u00b0",
                                       "Rotation of the tool about its axis, from where the shortest turn "
                                       "from the base x axis to the tool axis takes the base -z axis. At 0 "
                                       "the x axis of a level tool points down",
                                       -360.0,
                                       360.0,
                                       {},
                                       2};
        if (const auto wanted = ui.number(to_degrees(*roll), field)) {
            ask.arm([to = from_degrees(*wanted)](ArmWorkspace& b) { b.set_goal_roll(to); });
        }
    }
}

std::string direction_text(const Vec3& direction) {
    return fmt::format(
        "{}  {}  {}", fixed(direction.x(), 3), fixed(direction.y(), 3), fixed(direction.z(), 3));
}

std::string tip_place_text(const Vec3& tip) {
    return fmt::format("{}  {}  {}", fixed(tip.x(), 1), fixed(tip.y(), 1), fixed(tip.z(), 1));
}

} // namespace

void ArmPanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    draw_arm(ui, now, ask);
    if (!now.arm.loaded()) {
        return;
    }
    draw_joints(ui, now, ask);
    draw_goal(ui, now, ask);
    arm_path_fields(ui, now, ask, catalogue_);
    draw_tool(ui, now);
}

void ArmPanel::draw_arm(Ui& ui, const FrameState& now, ActionQueue& ask) {
    if (arms_.empty()) {
        arms_ = project::arm_ids(now.assets);
    }
    if (now.arm.loaded() && std::ranges::find(arms_, now.arm.name()) == arms_.end()) {
        arms_.push_back(now.arm.name()); // opened from a file
    }
    std::vector<std::string> labels;
    std::ranges::transform(arms_, std::back_inserter(labels), [](const std::string& name) {
        return std::filesystem::path(name).filename().string();
    });
    std::vector<widgets::Option> options;
    for (std::size_t n = 0; n < arms_.size(); ++n) {
        options.push_back({arms_[n], labels[n]});
    }
    const auto found = std::ranges::find(arms_, now.arm.name());
    const int at = found == arms_.end() ? 0 : static_cast<int>(found - arms_.begin());
    const auto permitted = ui.permitted(by_hand(now));
    if (const auto chosen =
            ui.choice("arm", "Arm", at, options, "Included arms and those opened with Arm > Open an arm")) {
        ask.arm([name = arms_[static_cast<std::size_t>(*chosen)]](ArmWorkspace& workspace) {
            workspace.load(name);
        });
        ask.show([](actions::ViewState& view_state) {
            view_state.fit_wanted_in(actions::Workspace::arm) = true;
        }); // arms differ in size
    }
}

void ArmPanel::draw_joints(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto section = ui.section("joints", "Joints");
    if (!section) {
        return;
    }
    if (now.arm_connected() && !now.connection.status.position_known) {
        (void)widgets::banner(ui,
                              "not_known",
                              {widgets::Severity::warning,
                               now.connection.status.velocity.size() == 0 // as last reported
                                   ? "Position unknown: these are the last angles that the card reported, "
                                     "and the arm may have moved since. Inspect the arm."
                                   : "Position unknown: these angles are relative to the pose at which the "
                                     "card was switched on. Home the arm.",
                               {}});
    }
    const auto labels = ui.label_share(0.24F);
    for (int n = 0; n < now.arm.arm().joint_count(); ++n) {
        const ArmJoint& joint = now.arm.arm().joint(n);
        const double position = now.arm.joints()[n];
        const bool bounded = std::isfinite(joint.min) && std::isfinite(joint.max);
        const std::string id = "joint_" + joint.name;
        const std::string label = "Joint " + joint.name + (viewport::near_limit(joint, position) ? " !" : "");
        const std::string tip = fmt::format("Range {} to {} {}; ! means within 10 \u00b0 of a limit",
                                            shortest(std::round(in_joint_unit(joint, joint.min))),
                                            shortest(std::round(in_joint_unit(joint, joint.max))),
                                            is_revolute(joint) ? "\u00b0" : "mm");
        const widgets::FieldInfo info{id,
                                      label,
                                      is_revolute(joint) ? "\u00b0" : " mm",
                                      tip,
                                      bounded ? in_joint_unit(joint, joint.min) : -360.0,
                                      bounded ? in_joint_unit(joint, joint.max) : 360.0,
                                      std::numeric_limits<double>::quiet_NaN(),
                                      2};
        if (const auto value =
                widgets::number_slider(ui, in_joint_unit(joint, position), info, by_hand(now))) {
            ask.arm([n, wanted = from_joint_unit(joint, *value)](ArmWorkspace& workspace) {
                workspace.set_joint(n, wanted);
            });
        }
    }
    action_button(ui, now, ask, catalogue_, "arm.home");
    if (!now.arm.refusal().empty()) {
        ui.note(as_sentence(now.arm.refusal()));
    }
}

void ArmPanel::draw_tool(Ui& ui, const FrameState& now) const {
    const auto section = ui.section("tool", "Tool");
    if (!section) {
        return;
    }
    const Frame tool = now.arm.tool();
    const Vec3 tip = tool.translation();
    const Mat3 directions = tool.linear();
    const auto labels = ui.label_share(0.34F);
    if (const actions::ArmBlockPlayed* const block = now.arm.block()) {
        ui.value("block", fmt::format("Line {}", block->line), block->text);
        ui.value("block_goal", "Target", tip_place_text(block->goal), "mm");
    }
    ui.value("tip", "Tip", tip_place_text(tip), "mm");
    ui.value("axis", "Axis (z)", direction_text(directions.col(2)));
    ui.value("x", "Axis (x)", direction_text(directions.col(0)));
    ui.value("y", "Axis (y)", direction_text(directions.col(1)));
    ui.value("roll", "Roll", fixed(to_degrees(kinematics::roll_of(directions)), 2), "\u00b0");
    const double measure = now.arm.manipulability();
    ui.value("manipulability",
             "Manipulability",
             fixed(measure, 4),
             measure < least_manipulability ? "singular" : "");
}

void ArmPanel::draw_goal(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto section = ui.section("goal", "Goal");
    if (!section) {
        return;
    }
    const ArmWorkspace& workspace = now.arm;
    const Frame tool = workspace.tool();
    const Vec3 tip = workspace.goal() ? workspace.goal()->tip : Vec3(tool.translation());
    const Vec3 axis = workspace.goal() ? workspace.goal()->axis : Vec3(tool.linear().col(2));
    const widgets::FieldInfo place{
        "tip", "Tip", "mm", "Target position of the tip in the base frame", -1e5, 1e5, {}, 2};
    if (const auto wanted = ui.vec3("tip", "Tip", {tip.x(), tip.y(), tip.z()}, place)) {
        ask.arm([axis, p = *wanted](ArmWorkspace& b) { b.set_goal(Vec3(p[0], p[1], p[2]), axis); });
    }
    const widgets::FieldInfo direction{
        "axis", "Axis", {}, "Target direction of the tool axis; need not be a unit vector", -1e3, 1e3, {}, 3};
    if (const auto wanted = ui.vec3("axis", "Axis", {axis.x(), axis.y(), axis.z()}, direction)) {
        ask.arm([tip, d = *wanted](ArmWorkspace& b) { b.set_goal(tip, Vec3(d[0], d[1], d[2])); });
    }
    roll_fields(ui, workspace, ask);
    if (const auto on = ui.toggle(
            "project",
            "Snap axis to plane",
            workspace.projects(),
            "Rotate the tool axis by the smallest angle to a direction that five joints can reach")) {
        ask.arm([on = *on](ArmWorkspace& b) { b.set_projects(on); });
    }
    {
        const auto row = ui.row(2);
        if (ui.button("from_tool",
                      "Use current pose",
                      {},
                      {{}, widgets::Rank::normal, -1.0F, "Copy the current pose of the arm"})) {
            ask.arm([](ArmWorkspace& b) { b.set_goal_from_tool(); });
        }
        const auto allowed =
            workspace.goal() ? widgets::Permission{} : widgets::Permission::refused("No goal is set.");
        if (ui.button("drop", "Clear", allowed, {{}, widgets::Rank::normal, -1.0F, {}})) {
            ask.arm([](ArmWorkspace& b) { b.drop_goal(); });
        }
    }
    if (workspace.goal()) {
        draw_solutions(ui, now, ask);
    }
}

void ArmPanel::draw_solutions(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const ArmWorkspace& workspace = now.arm;
    if (workspace.solutions().empty()) {
        (void)widgets::banner(
            ui, "reason", {widgets::Severity::warning, as_sentence(workspace.reason()), {}});
        return;
    }
    // Of any joint from its position.
    constexpr std::array<widgets::Column, 2> turning{
        {{"Solution", {}, 1.6F}, {"Max. travel", "\u00b0", 1.0F, true}}};
    constexpr std::array<widgets::Column, 3> sliding{
        {{"Solution", {}, 1.0F}, {"Turn", "\u00b0", 1.0F, true}, {"Slide", "mm", 1.0F, true}}};
    const bool with_slide = slides(workspace.arm());
    widgets::TableView view;
    view.columns =
        with_slide ? std::span<const widgets::Column>(sliding) : std::span<const widgets::Column>(turning);
    view.rows = std::ssize(workspace.solutions());
    view.chosen = workspace.chosen();
    view.cell = [&](std::ptrdiff_t row, int column) {
        const actions::ArmSolution& solution = workspace.solutions()[static_cast<std::size_t>(row)];
        if (column == 1) {
            return fixed(to_degrees(solution.farthest_turn), 1);
        }
        if (column == 2) {
            return fixed(solution.farthest_slide, 1);
        }
        return solution.branch.empty() ? fmt::format("{}", row + 1) : capitalised(solution.branch);
    };
    view.row_id = [](std::ptrdiff_t row) { return fmt::format("solution_{}", row + 1); };
    if (const auto row = widgets::table(ui, "solutions", view)) {
        ask.arm([n = static_cast<int>(*row)](ArmWorkspace& b) { b.choose(n); });
    }
}

void ArmPanel::draw_motion(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const bool real = now.arm_connected();
    {
        constexpr float roomy = 480.0F; // all labels stand whole
        const bool narrow = ui.rest().w < ui.px(roomy);
        const auto row = ui.row(4);
        if (real) {
            action_button(ui, now, ask, catalogue_, "machine.hold", widgets::Rank::normal, "Hold");
            action_button(ui, now, ask, catalogue_, "machine.resume", widgets::Rank::normal, "Resume");
            action_button(ui, now, ask, catalogue_, "machine.stop", widgets::Rank::primary, "Stop");
        } else {
            action_button(ui, now, ask, catalogue_, "arm.go_joints", widgets::Rank::primary, "Joint");
            action_button(ui, now, ask, catalogue_, "arm.go_straight", widgets::Rank::normal, "Linear");
            action_button(ui, now, ask, catalogue_, "arm.stop", widgets::Rank::normal, "Stop");
        }
        action_button(ui,
                      now,
                      ask,
                      catalogue_,
                      "arm.clear_trace",
                      widgets::Rank::normal,
                      narrow ? "Clear" : "Clear trace");
    }
    const drivers::DriverStatus& status = now.connection.status;
    const bool alarm = status.state == drivers::DriverState::alarm; // which stands above the drawing
    if (real && !status.message.empty() && !alarm) { // below all buttons, so that it moves none
        ui.text(as_sentence(status.message), widgets::Tone::warning);
    } else if (const auto& place = now.arm.card_run().place(); real && place) {
        ui.note(place_text(*place));
    } else if (const auto& ended = now.arm.card_run().broken_off(); real && ended) {
        ui.note(broken_off_text(*ended));
    } else if (real && status.link_lost) {
        ui.note("The link is lost: the view shows the last reported position.");
    } else if (real) {
        ui.note("The view follows the connected PMAC.");
    } else if (now.arm.duration() > 0.0) {
        ui.note(fmt::format("Moving: {} of {}.", short_time(now.arm.time()), short_time(now.arm.duration())));
    } else {
        ui.note("Drag the tool tip or a link in the view, or set a goal and move to it.");
    }
}

} // namespace millwright::panels
