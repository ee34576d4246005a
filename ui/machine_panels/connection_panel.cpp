#include "ui/machine_panels/connection_panel.h"

#include "core/base/sentences.h"
#include "core/links/serial_link.h"
#include "ui/machine_panels/manual_position_fields.h"
#include "ui/panels/fields.h"
#include "ui/panels/serial_fields.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/notices.h"
#include "ui/workspaces/arm_workspace.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <string_view>
#include <variant>
#include <vector>

namespace millwright::panels {

namespace {

namespace icons = widgets::icons;
using actions::LinkState;
using drivers::DriverState;
using machine::DriverChoice;
using machine::DriverField;
using machine::DriverRow;
using widgets::Rank;

std::vector<widgets::Option> driver_options() {
    std::vector<widgets::Option> options;
    for (const DriverRow& row : machine::driver_rows()) {
        options.push_back({row.name, row.label, {}, row.tip});
    }
    return options;
}

int index_of(const DriverRow& row) {
    const auto rows = machine::driver_rows();
    return static_cast<int>(std::ranges::find(rows, row.name, &DriverRow::name) - rows.begin());
}

/// Changes one thing of what was chosen.
template <class Change> void change_manual_settings(ActionQueue& ask, Change&& change) {
    ask.show([change = std::forward<Change>(change)](actions::ViewState& view_state) {
        change(view_state.manual);
    });
}

/// What a person should do about an alarm.
std::string advice(const FrameState& now) {
    if (now.connection.status.link_lost) {
        return "Inspect the machine, then reconnect. Reconnecting does not move it.";
    }
    if (const std::string_view of_driver = now.connection.row().in_alarm; !of_driver.empty()) {
        return std::string(of_driver);
    }
    return now.connection.can.manual.home
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

/// The counts per degree are those of one arm's drives, whichever arm is drawn.
void draw_note(Ui& ui, const FrameState& now, const DriverRow& row) {
    if (!row.arm.empty() && now.arm.loaded() && now.arm.name() != row.arm) {
        (void)widgets::banner(ui,
                              "other_arm",
                              {widgets::Severity::warning,
                               fmt::format("The card uses the counts per degree of a Motoman L-3, but joints "
                                           "and limits would be those of the displayed arm, '{}'.",
                                           now.arm.arm().name()),
                               {}});
    } else if (!row.note.empty()) {
        ui.note(row.note);
    }
}

/// Draws the field of each kind, and asks for the change that was committed.
class FieldDrawing {
public:
    FieldDrawing(Ui& ui, const DriverChoice& choice, ActionQueue& ask, const DriverField& field)
        : ui_(ui), choice_(choice), ask_(ask), field_(field) {}

    void operator()(const machine::ToggleField& of) const {
        change(ui_.toggle(field_.id, field_.label, of.value(choice_), field_.tip), of.set);
    }
    void operator()(const machine::TextField& of) const {
        change(ui_.text_field(field_.id, field_.label, of.value(choice_), field_.tip), of.set);
    }
    void operator()(const machine::LineEndField& of) const {
        change(ending_field(ui_, of.value(choice_)), of.set);
    }
    void operator()(const machine::NumberField& of) const {
        const widgets::FieldInfo info{
            field_.id, field_.label, of.unit, field_.tip, of.least, of.most, of.usual, of.decimals};
        change(ui_.number(of.value(choice_), info), of.set);
    }

private:
    template <class Value, class Set> void change(const std::optional<Value>& value, Set set) const {
        if (value) {
            change_manual_settings(
                ask_, [value = *value, set](actions::ManualSettings& manual) { set(manual.choice, value); });
        }
    }

    Ui& ui_;
    const DriverChoice& choice_;
    ActionQueue& ask_;
    const DriverField& field_;
};

} // namespace

std::string controller_text(const FrameState& now) {
    const actions::ConnectionView& machine = now.connection;
    const std::string name = std::string(machine.row().within_a_text) +
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

std::string alarm_text(const FrameState& now) {
    const drivers::DriverStatus& status = now.connection.status;
    if (!now.connection.connected() || status.state != DriverState::alarm) {
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

void ConnectionPanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto section = ui.section("connection", "Machine");
    if (!section) {
        return;
    }
    if (!now.connection.connected()) {
        draw_choice(ui, now, ask);
    }
    draw_state(ui, now, ask);
}

void ConnectionPanel::draw_choice(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const DriverChoice& choice = now.view_state.manual.choice;
    const auto permitted =
        ui.permitted(now.connection.link == LinkState::none
                         ? widgets::Permission{}
                         : widgets::Permission::refused("The machine is being connected."));
    const DriverRow& row = machine::driver_row(choice.driver);
    if (const auto chosen = ui.choice("driver", "Driver", index_of(row), driver_options())) {
        const std::string_view name = machine::driver_rows()[static_cast<std::size_t>(*chosen)].name;
        change_manual_settings(ask, [name](actions::ManualSettings& manual) { choose_driver(manual, name); });
    }
    if (row.address) {
        draw_address(ui, now, ask);
    }
    for (const DriverField& field : row.fields) {
        std::visit(FieldDrawing(ui, choice, ask, field), field.value);
    }
    draw_note(ui, now, row);
}

void ConnectionPanel::draw_address(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const DriverChoice& choice = now.view_state.manual.choice;
    const machine::DriverAddress& of = *machine::driver_row(choice.driver).address;
    if (const auto address = ui.text_field("address", of.label, choice.address, of.tip)) {
        change_manual_settings(
            ask, [address = *address](actions::ManualSettings& manual) { manual.choice.address = address; });
    }
    if (of.serial) {
        draw_ports(ui, now, ask);
        if (const auto address = serial_fields(ui, choice.address)) {
            change_manual_settings(ask, [address = *address](actions::ManualSettings& manual) {
                manual.choice.address = address;
            });
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

void ConnectionPanel::draw_ports(Ui& ui, const FrameState& now, ActionQueue& ask) {
    if (!looked_) {
        look_for_ports();
    }
    if (ports_.empty()) {
        ui.note("No serial ports were found on this computer.");
    } else {
        const auto chosen_port = serial_port_of(now.view_state.manual.choice.address);
        std::vector<widgets::Option> options{{"none", "Choose ..."}};
        int at = 0;
        for (const Port& port : ports_) {
            at = chosen_port && port.path == chosen_port->path ? static_cast<int>(options.size()) : at;
            options.push_back({port.path, port.label});
        }
        if (const auto chosen = ui.choice("ports", "Detected", at, options); chosen && *chosen > 0) {
            change_manual_settings(
                ask,
                [path = ports_[static_cast<std::size_t>(*chosen) - 1].path](actions::ManualSettings& manual) {
                    manual.choice.address = at_path(manual.choice.address, path);
                });
        }
    }
    if (ui.button("look", "Rescan ports", {}, {icons::redo, Rank::quiet, -1.0F, {}})) {
        look_for_ports();
    }
}

bool ConnectionPanel::warns(const actions::ConnectionView& machine) {
    return machine.status.state != DriverState::alarm && !machine.status.message.empty();
}

bool ConnectionPanel::has_messages(const actions::ConnectionView& machine) {
    return machine.connected() && (warns(machine) || !machine.status.position_doubt.empty() ||
                                   needs_manual_position(machine) || !machine.remarks.empty());
}

void ConnectionPanel::draw_messages(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const actions::ConnectionView& machine = now.connection;
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
        if (machine.can.reports.position) {
            action_button(ui, now, ask, catalogue_, "machine.trust_position");
        }
    }
    if (needs_manual_position(machine)) {
        manual_position_fields(ui, now, ask);
    }
    for (const std::string& remark : machine.remarks) {
        ui.note(remark);
    }
}

void ConnectionPanel::draw_state(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const actions::ConnectionView& machine = now.connection;
    const DriverChoice& chosen =
        now.view_state.manual.choice; // a link that is no longer wanted is not reported
    const bool is_of_it = machine.link != LinkState::none || (machine.choice.driver == chosen.driver &&
                                                              machine.choice.address == chosen.address);
    if (machine.failure && is_of_it) {
        const std::string hint = machine.failure->hint.empty() ? "" : " (" + machine.failure->hint + ")";
        (void)widgets::banner(
            ui, "failure", {widgets::Severity::warning, capitalised(machine.failure->message) + hint, {}});
    }
    if (!machine.connected()) {
        action_button(ui, now, ask, catalogue_, "machine.connect", Rank::primary);
        return;
    }
    ui.value(
        "state", capitalised(std::string(machine.row().within_a_text)), driver_state_text(machine.status));
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
