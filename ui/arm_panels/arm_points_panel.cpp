#include "ui/arm_panels/arm_points_panel.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "ui/panels/fields.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/table.h"
#include "ui/workspaces/arm_workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

namespace millwright::panels {

namespace {

namespace icons = widgets::icons;
using project::TaughtPoint;
using widgets::Permission;
using widgets::Rank;

constexpr std::array<widgets::Option, 2> moves{
    {{"joints",
      "Joint",
      {},
      "Joint move: all joints move at once; the tool path in between is not controlled"},
     {"line",
      "Linear",
      {},
      "Linear move: the tip follows a straight line; the tool orientation changes uniformly"}}};

std::string joints_text(const TaughtPoint& point) {
    std::string text;
    for (const double joint : point.joints_deg) {
        text += (text.empty() ? "" : "  ") + fixed(joint, 2);
    }
    return text;
}

} // namespace

void ArmPointsPanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    // What was put down just now is what is meant.
    chosen_ =
        std::min(now.arm.new_point().value_or(chosen_), static_cast<int>(now.project.arm.points.size()) - 1);
    draw_buttons(ui, now, ask);
    if (chosen_ >= 0) {
        draw_chosen(ui, now, ask);
    }
    draw_table(ui, now);
    if (now.arm.new_point()) {
        ask.arm([](actions::ArmWorkspace& workspace) { workspace.set_new_point(std::nullopt); });
    }
}

void ArmPointsPanel::swap_with(ActionQueue& ask, int other) {
    ask.edit("Move a taught point", [from = chosen_, other](project::Project& draft) {
        std::swap(draft.arm.points.at(static_cast<std::size_t>(from)),
                  draft.arm.points.at(static_cast<std::size_t>(other)));
    });
    chosen_ = other;
}

void ArmPointsPanel::draw_buttons(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const int last = static_cast<int>(now.project.arm.points.size()) - 1;
    const auto need = [](bool allowed, const char* why) {
        return allowed ? Permission{} : Permission::refused(why);
    };
    const auto row = ui.row(8);
    action_button(ui, now, ask, catalogue_, "arm.teach", Rank::primary, "Teach");
    action_button(ui, now, ask, catalogue_, "arm.play_points", Rank::normal, "Play");
    const auto picture = now.arm_connected()
                             ? Permission::refused("The arm is connected: play the points instead.")
                             : need(chosen_ >= 0, "Select a point first.");
    if (ui.button("go_to", "Show", picture, {{}, Rank::normal, -1.0F, "Show the arm at this point"})) {
        ask.arm(
            [point = now.project.arm.points[static_cast<std::size_t>(chosen_)]](actions::ArmWorkspace& arm) {
                auto joints = arm.joints();
                for (Eigen::Index n = 0; n < std::min(joints.size(), std::ssize(point.joints_deg)); ++n) {
                    const double told = point.joints_deg[static_cast<std::size_t>(n)];
                    const bool turns = arm.arm().joint(static_cast<int>(n)).kind == arm::JointKind::revolute;
                    joints[n] = turns ? from_degrees(told) : told;
                }
                arm.set_joints(joints);
            });
    }
    if (ui.button("up", "Up", need(chosen_ > 0, "This is the first point."), {{}, Rank::normal, -1.0F, {}})) {
        swap_with(ask, chosen_ - 1);
    }
    const auto later = need(chosen_ >= 0 && chosen_ < last, "This is the last point.");
    if (ui.button("down", "Down", later, {{}, Rank::normal, -1.0F, {}})) {
        swap_with(ask, chosen_ + 1);
    }
    const auto some = need(chosen_ >= 0, "Select a point first.");
    if (ui.button("remove", "Remove", some, {icons::remove, Rank::normal, -1.0F, {}})) {
        ask.edit("Remove a taught point", [n = chosen_](project::Project& draft) {
            draft.arm.points.erase(draft.arm.points.begin() + n);
        });
    }
    action_button(ui, now, ask, catalogue_, "arm.open_points", Rank::normal, "Open");
    action_button(ui, now, ask, catalogue_, "arm.save_points", Rank::normal, "Save");
}

/// Name, way and speed of the chosen point in one line.
void ArmPointsPanel::draw_chosen(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto n = static_cast<std::size_t>(chosen_);
    const TaughtPoint& point = now.project.arm.points[n];
    const float whole = ui.rest().w;
    {
        const auto width = ui.width(0.3F * whole);
        const auto labels = ui.label_share(0.25F);
        if (const auto name = ui.text_field("name", "Name", point.name, "Unique name of the point")) {
            ask.edit("Rename a taught point",
                     [n, name = *name](project::Project& draft) { draft.arm.points.at(n).name = name; });
        }
    }
    ui.beside();
    {
        const auto width = ui.width(0.3F * whole);
        const auto labels = ui.label_share(0.25F);
        if (const auto way = ui.segmented("way", "Move", point.straight ? 1 : 0, moves)) {
            ask.edit("Change the move to a taught point", [n, straight = *way == 1](project::Project& draft) {
                draft.arm.points.at(n).straight = straight;
            });
        }
    }
    ui.beside();
    {
        const auto width = ui.width(0.2F * whole);
        const auto labels = ui.label_share(0.4F);
        const widgets::FieldInfo info{"speed",
                                      "Speed",
                                      "%",
                                      "Percent of the maximum joint speeds; for linear moves, of 250 mm/s",
                                      0.1,
                                      100.0,
                                      100.0,
                                      1};
        if (const auto speed = ui.number(point.speed_percent, info)) {
            ask.edit("Change the speed to a taught point", [n, speed = *speed](project::Project& draft) {
                draft.arm.points.at(n).speed_percent = speed;
            });
        }
    }
    ui.beside();
    const auto width = ui.width(0.16F * whole);
    const Permission teaches = catalogue_.find("arm.teach").permission(now);
    if (ui.button("again",
                  "Re-teach",
                  teaches,
                  {{}, Rank::normal, -1.0F, "Replace with the current pose of the arm"})) {
        ask.edit("Re-teach a point", [n, taught = now.arm.taught(point.name)](project::Project& draft) {
            draft.arm.points.at(n).joints_deg = taught.joints_deg;
        });
    }
}

void ArmPointsPanel::draw_table(Ui& ui, const FrameState& now) {
    const std::vector<TaughtPoint>& points = now.project.arm.points;
    constexpr std::array<widgets::Column, 5> columns{{{"", {}, 0.3F, true},
                                                      {"Name", {}, 1.4F},
                                                      {"Joints", "\u00b0", 3.0F, true},
                                                      {"Move", {}, 1.0F},
                                                      {"Speed", "%", 0.7F, true}}};
    widgets::TableView view;
    view.columns = columns;
    view.rows = std::ssize(points);
    view.chosen = chosen_;
    view.wanted = now.arm.new_point() ? chosen_ : -1;
    view.height = ui.rest().h;
    view.when_empty = "Move the arm to a position and teach the point. Click a point to edit it.";
    view.row_id = [](std::ptrdiff_t row) { return fmt::format("point_{}", row + 1); };
    view.cell = [&](std::ptrdiff_t row, int column) -> std::string {
        const TaughtPoint& point = points[static_cast<std::size_t>(row)];
        switch (column) {
        case 0:
            return std::to_string(row + 1);
        case 1:
            return point.name;
        case 2:
            return joints_text(point);
        case 3:
            return point.straight ? "linear" : "joint";
        default:
            return shortest(point.speed_percent);
        }
    };
    if (const auto row = widgets::table(ui, "points", view)) {
        chosen_ = static_cast<int>(*row);
    }
}

} // namespace millwright::panels
