#include "ui/panels/connection_panel.h"

#include "core/base/sentences.h"
#include "core/links/serial_ports.h"
#include "ui/actions/arm_bench.h"
#include "ui/panels/internal/fields.h"
#include "ui/panels/serial_fields.h"
#include "ui/panels/stands_fields.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/notices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>

namespace millwright::panels {

namespace {

namespace icons = widgets::icons;
using actions::LinkState;
using drivers::DriverState;
using machine::DriverChoice;
using machine::DriverKind;
using widgets::Rank;

constexpr std::array<widgets::Option, 7> driver_kind_options{
    {{"virtual", "Virtual machine", {}, "Simulated machine; no hardware required"},
     {"grbl", "Grbl", {}, "Grbl 1.1, grblHAL or FluidNC controller on a serial port or TCP address"},
     {"linuxcnc", "LinuxCNC", {}, "A running LinuxCNC, connected through linuxcncrsh"},
     {"stream",
      "Coordinate stream",
      {},
      "Machine that receives axis positions at a fixed rate and sends no feedback"},
     {"cordic",
      "CORDIC processor",
      {},
      "Simulated G-code processor with a simulated machine; X, Y and Z only"},
     {"records",
      "Record-based XYZ table",
      {},
      "XYZ table that takes one record per move, such as t x y z a s"},
     {"pmac", "PMAC", {}, "Motor controller card of a robot arm, on a serial port or TCP address"}}};

std::string kind_text(DriverKind kind) {
    return kind == DriverKind::virtual_machine ? "virtual machine"
           : kind == DriverKind::stream        ? "coordinate stream"
           : kind == DriverKind::records
               ? "XYZ table"
               : std::string(driver_kind_options[static_cast<std::size_t>(kind)].label);
}

/// Changes one thing of what was chosen.
template <class Change> void change_hand_settings(ActionQueue& ask, Change&& change) {
    ask.show([change = std::forward<Change>(change)](actions::Session& session) { change(session.hand); });
}

/// What a person should do about an alarm.
std::string advice(const Workbench& now) {
    if (now.controller.status.link_lost) {
        return "Inspect the machine, then reconnect. Reconnecting does not move it.";
    }
    if (now.controller.choice.kind == DriverKind::pmac) {
        return "Inspect the arm, then unlock it. Unlocking does not enable the motors.";
    }
    if (now.controller.choice.kind == DriverKind::linuxcnc) { // which homes once it is switched on
        return "Inspect the machine and unlock it, then home it unless you are sure the position is correct.";
    }
    return now.controller.can.home
               ? "Inspect the machine, then home it - or unlock it if you are sure the position is correct."
               : "Inspect the machine, then unlock it.";
}

std::string_view position_text(const drivers::DriverStatus& status) {
    return !status.position_known           ? "unknown"
           : !status.position_doubt.empty() ? "not verified"
           : status.link_lost               ? "last reported"
                                            : "known";
}

std::string driver_state_text(const drivers::DriverStatus& status) {
    std::string text(to_text(status.state));
    if (status.activity != drivers::Activity::none && status.state != DriverState::idle) {
        text += " (" + std::string(to_text(status.activity)) + ")";
    }
    return text;
}

/// The counts of a degree are those of one arm's drives, whichever arm is drawn.
void draw_arm_of_card(Ui& ui, const Workbench& now) {
    constexpr std::string_view own = "motoman-l3";
    if (now.arm.loaded() && now.arm.name() != own) {
        (void)widgets::banner(ui,
                              "other_arm",
                              {widgets::Severity::warning,
                               fmt::format("The card uses the counts per degree of a Motoman L-3, but joints "
                                           "and limits would be those of the displayed arm, '{}'.",
                                           now.arm.arm().name()),
                               {}});
    } else {
        ui.note("Drives the joints of a Motoman L-3. Connecting does not move the arm.");
    }
}

} // namespace

std::string controller_text(const Workbench& now) {
    const actions::ControllerView& machine = now.controller;
    const std::string name = kind_text(machine.choice.kind) +
                             (machine.choice.address.empty() ? "" : " at " + machine.choice.address);
    switch (machine.link) {
    case LinkState::none:
        return "no machine connected";
    case LinkState::connecting:
        return "connecting to " + name + " \u2026";
    case LinkState::closing:
        return "disconnecting \u2026";
    case LinkState::connected:
        break;
    }
    return name + ": " + driver_state_text(machine.status) +
           (machine.status.position_known ? "" : ", position unknown");
}

std::string alarm_text(const Workbench& now) {
    const drivers::DriverStatus& status = now.controller.status;
    if (!now.controller.connected() || status.state != DriverState::alarm) {
        return "";
    }
    return with_sentence(status.message.empty() ? "Alarm" : capitalised(status.message), advice(now));
}

void ConnectionPanel::look_for_ports() {
    ports_.clear();
    for (const links::SerialPort& port : links::serial_ports()) {
        const std::string path = port.path.string();
        ports_.push_back(
            {path, port.label.empty() ? path : port.path.filename().string() + ", " + port.label});
    }
    looked_ = true;
}

void ConnectionPanel::draw(Ui& ui, const Workbench& now, ActionQueue& ask) {
    const auto section = ui.section("connection", "Machine");
    if (!section) {
        return;
    }
    if (!now.controller.connected()) {
        draw_choice(ui, now, ask);
    }
    draw_state(ui, now, ask);
}

void ConnectionPanel::draw_choice(Ui& ui, const Workbench& now, ActionQueue& ask) {
    const DriverChoice& choice = now.session.hand.choice;
    const auto permitted =
        ui.permitted(now.controller.link == LinkState::none
                         ? widgets::Permission{}
                         : widgets::Permission::refused("The machine is being connected."));
    if (const auto kind = ui.choice("driver", "Driver", static_cast<int>(choice.kind), driver_kind_options)) {
        change_hand_settings(ask, [kind = *kind](actions::HandSettings& hand) {
            hand.addresses[static_cast<std::size_t>(hand.choice.kind)] = hand.choice.address;
            hand.choice.kind = static_cast<DriverKind>(kind);
            hand.choice.address = hand.addresses[static_cast<std::size_t>(kind)];
        });
    }
    if (choice.kind == DriverKind::virtual_machine || choice.kind == DriverKind::cordic) {
        return;
    }
    draw_address(ui, now, ask);
    if (choice.kind == DriverKind::grbl) {
        if (const auto on = ui.toggle("one_by_one",
                                      "Send line by line",
                                      choice.one_by_one,
                                      "Wait for the response to each line before sending the next. Slower; "
                                      "for controllers with a small buffer")) {
            change_hand_settings(ask,
                                 [on = *on](actions::HandSettings& hand) { hand.choice.one_by_one = on; });
        }
    } else if (choice.kind == DriverKind::linuxcnc) {
        if (const auto axes = ui.text_field(
                "axes", "Axes", choice.axes, "Axis letters of the machine: XYZ, followed by any of ABC")) {
            change_hand_settings(ask,
                                 [axes = *axes](actions::HandSettings& hand) { hand.choice.axes = axes; });
        }
    } else if (choice.kind == DriverKind::records) {
        draw_records(ui, now, ask);
    } else if (choice.kind == DriverKind::pmac) {
        if (const auto on = ui.toggle("fifth_axis",
                                      "Axis 5",
                                      choice.axes.find('B') != std::string::npos,
                                      "Motor 5 drives joint 5, on a second row of outputs or simulated in "
                                      "the card; the card must be configured for it")) {
            change_hand_settings(
                ask, [on = *on](actions::HandSettings& hand) { hand.choice.axes = on ? "XYZAB" : "XYZA"; });
        }
        draw_arm_of_card(ui, now);
    } else {
        const widgets::FieldInfo info{"period", "Period", "ms", "Sample period", 0.5, 1000.0, 10.0, 1};
        if (const auto ms = ui.number(1e3 * choice.period, info)) {
            change_hand_settings(ask,
                                 [ms = *ms](actions::HandSettings& hand) { hand.choice.period = 1e-3 * ms; });
        }
        ui.note("This machine sends no feedback. It must be at zero when it is connected.");
    }
}

void ConnectionPanel::draw_records(Ui& ui, const Workbench& now, ActionQueue& ask) const {
    const drivers::RecordFormat format = now.session.hand.choice.record.value_or(drivers::RecordFormat());
    const auto change = [&](const std::function<void(drivers::RecordFormat&)>& what) {
        change_hand_settings(ask, [what](actions::HandSettings& hand) {
            drivers::RecordFormat changed = hand.choice.record.value_or(drivers::RecordFormat());
            what(changed);
            hand.choice.record = changed;
        });
    };
    if (const auto pattern =
            ui.text_field("record",
                          "Record",
                          format.pattern,
                          "Record format: axis letters in braces, {s} speed, {a} acceleration")) {
        change([text = *pattern](drivers::RecordFormat& f) { f.pattern = text; });
    }
    if (const auto ending = ending_field(ui, format.ending)) {
        change([bytes = *ending](drivers::RecordFormat& f) { f.ending = bytes; });
    }
    if (const auto answer =
            ui.text_field("answer", "Response", format.answer, "Response to each record; empty: none")) {
        change([text = *answer](drivers::RecordFormat& f) { f.answer = text; });
    }
    if (const auto on =
            ui.toggle("relative", "Relative", format.relative, "Records contain distances, not positions")) {
        change([on = *on](drivers::RecordFormat& f) { f.relative = on; });
    }
    ui.note("When it is connected, the table must be at the start point of the program, otherwise at zero.");
}

void ConnectionPanel::draw_address(Ui& ui, const Workbench& now, ActionQueue& ask) {
    const DriverChoice& choice = now.session.hand.choice;
    const bool shell = choice.kind == DriverKind::linuxcnc;
    const std::string_view tip = shell ? "tcp:HOST:PORT of linuxcncrsh; the usual port is 5007"
                                 : choice.kind == DriverKind::grbl || choice.kind == DriverKind::pmac
                                     ? "Serial port such as /dev/ttyUSB0, or tcp:HOST:PORT"
                                     : "Serial port such as /dev/ttyUSB0, tcp:HOST:PORT, or file:PATH";
    if (const auto address = ui.text_field("address", shell ? "Address" : "Port", choice.address, tip)) {
        change_hand_settings(
            ask, [address = *address](actions::HandSettings& hand) { hand.choice.address = address; });
    }
    if (!shell) {
        draw_ports(ui, now, ask);
        if (const auto address = serial_fields(ui, choice.address)) {
            change_hand_settings(
                ask, [address = *address](actions::HandSettings& hand) { hand.choice.address = address; });
        }
    }
}

namespace {

/// Another port, with the line that was set.
std::string at_path(const std::string& address, const std::string& path) {
    const auto now = serial_port_of(address);
    return links::address_of({path, now ? now->line : links::SerialLine{}});
}

} // namespace

void ConnectionPanel::draw_ports(Ui& ui, const Workbench& now, ActionQueue& ask) {
    if (!looked_) {
        look_for_ports();
    }
    if (ports_.empty()) {
        ui.note("No serial ports were found on this computer.");
    } else {
        const auto chosen_port = serial_port_of(now.session.hand.choice.address);
        std::vector<widgets::Option> options{{"none", "Choose ..."}};
        int at = 0;
        for (const Port& port : ports_) {
            at = chosen_port && port.path == chosen_port->path ? static_cast<int>(options.size()) : at;
            options.push_back({port.path, port.label});
        }
        if (const auto chosen = ui.choice("ports", "Detected", at, options); chosen && *chosen > 0) {
            change_hand_settings(
                ask,
                [path = ports_[static_cast<std::size_t>(*chosen) - 1].path](actions::HandSettings& hand) {
                    hand.choice.address = at_path(hand.choice.address, path);
                });
        }
    }
    if (ui.button("look", "Rescan ports", {}, {icons::redo, Rank::quiet, -1.0F, {}})) {
        look_for_ports();
    }
}

bool ConnectionPanel::warns(const actions::ControllerView& machine) {
    return machine.status.state != DriverState::alarm && !machine.status.message.empty();
}

bool ConnectionPanel::has_messages(const actions::ControllerView& machine) {
    return machine.connected() && (warns(machine) || !machine.status.position_doubt.empty() ||
                                   asks_where_it_stands(machine) || !machine.remarks.empty());
}

void ConnectionPanel::draw_messages(Ui& ui, const Workbench& now, ActionQueue& ask) const {
    const actions::ControllerView& machine = now.controller;
    if (!has_messages(machine)) {
        return;
    }
    const auto section = ui.section("messages", "Controller messages");
    if (!section) {
        return;
    }
    if (warns(machine)) {
        (void)widgets::banner(
            ui, "message", {widgets::Severity::warning, as_sentence(machine.status.message), {}});
    }
    if (!machine.status.position_doubt.empty()) {
        ui.note(drivers::doubt_sentence(machine.status.position_doubt));
        if (!machine.can.told_place) {
            action_button(ui, now, ask, catalogue_, "machine.trust_position");
        }
    }
    if (asks_where_it_stands(machine)) {
        stands_fields(ui, now, ask);
    }
    for (const std::string& remark : machine.remarks) {
        ui.note(remark);
    }
}

void ConnectionPanel::draw_state(Ui& ui, const Workbench& now, ActionQueue& ask) const {
    const actions::ControllerView& machine = now.controller;
    const DriverChoice& chosen = now.session.hand.choice; // a link that nobody wants any more is not told of
    const bool is_of_it = machine.link != LinkState::none ||
                          (machine.choice.kind == chosen.kind && machine.choice.address == chosen.address);
    if (machine.failure && is_of_it) {
        const std::string hint = machine.failure->hint.empty() ? "" : " (" + machine.failure->hint + ")";
        (void)widgets::banner(
            ui, "failure", {widgets::Severity::warning, capitalised(machine.failure->message) + hint, {}});
    }
    if (!machine.connected()) {
        action_button(ui, now, ask, catalogue_, "machine.connect", Rank::primary);
        return;
    }
    ui.value("state", capitalised(kind_text(machine.choice.kind)), driver_state_text(machine.status));
    ui.value("position_known", "Position", position_text(machine.status));
    if (!machine.firmware.empty()) {
        ui.value("firmware", "Firmware", machine.firmware);
    }
    constexpr float address_label = 0.12F; // addresses are long
    const auto labels = ui.label_share(address_label);
    if (!machine.choice.address.empty()) {
        ui.value("port", "At", machine.choice.address);
    }
    const bool alarm = machine.status.state == DriverState::alarm;
    const auto row = ui.row(alarm ? 2 : 1);
    if (alarm) {
        action_button(ui,
                      now,
                      ask,
                      catalogue_,
                      machine.status.link_lost ? "machine.reconnect" : "machine.reset",
                      Rank::primary);
    }
    action_button(ui, now, ask, catalogue_, "machine.disconnect");
}

} // namespace millwright::panels
