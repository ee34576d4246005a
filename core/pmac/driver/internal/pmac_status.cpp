// What a session knows, in the words of the Driver interface.
#include "core/base/units.h"
#include "core/pmac/driver/internal/pmac_session.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::pmac::internal {

drivers::DriverState PmacSession::state() const {
    switch (stage_) {
    case Stage::closed:
    case Stage::greeting:
        return drivers::DriverState::disconnected;
    case Stage::ready:
        return drivers::DriverState::idle;
    case Stage::running:
        return run_.held ? drivers::DriverState::holding : drivers::DriverState::running;
    case Stage::loading:
    case Stage::commanding:
    case Stage::moving_by_command:
    case Stage::jogging:
    case Stage::homing:
        return drivers::DriverState::running;
    case Stage::stopping:
    case Stage::parting:
        return drivers::DriverState::stopping;
    case Stage::stopped:
        return drivers::DriverState::stopped;
    case Stage::alarm:
        return drivers::DriverState::alarm;
    }
    return drivers::DriverState::alarm;
}

drivers::Activity PmacSession::activity() const {
    switch (stage_) {
    case Stage::running:
    case Stage::loading:
        return drivers::Activity::program;
    case Stage::commanding:
    case Stage::moving_by_command:
        return drivers::Activity::command;
    case Stage::jogging:
        return drivers::Activity::jog;
    case Stage::homing:
        return drivers::Activity::homing;
    default:
        return drivers::Activity::none;
    }
}

std::optional<Diagnostic> PmacSession::stranger() const {
    if (stage_ != Stage::alarm || polled_) {
        return std::nullopt;
    }
    return Diagnostic{
        {},
        message_,
        link_lost()
            ? ""
            : "check that the card is on and that the baud rate of the serial port matches the card's"};
}

/// Of the program, into the card's buffer; each of them may have its mark with it.
int PmacSession::sent_lines() const {
    if (stage_ != Stage::loading) {
        return run_.lines;
    }
    constexpr int around = 6; // lines that end the buffer and run it
    const int waiting = static_cast<int>(std::ssize(queue_)) - around;
    return std::clamp(run_.lines - waiting / (run_.marks_tell ? 2 : 1), 0, std::max(0, run_.lines - 1));
}

drivers::DriverStatus PmacSession::status() const {
    drivers::DriverStatus status;
    status.message = message_;
    status.link_lost = link_lost();
    status.state = state();
    if (status.state == drivers::DriverState::disconnected) {
        return status;
    }
    status.activity = activity();
    const auto axes = static_cast<Eigen::Index>(motors_.size());
    status.position = status.work_offset = kinematics::AxisPositions::Zero(axes);
    status.velocity = kinematics::AxisPositions::Zero(unseen_ ? 0 : axes);
    for (Eigen::Index n = 0; n < axes; ++n) {
        const auto axis = static_cast<std::size_t>(n);
        const double scale = settings_.axes[axis].counts_per_degree;
        status.position[n] = from_degrees(motors_[axis].counts / scale);
        if (!unseen_) {
            status.velocity[n] = from_degrees(motors_[axis].shown_speed.counts_per_s() / scale);
        }
    }
    status.powered = enabled();
    status.position_known = position_known() && !unseen_; // it may have gone on
    if (!unseen_) {
        status.motors = readings_.motors();
    }
    status.overrides = overrides_;
    status.answer = answer_;
    status.executed_blocks = run_.executed;
    status.sent_blocks = sent_lines();
    status.block = run_.lines > 0 ? std::min(run_.executed, run_.lines - 1) : -1;
    return status;
}

/// Whose loop is open, and what helps, where a program was refused for that. `definitions`: of the axes of
/// motors 1 to 8 in our coordinate system.
std::string PmacSession::loop_advice(const std::vector<std::string>& definitions) const {
    for (std::size_t n = 0; n < motors_.size(); ++n) {
        if (!motors_[n].enabled()) {
            return fmt::format(
                "; motor {} ({}) is disabled: enable the motors", settings_.axes[n].motor, name_of(n));
        }
    }
    std::string others;
    for (std::size_t n = 0; n < definitions.size(); ++n) {
        const int motor = static_cast<int>(n) + 1;
        if (definitions[n] != "0" && std::ranges::count(settings_.axes, motor, &PmacAxis::motor) == 0) {
            others += fmt::format("{}motor {} ({})", others.empty() ? "" : ", ", motor, definitions[n]);
        }
    }
    return others.empty()
               ? std::string()
               : fmt::format(
                     "; the card's settings assign to coordinate system {} also {}, which is not driven "
                     "here: connect with its axis (\"Axis 5\", --axes XYZAB), or load settings without it",
                     settings_.system,
                     others);
}

/// A program or a command waits for the answer.
void PmacSession::ask_whose_loop_is_open(const std::string& refusal) {
    run_refusal_ = refusal;
    std::string question = fmt::format("&{}", settings_.system);
    for (int motor = 1; motor <= most_motors; ++motor) {
        question += fmt::format("#{}->", motor);
    }
    ask(std::move(question), Kind::definitions);
}

void PmacSession::explain_open_loop(const std::string& sentence) {
    if (stage_ == Stage::loading) {
        finish(Stage::ready, sentence);
        return;
    }
    answer_.add_line(sentence);
    finish_command(drivers::CommandAnswer::State::refused);
}

} // namespace millwright::pmac::internal
