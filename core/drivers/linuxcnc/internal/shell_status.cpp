// What a session knows, in the words of the Driver interface.
#include "core/drivers/linuxcnc/internal/shell_session.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace millwright::drivers::linuxcnc {

using kinematics::AxisPositions;

DriverState ShellSession::state() const {
    switch (stage_) {
    case Stage::closed:
    case Stage::greeting:
    case Stage::waking:
        return DriverState::disconnected;
    case Stage::ready:
        return DriverState::idle;
    case Stage::foreign:
    case Stage::running:
        return paused_ ? DriverState::holding : DriverState::running;
    case Stage::commanding:
    case Stage::jogging:
    case Stage::homing:
        return DriverState::running;
    case Stage::stopping:
        return DriverState::stopping;
    case Stage::stopped:
        return DriverState::stopped;
    case Stage::alarm:
        return DriverState::alarm;
    }
    return DriverState::alarm;
}

Activity ShellSession::activity() const {
    switch (stage_) {
    case Stage::running:
        return Activity::program;
    case Stage::commanding:
        return Activity::command;
    case Stage::jogging:
        return Activity::jog;
    case Stage::homing:
        return Activity::homing;
    default:
        return Activity::none;
    }
}

/// 0: not reported.
int ShellSession::work_system() const {
    constexpr std::array<std::string_view, 9> systems = {
        " G54 ", " G55 ", " G56 ", " G57 ", " G58 ", " G59 ", " G59.1 ", " G59.2 ", " G59.3 "};
    const std::string modes = " " + value("PROGRAM_CODES") + " ";
    const auto* found = std::ranges::find_if(
        systems, [&](std::string_view name) { return modes.find(name) != std::string::npos; });
    return found == systems.end() ? 0 : static_cast<int>(found - systems.begin()) + 1;
}

std::optional<Diagnostic> ShellSession::stranger() const {
    if (stage_ != Stage::alarm || message_.find("linuxcncrsh") == std::string::npos) {
        return std::nullopt;
    }
    return Diagnostic{{}, message_, "check that LinuxCNC runs with linuxcncrsh"};
}

DriverStatus ShellSession::status() const {
    DriverStatus status;
    status.message = message_;
    status.link_lost = link_lost_;
    status.state = state();
    if (status.state == DriverState::disconnected) {
        return status;
    }
    status.activity = activity();
    const auto axes = static_cast<Eigen::Index>(settings_.axes.size());
    status.position = position_.size() == axes ? position_ : AxisPositions(AxisPositions::Zero(axes));
    status.work_offset = offset_.size() == axes ? offset_ : AxisPositions(AxisPositions::Zero(axes));
    status.velocity = AxisPositions::Zero(axes);
    status.feed = speed_;
    status.overrides = overrides_;
    status.modes = value("PROGRAM_CODES");
    status.work_system = work_system();
    status.coolant.mist = value("MIST") == "ON";
    status.coolant.flood = value("FLOOD") == "ON";
    const auto tool = read_numbers(value("TOOL"));
    status.tool = tool && tool->size() == 1 && std::abs((*tool)[0]) < 1e6 ? static_cast<int>((*tool)[0]) : 0;
    status.answer = answer_;
    if (run_) {
        status.executed_blocks = run_->executed;
        status.block = std::min(run_->executed, static_cast<int>(run_->listing.line_of_block.size()) - 1);
    }
    return status;
}

} // namespace millwright::drivers::linuxcnc
