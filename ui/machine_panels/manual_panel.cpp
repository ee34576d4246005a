#include "ui/machine_panels/manual_panel.h"

#include "core/base/text.h"
#include "core/base/units.h"
#include "core/drivers/mdi_lines.h"
#include "ui/machine_panels/internal/pad_axes.h"
#include "ui/machine_panels/manual_fields.h"
#include "ui/panels/fields.h"
#include "ui/render/imgui_compat.h"
#include "ui/widgets/readout.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <utility>
#include <vector>

namespace millwright::panels {

namespace {

using actions::ConnectionView;
using actions::JogWish;
using kinematics::AxisKind;
using widgets::Permission;
using widgets::Rank;

constexpr std::array<double, 5> jog_steps{0.0, 0.01, 0.1, 1.0, 10.0};
constexpr std::array<widgets::Option, 5> jog_step_options{
    {{"hold", "Hold", {}, "Continuous: moves while the button is held"},
     {"0_01", "0.01"},
     {"0_1", "0.1"},
     {"1", "1"},
     {"10", "10"}}};

std::string letter_of(const program::ProgramAxis& axis) {
    return std::string(1, axis.letter);
}

bool is_rotary(const program::ProgramAxis& axis) {
    return axis.kind == AxisKind::rotary;
}

Permission can_jog_axis(const FrameState& now, char axis) {
    if (now.job.running && !actions::waits_for_tool(now.connection.status)) {
        return Permission::refused("A job is running.");
    }
    if (!now.connection.can.manual.jog) {
        return Permission::refused("This machine cannot jog.");
    }
    const std::string_view some = now.connection.can.manual.jog_axes;
    if (!some.empty() && some.find(axis) == std::string_view::npos) {
        return Permission::refused("This machine can only jog " + std::string(some) + ".");
    }
    const bool jogging = now.connection.status.activity == drivers::Activity::jog;
    return jogging ? Permission{} : at_rest(now.connection);
}

widgets::AxisState jog_axis_state(const drivers::DriverStatus& machine, const std::string& letter) {
    if (machine.link_lost) {
        return widgets::AxisState::old;
    }
    if (machine.inputs.limits.find(letter) != std::string::npos) {
        return widgets::AxisState::at_switch;
    }
    const bool known = machine.position_known && machine.position_doubt.empty();
    return known ? widgets::AxisState::normal : widgets::AxisState::not_homed;
}

/// How far the position can be trusted, and why digits are red.
std::pair<std::string, widgets::Tone> position_words(const ConnectionView& machine) {
    using widgets::Tone;
    const drivers::DriverStatus& status = machine.status;
    const std::string& pressed = status.inputs.limits;
    const bool doubt = !status.position_doubt.empty();
    if (status.link_lost) {
        return {"The link is lost: last reported position.", Tone::danger};
    }
    if (!pressed.empty()) {
        return {(doubt ? "Limit switch " + pressed + "; not verified: home or confirm."
                       : "Limit switch pressed: " + pressed),
                Tone::danger};
    }
    if (!machine.can.reports.position) {
        return doubt ? std::pair{"Not verified: read and enter the position.", Tone::warning}
               : status.position_known ? std::pair{"Entered manually, not reported.", Tone::muted}
                                       : std::pair{"Assumed, not reported.", Tone::muted};
    }
    return doubt ? std::pair{"Position not verified: home or confirm it.", Tone::warning}
                 : std::pair{"Reported by the controller.", Tone::muted};
}

/// Collects what is held down in this frame.
class Wish {
public:
    Wish(const FrameState& now, ActionQueue& ask)
        : machine_(now.connection), manual_(now.view_state.manual), ask_(ask),
          direction_(kinematics::AxisPositions::Zero(static_cast<Eigen::Index>(now.connection.axes.size()))) {
    }

    /// Held in this frame, and whether it went down in it. `amount`: -1 to 1, of the speed.
    void want(std::size_t axis, double amount, bool held, bool pressed) {
        const auto n = static_cast<Eigen::Index>(axis);
        if (manual_.step > 0.0) {
            if (pressed) {
                step(axis, amount > 0.0 ? 1.0 : -1.0);
            }
        } else if (held) {
            direction_[n] = amount;
            turns_ = turns_ || is_rotary(machine_.axes[axis]);
        }
    }

    void tell() const {
        const double most = direction_.size() > 0 ? direction_.cwiseAbs().maxCoeff() : 0.0;
        if (most > 0.0) {
            ask_.jog(JogWish{direction_ / most, most * speed(turns_)});
        }
    }

private:
    [[nodiscard]] double speed(bool turns) const {
        return turns ? from_degrees(manual_.turn_deg_per_min) / seconds_per_minute
                     : manual_.speed_mm_per_min / seconds_per_minute;
    }

    void step(std::size_t axis, double sign) const {
        const bool turns = is_rotary(machine_.axes[axis]);
        drivers::Jog jog;
        jog.way = kinematics::AxisPositions::Zero(direction_.size());
        jog.way[static_cast<Eigen::Index>(axis)] = sign * (turns ? from_degrees(manual_.step) : manual_.step);
        jog.speed = speed(turns);
        ask_.tell([jog](drivers::Driver& driver) { driver.jog(jog); });
    }

    const ConnectionView& machine_;
    const actions::ManualSettings& manual_;
    ActionQueue& ask_;
    kinematics::AxisPositions direction_;
    bool turns_ = false;
};

void jog_button(Ui& ui, const FrameState& now, Wish& wish, std::size_t axis, double sign) {
    const std::string letter = letter_of(now.connection.axes[axis]);
    const std::string id = (sign > 0.0 ? "plus_" : "minus_") + letter;
    const std::string label = letter + (sign > 0.0 ? "+" : "\u2212");
    const widgets::HeldButton now_held = ui.hold_button(
        id, label, can_jog_axis(now, now.connection.axes[axis].letter), {{}, Rank::normal, -1.0F, {}});
    wish.want(axis, sign, now_held.held, now_held.pressed);
}

void key_wishes(Ui& ui, const FrameState& now, Wish& wish) {
    if (!now.view_state.manual.keys_armed || ui.was_typing() || now.asks()) {
        return;
    }
    ui.keep_keys_from_widgets(); // an arrow that jogs would also go to another button, for the space bar to
                                 // press
    struct KeyAxis {
        render::Key key;
        char letter;
        double sign;
    };
    constexpr std::array<KeyAxis, 6> keys{{{render::Key::right, 'X', 1.0},
                                           {render::Key::left, 'X', -1.0},
                                           {render::Key::up, 'Y', 1.0},
                                           {render::Key::down, 'Y', -1.0},
                                           {render::Key::page_up, 'Z', 1.0},
                                           {render::Key::page_down, 'Z', -1.0}}};
    for (const KeyAxis& key : keys) {
        const auto axis = axis_named(now.connection, key.letter);
        if (axis && can_jog_axis(now, key.letter).allowed) {
            wish.want(*axis, key.sign, render::key_down(key.key), render::key_pressed(key.key));
        }
    }
}

/// `before`: what it wanted in the last frame.
void pad_wishes(const FrameState& now, Wish& wish, std::vector<double>& before) {
    const bool listens = now.view_state.manual.pad_armed && now.gamepad && !now.asks();
    const auto& axes = now.connection.axes;
    std::vector<double> amounts = listens ? pad_axes(*now.gamepad, axes) : std::vector<double>();
    amounts.resize(axes.size(), 0.0);
    before.resize(axes.size(), 0.0);
    for (std::size_t n = 0; n < axes.size(); ++n) {
        const bool held = std::abs(amounts[n]) > 0.0 && can_jog_axis(now, axes[n].letter).allowed;
        const bool rested = !(std::abs(before[n]) > 0.0);
        if (held) {
            wish.want(n, amounts[n], true, rested);
        }
    }
    before = std::move(amounts);
}

/// Sets work zeros at the present position.
void zero_buttons(Ui& ui, const ConnectionView& machine, ActionQueue& ask) {
    const Permission can = can_command(machine);
    std::string all;
    {
        const auto row = ui.row(static_cast<int>(machine.axes.size()) + 1);
        for (const program::ProgramAxis& axis : machine.axes) {
            const std::string line = drivers::set_work_position(axis, 0.0);
            all += line + "\n";
            const std::string letter = letter_of(axis);
            if (ui.button("zero_" + letter,
                          letter + " = 0",
                          can,
                          {{}, Rank::normal, -1.0F, "Set the current position as work zero of this axis"})) {
                command(ask, line);
            }
        }
        if (ui.button("zero_all",
                      "All",
                      can,
                      {{}, Rank::normal, -1.0F, "Set the current position as work zero of all axes"})) {
            command(ask, all);
        }
    }
}

} // namespace

void ManualPanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    draw_position(ui, now, ask);
    if (now.arm_connected()) {
        ui.note("Jogging, taught points and arm programs are in the Arm workspace.");
        action_button(ui, now, ask, catalogue_, "view.arm", Rank::normal, "Arm workspace");
        return;
    }
    draw_jog(ui, now, ask);
}

void ManualPanel::draw_position(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto section = ui.section("position", "Position");
    const ConnectionView& machine = now.connection;
    const auto count = static_cast<Eigen::Index>(machine.axes.size());
    if (!section) {
        return;
    }
    if (machine.status.position.size() != count || count == 0) {
        ui.note("The machine has not reported its position.");
        return;
    }
    const kinematics::AxisPositions work = machine.status.work_position();
    std::vector<std::string> letters;
    for (const program::ProgramAxis& axis : machine.axes) {
        letters.push_back(letter_of(axis));
    }
    std::vector<widgets::AxisReading> axes;
    for (std::size_t n = 0; n < letters.size(); ++n) {
        const auto k = static_cast<Eigen::Index>(n);
        const bool turns = is_rotary(machine.axes[n]);
        widgets::AxisReading reading;
        reading.letter = letters[n];
        reading.value = turns ? to_degrees(work[k]) : work[k];
        reading.unit = turns ? "\u00b0" : "mm";
        reading.second = turns ? to_degrees(machine.status.position[k]) : machine.status.position[k];
        reading.state = jog_axis_state(machine.status, letters[n]);
        axes.push_back(reading);
    }
    const std::string system = machine.status.work_system > 0
                                   ? drivers::work_system_name(machine.status.work_system) + ", machine"
                                   : std::string("work, machine");
    if (now.arm_connected()) { // joints have no work offsets
        for (widgets::AxisReading& reading : axes) {
            reading.second.reset();
        }
        widgets::readout(ui, "axes", axes);
        return;
    }
    widgets::readout(ui, "axes", axes, system);
    const auto [words, tone] = position_words(machine);
    ui.words(words, tone); // always one line, so that no button below moves while a hand goes to it
    zero_buttons(ui, machine, ask);
}

void ManualPanel::draw_jog(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto section = ui.section("jog", "Jog");
    if (!section) {
        return;
    }
    Wish wish(now, ask);
    for (std::size_t axis = 0; axis < now.connection.axes.size(); axis += 2) {
        const auto row = ui.row(4);
        for (std::size_t n = axis; n < std::min(axis + 2, now.connection.axes.size()); ++n) {
            jog_button(ui, now, wish, n, -1.0);
            jog_button(ui, now, wish, n, 1.0);
        }
    }
    key_wishes(ui, now, wish);
    pad_wishes(now, wish, pad_before_);
    wish.tell();
    draw_hands(ui, now, ask);
}

/// How far and how fast, and by what besides the mouse.
void ManualPanel::draw_hands(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const actions::ManualSettings& manual = now.view_state.manual;
    const auto chosen_step = std::ranges::find(jog_steps, manual.step);
    const auto labels = ui.label_share(0.3F);
    if (const auto step = ui.segmented("step",
                                       "Step",
                                       static_cast<int>(chosen_step - jog_steps.begin()),
                                       jog_step_options,
                                       "Jog increment, mm or degrees per press")) {
        ask.show([step = jog_steps[static_cast<std::size_t>(*step)]](actions::ViewState& view_state) {
            view_state.manual.step = step;
        });
    }
    manual_number(ui,
                  ask,
                  {"speed", "Speed", "mm/min", "Jog speed of X, Y and Z", 1.0, 20000.0, no_default, 0},
                  manual.speed_mm_per_min,
                  &actions::ManualSettings::speed_mm_per_min);
    const bool turns = std::ranges::any_of(now.connection.axes, is_rotary);
    if (turns) {
        manual_number(ui,
                      ask,
                      {"turn",
                       "Rotary speed",
                       "\u00b0/min",
                       "Jog speed of the rotary axes",
                       1.0,
                       20000.0,
                       no_default,
                       0},
                      manual.turn_deg_per_min,
                      &actions::ManualSettings::turn_deg_per_min);
    }
    const actions::Action& arm = catalogue_.find("machine.arm_keys");
    if (const auto on =
            ui.toggle("keys", "Keyboard", manual.keys_armed, arm.info().tip, arm.permission(now))) {
        ask.run("machine.arm_keys");
    }
    const actions::Action& pad = catalogue_.find("machine.arm_gamepad");
    if (const auto on = ui.toggle("pad", "Gamepad", manual.pad_armed, pad.info().tip, pad.permission(now))) {
        ask.run("machine.arm_gamepad");
    }
    if (manual.pad_armed) {
        ui.note(now.gamepad ? "Hold a bumper. Left stick: X and Y; right stick: Z; D-pad: rotary axes."
                            : "No gamepad is connected.");
    }
}

} // namespace millwright::panels
