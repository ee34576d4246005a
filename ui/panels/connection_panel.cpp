#include "ui/panels/connection_panel.h"

#include "core/machine/links/serial_ports.h"
#include "ui/panels/internal/fields.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/notices.h"

#include <algorithm>
#include <array>

namespace millwright::panels {

namespace {

namespace icons = widgets::icons;
using actions::ControllerChoice;
using actions::DriverKind;
using actions::LinkState;
using machine::DriverState;
using widgets::Rank;

constexpr std::array<widgets::Option, 2> kinds{
    {{"virtual", "Virtual machine", {}, "A machine inside this program; nothing is plugged in"},
     {"grbl", "Grbl", {}, "A Grbl 1.1 controller at a serial port or TCP address"}}};

std::string kind_text(DriverKind kind) {
    return kind == DriverKind::grbl ? "Grbl" : "virtual machine";
}

/// What a person should do about an alarm.
std::string advice(const Workbench& now) {
    return now.controller.can.home
               ? "Look at the machine first. Then home it, or unlock it if its position is surely right."
               : "Look at the machine first. Then unlock it.";
}

std::string state_text(const machine::DriverStatus& status) {
    std::string text(machine::to_text(status.state));
    if (status.activity != machine::Activity::none && status.state != DriverState::idle) {
        text += " (" + std::string(machine::to_text(status.activity)) + ")";
    }
    return text;
}

} // namespace

std::string controller_text(const Workbench& now) {
    const actions::ControllerView& machine = now.controller;
    const std::string name = kind_text(machine.choice.kind) +
                             (machine.choice.kind == DriverKind::grbl ? " at " + machine.choice.address : "");
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
    return name + ": " + state_text(machine.status);
}

void ConnectionPanel::look_for_ports() {
    ports_.clear();
    for (const machine::SerialPort& port : machine::serial_ports()) {
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
    const ControllerChoice& choice = now.session.hand.choice;
    const auto choose = [&](ControllerChoice wanted) {
        ask.show([wanted = std::move(wanted)](actions::Session& session) { session.hand.choice = wanted; });
    };
    const auto permitted = ui.permitted(now.controller.link == LinkState::none
                                            ? widgets::Permission{}
                                            : widgets::Permission::refused("It is being connected."));
    if (const auto kind = ui.choice("driver", "Driver", static_cast<int>(choice.kind), kinds)) {
        choose({static_cast<DriverKind>(*kind), choice.address});
    }
    if (choice.kind != DriverKind::grbl) {
        return;
    }
    if (!looked_) {
        look_for_ports();
    }
    if (const auto address = ui.text_field(
            "address", "Port", choice.address, "A serial port such as /dev/ttyUSB0, or tcp:HOST:PORT")) {
        choose({choice.kind, *address});
    }
    std::vector<widgets::Option> options;
    for (const Port& port : ports_) {
        options.push_back({port.path, port.label});
    }
    if (!options.empty()) {
        const auto at = std::ranges::find(ports_, choice.address, &Port::path);
        if (const auto chosen =
                ui.choice("ports", "Found here", static_cast<int>(at - ports_.begin()), options)) {
            choose({choice.kind, ports_[static_cast<std::size_t>(*chosen)].path});
        }
    } else {
        ui.note("No serial port was found on this computer.");
    }
    if (ui.button("look", "Look for ports again", {}, {icons::redo, Rank::quiet, -1.0F, {}})) {
        look_for_ports();
    }
}

void ConnectionPanel::draw_state(Ui& ui, const Workbench& now, ActionQueue& ask) const {
    const actions::ControllerView& machine = now.controller;
    if (machine.failure) {
        const std::string hint = machine.failure->hint.empty() ? "" : " (" + machine.failure->hint + ")";
        (void)widgets::banner(
            ui, "failure", {widgets::Severity::warning, machine.failure->message + hint, {}});
    }
    if (!machine.connected()) {
        action_button(ui, now, ask, catalogue_, "machine.connect", Rank::primary);
        return;
    }
    ui.value("state", kind_text(machine.choice.kind), state_text(machine.status));
    if (machine.choice.kind == DriverKind::grbl) {
        ui.value("port", "Port", machine.choice.address);
    }
    const bool alarm = machine.status.state == DriverState::alarm;
    if (!machine.status.message.empty()) {
        (void)widgets::banner(ui,
                              "message",
                              {alarm ? widgets::Severity::danger : widgets::Severity::warning,
                               machine.status.message + (alarm ? ". " + advice(now) : ""),
                               {}});
    }
    const auto row = ui.row(alarm ? 2 : 1);
    if (alarm) {
        action_button(ui, now, ask, catalogue_, "machine.reset", Rank::primary);
    }
    action_button(ui, now, ask, catalogue_, "machine.disconnect");
}

} // namespace millwright::panels
