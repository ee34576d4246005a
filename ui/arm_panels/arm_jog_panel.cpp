#include "ui/arm_panels/arm_jog_panel.h"

#include "core/arm/arm_hold.h"
#include "core/base/error.h"
#include "core/base/sentences.h"
#include "core/base/units.h"
#include "ui/machine_panels/manual_fields.h"
#include "ui/panels/fields.h"
#include "ui/render/imgui_compat.h"
#include "ui/widgets/slider.h"
#include "ui/workspaces/arm_workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace millwright::panels {

namespace {

using actions::ArmFrame;
using actions::JogWish;
using arm::JointPositions;
using widgets::Permission;
using widgets::Rank;

/// The hard cap of a jog by hand: what a person can still follow. The controller has one of its own below.
constexpr double fastest_deg_per_s = 30.0;
constexpr double fastest_mm_per_s = 150.0;
constexpr double whole_percent = 100.0;

constexpr std::array<widgets::Option, 3> frames{
    {{"joints", "Joints", {}, "Jog each joint individually"},
     {"base", "Base", {}, "Jog the tip along X, Y and Z of the base frame"},
     {"tool", "Tool", {}, "Jog the tip along x, y and z of the tool frame"}}};
constexpr std::array<double, 4> arm_jog_steps{0.0, 0.1, 1.0, 10.0};
constexpr std::array<widgets::Option, 4> arm_jog_step_options{
    {{"hold", "Hold", {}, "Continuous: moves while the button is held"},
     {"0_1", "0.1"},
     {"1", "1"},
     {"10", "10"}}};

bool drives(const FrameState& now, int joint) {
    return joint < std::ssize(now.connection.axes);
}

Permission can_jog_joint(const FrameState& now, int joint) {
    if (!now.arm_connected()) {
        return now.connection.connected()
                   ? Permission::refused("The connected device is not an arm: use the Machine workspace.")
                   : Permission{};
    }
    if (joint >= 0 && !drives(now, joint)) {
        return Permission::refused("The controller does not drive this joint.");
    }
    if (!now.connection.status.powered && now.connection.status.state != drivers::DriverState::alarm) {
        return Permission::refused("The motors have no power.");
    }
    return now.connection.status.activity == drivers::Activity::jog ? Permission{} : at_rest(now.connection);
}

/// The joint that + and - jog; -1 while no keys do.
int joint_of_keys(const FrameState& now) {
    const actions::ManualSettings& manual = now.view_state.manual;
    return manual.arm_keys ? std::min(manual.arm_joint, now.arm.arm().joint_count() - 1) : -1;
}

/// A key has no tip that tells why it does nothing.
void tell_refusal(ActionQueue& ask, std::string_view what, const widgets::Permission& why) {
    ask.show([text = fmt::format("{}: {}", what, why.reason)](actions::ViewState& view_state) {
        actions::tell(view_state, widgets::Severity::warning, text);
    });
}

} // namespace

/// What is held down in this frame.
class ArmJogPanel::Wish {
public:
    Wish(const FrameState& now, ActionQueue& ask, std::string& refusal)
        : now_(now), ask_(ask), refusal_(refusal) {}

    void joint(int joint, double sign, bool held, bool pressed) {
        const double step = now_.view_state.manual.step;
        if (step > 0.0) {
            if (pressed) {
                JointPositions way = JointPositions::Zero(now_.arm.joints().size());
                way[joint] = sign * (turns(joint) ? from_degrees(step) : step);
                begin_step(way);
            }
        } else if (held) {
            rates_ = JointPositions::Zero(now_.arm.joints().size());
            (*rates_)[joint] =
                sign * share() * (turns(joint) ? from_degrees(fastest_deg_per_s) : fastest_mm_per_s);
        }
    }

    void line(int axis, double sign, bool held, bool pressed) {
        const double step = now_.view_state.manual.step;
        if (step > 0.0 ? !pressed : !held) {
            return;
        }
        const Mat3 directions = now_.view_state.manual.arm_frame == ArmFrame::tool
                                    ? Mat3(now_.arm.tool().linear())
                                    : Mat3(Mat3::Identity());
        const Vec3 way = sign * directions.col(axis);
        const Vec3 velocity = way * share() * fastest_mm_per_s;
        const arm::ArmRates found = arm::tip_rates(now_.arm.arm(), now_.arm.joints(), velocity);
        if (!found.rates) {
            refusal_ = found.why;
            return;
        }
        if (step > 0.0) {
            step_line(step * way);
        } else {
            rates_ = slowed(*found.rates);
            const double most = found.rates->cwiseAbs().maxCoeff();
            velocity_ = most > 0.0 ? Vec3(velocity * (rates_->cwiseAbs().maxCoeff() / most)) : velocity;
        }
    }

    void tell() {
        if (!rates_) {
            return;
        }
        refusal_.clear();
        if (!now_.arm_connected()) {
            ask_.arm([rates = *rates_, velocity = velocity_](actions::ArmWorkspace& workspace) {
                velocity ? workspace.hold_line(*velocity) : workspace.hold_jog(rates);
            });
            return;
        }
        const JointPositions driven = rates_->head(std::ssize(now_.connection.axes));
        const double most = driven.cwiseAbs().maxCoeff();
        if (most > 0.0) {
            ask_.jog(JogWish{driven / most, most});
        }
    }

private:
    [[nodiscard]] bool turns(int joint) const {
        return now_.arm.arm().joint(joint).kind == arm::JointKind::revolute;
    }
    [[nodiscard]] double share() const { return now_.view_state.manual.arm_percent / whole_percent; }

    /// No joint faster than a person can follow.
    [[nodiscard]] static JointPositions slowed(const JointPositions& rates) {
        const double most = rates.cwiseAbs().maxCoeff(), cap = from_degrees(fastest_deg_per_s);
        return most > cap ? JointPositions(rates * (cap / most)) : rates;
    }

    void step_line(const Vec3& way) {
        if (!now_.arm_connected()) {
            refusal_.clear();
            ask_.arm([way](actions::ArmWorkspace& workspace) { workspace.move_tip_by(way); });
            return;
        }
        const arm::ArmHold there = arm::moved_tip(now_.arm.arm(), now_.arm.joints(), way);
        if (there.trouble == arm::ArmTrouble::none) {
            begin_step(there.joints - now_.arm.joints());
        } else {
            refusal_ = there.why;
        }
    }

    void begin_step(const JointPositions& way) {
        refusal_.clear();
        if (!now_.arm_connected()) {
            ask_.arm(
                [way](actions::ArmWorkspace& workspace) { workspace.set_joints(workspace.joints() + way); });
            return;
        }
        drivers::Jog jog;
        jog.way = way.head(std::ssize(now_.connection.axes));
        jog.speed = share() * from_degrees(fastest_deg_per_s);
        ask_.tell([jog](drivers::Driver& driver) { driver.jog(jog); });
    }

    const FrameState& now_;
    ActionQueue& ask_;
    std::string& refusal_;
    std::optional<JointPositions> rates_;
    std::optional<Vec3> velocity_; ///< of the tip, where it goes in a line: mm/s
};

namespace {

/// A window without room for all rows: what jogs the arm has to be in sight all the same.
bool is_low(const Ui& ui) {
    constexpr float least = 800.0F;
    return ImGui::GetIO().DisplaySize.y < ui.px(least);
}

/// Below all buttons, so that it moves none of them.
void draw_protections(Ui& ui, const FrameState& now) {
    if (now.arm.news().protections_off().empty()) {
        return;
    }
    if (const auto section = ui.section("protections", "Disabled protections")) {
        for (const std::string& sentence : now.arm.news().protections_off()) {
            ui.text(as_sentence(sentence));
        }
    }
}

} // namespace

void ArmJogPanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    connection_.draw(ui, now, ask);
    if (!now.arm.loaded()) {
        return;
    }
    draw_power(ui, now, ask);
    if (const auto section = ui.section("jog", now.arm_connected() ? "Jog" : "Jog (simulated arm)")) {
        const int frame = static_cast<int>(now.view_state.manual.arm_frame);
        if (const auto chosen = ui.segmented("frame", "Frame", frame, frames)) {
            refusal_.clear();
            ask.show([f = static_cast<ArmFrame>(*chosen)](actions::ViewState& view_state) {
                view_state.manual.arm_frame = f;
            });
        }
        if (!can_jog_joint(now, -1).allowed) {
            refusal_.clear(); // of an earlier jog
        }
        Wish wish(now, ask, refusal_);
        draw_buttons(ui, now, wish);
        obey_keys(ui, now, ask, wish);
        wish.tell();
        draw_speed(ui, now, ask);
        if (!refusal_.empty()) {
            ui.note(with_full_stop("Not possible: " + refusal_));
        }
    }
    connection_.draw_messages(ui, now, ask);
    draw_protections(ui, now);
}

void ArmJogPanel::draw_buttons(Ui& ui, const FrameState& now, Wish& wish) const {
    const auto button = [&](const std::string& name, double sign, int joint) {
        const std::string id = (sign > 0.0 ? "plus_" : "minus_") + name;
        const Rank rank = joint >= 0 && joint == joint_of_keys(now) ? Rank::primary : Rank::normal;
        return ui.hold_button(
            id, name + (sign > 0.0 ? " +" : " \u2212"), can_jog_joint(now, joint), {{}, rank, -1.0F, {}});
    };
    if (now.view_state.manual.arm_frame == ArmFrame::joints) {
        const int joints = now.arm.arm().joint_count(), a_row = is_low(ui) ? 3 : 1;
        for (int first = 0; first < joints; first += a_row) {
            const auto row = ui.row(2 * a_row);
            for (int n = first; n < std::min(first + a_row, joints); ++n) {
                for (const double sign : {-1.0, 1.0}) {
                    const auto held = button(now.arm.arm().joint(n).name, sign, n);
                    wish.joint(n, sign, held.held, held.pressed);
                }
            }
        }
        return;
    }
    constexpr std::array base{"X", "Y", "Z"}, tool{"x", "y", "z"};
    const auto& names = now.view_state.manual.arm_frame == ArmFrame::base ? base : tool;
    for (int axis = 0; axis < 3; ++axis) {
        const auto row = ui.row(2);
        for (const double sign : {-1.0, 1.0}) {
            const auto held = button(names[static_cast<std::size_t>(axis)], sign, -1);
            wish.line(axis, sign, held.held, held.pressed);
        }
    }
}

void ArmJogPanel::draw_speed(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const actions::ManualSettings& manual = now.view_state.manual;
    const auto labels = ui.label_share(0.3F);
    const auto at = std::ranges::find(arm_jog_steps, manual.step);
    const int chosen = at == arm_jog_steps.end() ? 0 : static_cast<int>(at - arm_jog_steps.begin());
    if (const auto step = ui.segmented(
            "step", "Step", chosen, arm_jog_step_options, "Jog increment, degrees or mm per press")) {
        ask.show([step = arm_jog_steps[static_cast<std::size_t>(*step)]](actions::ViewState& view_state) {
            view_state.manual.step = step;
        });
    }
    const widgets::FieldInfo percent{
        "speed",
        "Speed %",
        {},
        "Jog speed, percent of the maximum of 30 \u00b0/s and 150 mm/s; a PMAC is limited to 5 \u00b0/s",
        1.0,
        100.0};
    if (const auto value = widgets::slider(ui, manual.arm_percent, percent)) {
        ask.show([value = *value](actions::ViewState& view_state) { view_state.manual.arm_percent = value; });
    }
    if (const auto on = ui.toggle("keys",
                                  "Keyboard",
                                  manual.arm_keys,
                                  "Keyboard jog. 1 to 5: select joint; + and -: jog while held; /: stop; H: "
                                  "home; K: disable the motors; Q: stop the program; S: send the program; R: "
                                  "run it; I: load settings; colon: terminal; X: turn keyboard jog off")) {
        ask.show([on = *on](actions::ViewState& view_state) { view_state.manual.arm_keys = on; });
    }
    if (const int joint = joint_of_keys(now); joint >= 0) {
        ui.note("Joint " + now.arm.arm().joint(joint).name +
                " jogs while + or \u2212 is held, regardless of the frame and step selected above.");
    }
}

void ArmJogPanel::draw_power(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    if (!now.arm_connected()) {
        return;
    }
    const auto section = ui.section("power", "Motors");
    if (!section) {
        return;
    }
    if (is_low(ui)) {
        const auto row = ui.row(3);
        action_button(ui, now, ask, catalogue_, "arm.enable", Rank::normal, "Power");
        action_button(ui, now, ask, catalogue_, "machine.home");
        action_button(ui, now, ask, catalogue_, "machine.emergency_stop", Rank::danger, "Kill");
        return;
    }
    action_button(ui, now, ask, catalogue_, "arm.enable");
    const auto row = ui.row(2);
    action_button(ui, now, ask, catalogue_, "machine.home");
    action_button(ui, now, ask, catalogue_, "machine.emergency_stop", Rank::danger, "Kill");
}

void ArmJogPanel::stop_all(const FrameState& now, ActionQueue& ask) const {
    ask.arm([](actions::ArmWorkspace& workspace) { workspace.stop(); });
    const bool is_jog = now.connection.status.activity == drivers::Activity::jog;
    if (now.arm_connected() && is_jog) {
        ask.tell([](drivers::Driver& driver) { driver.stop_jog(); });
    } else if (now.arm_connected() && catalogue_.find("machine.stop").permission(now).allowed) {
        ask.run("machine.stop"); // a program, homing, or what was typed
    }
}

void ArmJogPanel::obey_keys(Ui& ui, const FrameState& now, ActionQueue& ask, Wish& wish) {
    if (!now.view_state.manual.arm_keys || ui.was_typing() || now.asks()) {
        return;
    }
    using render::Key;
    if (render::key_pressed(Key::slash)) {
        stop_all(now, ask);
    }
    if (render::key_pressed(Key::semicolon)) { // what comes with it is typed there
        ask.show([](actions::ViewState& view_state) {
            view_state.panes.lower_shown = true;
            view_state.lower_tab_now() = actions::LowerTab::console;
        });
        ui.focus_field("lower/command");
        return;
    }
    const int joints = now.arm.arm().joint_count();
    const int joint = joint_of_keys(now);
    for (int n = 0; n < std::min(joints, 5); ++n) {
        // With Shift, too: where + is Shift and =, it is down while another joint is chosen.
        if (render::key_pressed(static_cast<Key>(static_cast<int>(Key::digit_1) + n))) {
            ask.show([n](actions::ViewState& view_state) { view_state.manual.arm_joint = n; });
        }
    }
    const bool held = render::key_down(Key::equal) || render::key_down(Key::minus);
    key_joint_ = held ? key_joint_ : joint; // another joint begins with another press
    const widgets::Permission jogs = can_jog_joint(now, joint);
    if (!jogs.allowed && (render::key_pressed(Key::equal) || render::key_pressed(Key::minus))) {
        tell_refusal(ask, "+ and \u2212", jogs);
    } else if (jogs.allowed && key_joint_ == joint) {
        for (const auto& [key, sign] : {std::pair(Key::equal, 1.0), std::pair(Key::minus, -1.0)}) {
            wish.joint(joint, sign, render::key_down(key), render::key_pressed(key));
        }
    }
    struct Order {
        Key key;
        std::string_view action;
    };
    constexpr std::array<Order, 6> orders{{{Key::h, "machine.home"},
                                           {Key::k, "machine.emergency_stop"},
                                           {Key::q, "machine.stop"},
                                           {Key::r, "arm.run_program"},
                                           {Key::s, "arm.send_program"},
                                           {Key::i, "arm.card_settings"}}};
    for (const Order& order : orders) {
        if (!render::key_pressed(order.key)) {
            continue;
        }
        const actions::Action& action = catalogue_.find(order.action);
        if (const widgets::Permission may = action.permission(now); may.allowed) {
            ask.run(std::string(order.action));
        } else {
            tell_refusal(ask, action.info().title, may);
        }
    }
    if (render::key_pressed(Key::x)) {
        ask.show([](actions::ViewState& view_state) { view_state.manual.arm_keys = false; });
    }
}

} // namespace millwright::panels
