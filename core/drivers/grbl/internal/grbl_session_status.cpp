// What a session knows, in the words of the Driver interface.
#include "core/drivers/grbl/internal/axis_units.h"
#include "core/drivers/grbl/internal/grbl_session.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::drivers::grbl {

DriverState GrblSession::state() const {
    switch (stage_) {
    case Stage::closed:
    case Stage::greeting:
    case Stage::asking:
        return DriverState::disconnected;
    case Stage::ready:
        return !change_                                                 ? DriverState::idle
               : waits_for_tool() || change_->held || held_at_machine() ? DriverState::holding
                                                                        : DriverState::running;
    case Stage::running:
        return hold_.state != HoldState::none || waits_between_blocks() ? DriverState::holding
                                                                        : DriverState::running;
    case Stage::foreign:
        return hold_.state != HoldState::none ? DriverState::holding : DriverState::running;
    case Stage::asking_again:
        return asking_.then == Stage::stopped                    ? DriverState::stopping
               : (change_ && change_->held) || held_at_machine() ? DriverState::holding
                                                                 : DriverState::running;
    case Stage::jogging:
        return held_at_machine() ? DriverState::holding : DriverState::running;
    case Stage::homing:
        return DriverState::running;
    case Stage::braking:
        return DriverState::stopping;
    case Stage::flushing:
        return message_.empty() ? DriverState::stopping : DriverState::alarm;
    case Stage::stopped:
        return DriverState::stopped;
    case Stage::alarm:
        return DriverState::alarm;
    }
    return DriverState::alarm;
}

Activity GrblSession::activity() const {
    switch (stage_) {
    case Stage::ready:
        return change_ ? Activity::program : Activity::none;
    case Stage::running:
    case Stage::asking_again:
        return at_;
    case Stage::foreign:
        return Activity::program;
    case Stage::jogging:
        return Activity::jog;
    case Stage::homing:
        return Activity::homing;
    default:
        return Activity::none;
    }
}

std::optional<Diagnostic> GrblSession::stranger() const {
    if (stage_ != Stage::alarm || !readout_.settings.empty()) {
        return std::nullopt;
    }
    return Diagnostic{{}, message_, "check the port, and that the controller is switched on"};
}

DriverStatus GrblSession::status() const {
    DriverStatus status;
    status.message = message_;
    status.link_lost = link_lost_;
    status.state = state();
    if (status.state == DriverState::disconnected) {
        return status;
    }
    status.activity = activity();
    status.position_doubt = doubt_.why();
    status.position_lost = doubt_.lost();
    status.position_confirmed = doubt_.confirmed();
    status.answer = answer_;
    show_machine(status);
    show_program(status);
    status.own_lines = own_lines_;
    if (change_) {
        show_change(status);
    }
    return status;
}

void GrblSession::show_machine(DriverStatus& status) const {
    const auto vector = [this](const Axes& axes) { return positions_of(axes, readout_.axes); };
    status.position = vector(readout_.machine_position);
    status.velocity = kinematics::AxisPositions::Zero(std::ssize(readout_.axes));
    status.work_offset = vector(readout_.offset);
    status.feed = feed();
    status.spindle_rpm = readout_.spindle_rpm;
    status.overrides = overrides_.now();
    const Modes& modes = readout_.modes;
    status.modes = modes.text;
    status.work_system = modes.work_system;
    status.spindle = modes.spindle;
    status.coolant.mist = modes.mist;
    status.coolant.flood = modes.flood;
    status.tool = modes.tool;
    const auto pin = [this](char letter) { return readout_.pins.find(letter) != std::string::npos; };
    for (const char axis : readout_.axes) {
        status.inputs.limits.append(pin(axis) ? 1 : 0, axis);
    }
    status.inputs.probe = pin('P');
    status.inputs.door = pin('D');
    status.inputs.hold = pin('H');
    status.inputs.reset = pin('R');
    status.inputs.start = pin('S');
    if (readout_.probings > 0 && readout_.probe) {
        status.probe = Probing{readout_.probings, readout_.probe->touched, vector(readout_.probe->position)};
    }
}

void GrblSession::show_change(DriverStatus& status) const {
    const ProgramLines& program = change_->program;
    const int done = change_->next_line;
    status.sent_blocks = status.executed_blocks = done > 0 ? program.blocks_before(done) : 0;
    status.block = std::min(program.blocks_before(done), program.blocks - 1);
    const bool keeps_zero = changes_->plan.way == ToolChangeWay::probe && tool_length_.reference_z;
    status.tool_change =
        ToolChangeStatus{.waits = waits_for_tool(), .held = change_->held, .keeps_zero = keeps_zero};
    if (stage_ != Stage::running && held_at_machine()) {
        status.message = why_held(report_->state);
    }
    if (change_->stop >= 0) {
        const ToolStop& stop = stop_at_hand();
        status.tool_change->line = stop.line;
        status.tool_change->tool = stop.tool;
        status.message =
            status.message.empty() && waits_for_tool() ? stop.why + what_to_do() : status.message;
    }
}

void GrblSession::show_program(DriverStatus& status) const {
    if (change_) {
        return;
    }
    if (at_ != Activity::program || (program_.lines.empty() && program_.blocks == 0)) {
        return;
    }
    const int executed = tracker_.executed_lines();
    status.sent_blocks =
        next_line_ > 0 ? program_.lines[static_cast<std::size_t>(next_line_ - 1)].block + 1 : 0;
    status.executed_blocks = executed > 0 || program_.lines.empty() ? program_.blocks_before(executed) : 0;
    status.block = std::min(program_.blocks_before(tracker_.line_at_hand()), program_.blocks - 1);
    if (waits_between_blocks() && status.message.empty()) {
        status.message = fmt::format("single block: line {} is next",
                                     program_.lines[static_cast<std::size_t>(next_line_)].line);
    }
}

} // namespace millwright::drivers::grbl
