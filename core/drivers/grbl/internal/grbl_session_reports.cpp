// What its status reports say, and what follows from them.
#include "core/drivers/grbl/internal/axis_units.h"
#include "core/drivers/grbl/internal/grbl_session.h"

#include <algorithm>
#include <utility>

namespace millwright::drivers::grbl {

namespace {

constexpr int report_inches = 13;
constexpr double mm_per_inch = 25.4;

} // namespace

std::string_view why_held(MachineState state) {
    return state == MachineState::door   ? "the safety door is open: close it, then resume"
           : state == MachineState::tool ? "the program requests another tool (M6): change it, then resume"
                                         : "the program is paused (M0), or hold was pressed at the machine";
}

/// mm of a unit of the controller's reports.
double GrblSession::report_unit() const {
    const auto inches = readout_.settings.find(report_inches);
    return inches != readout_.settings.end() && inches->second > 0.0 ? mm_per_inch : 1.0;
}

/// Degrees are degrees whatever the unit of lengths, unless the controller takes the axis for a length.
Axes GrblSession::scaled(Axes axes) const {
    for (std::size_t n = 0; n < axes.size() && n < readout_.axes.size(); ++n) {
        const bool turns = is_rotary_axis(readout_.axes[n]) && !counts_as_length(readout_, n);
        axes[n] *= turns ? 1.0 : report_unit();
    }
    return axes;
}

/// False: bytes of it were changed or lost on the way.
bool GrblSession::is_well_formed(const StatusMessage& report) const {
    const std::size_t axes =
        (report.machine_position ? *report.machine_position : *report.work_position).size();
    const bool is_met = stage_ == Stage::greeting || stage_ == Stage::asking; // and not known yet
    const bool of_another = report.foreign_fields && facts().firmware == GrblFirmware::grbl && !is_met;
    return axes == readout_.axes.size() && (!report.offset || report.offset->size() == axes) && !of_another;
}

double GrblSession::feed() const {
    constexpr double seconds_per_minute = 60.0;
    return report_ ? report_->feed.value_or(0.0) * report_unit() / seconds_per_minute : 0.0;
}

void GrblSession::take_readout(const StatusMessage& report, double now) {
    readout_.offset = report.offset ? scaled(*report.offset) : readout_.offset;
    zero_.moves = zero_.moves && !(report.offset && window_.empty());
    zero_.reports_work = report.work_position || (zero_.reports_work && !report.machine_position);
    if (report.machine_position) {
        readout_.machine_position = scaled(*report.machine_position);
    } else if (report.work_position && (report.offset || !zero_.moves)) {
        const Axes work = scaled(*report.work_position);
        for (std::size_t n = 0; n < std::min(work.size(), readout_.offset.size()); ++n) {
            readout_.machine_position[n] = work[n] + readout_.offset[n];
        }
    }
    readout_.pins = report.pins;
    readout_.spindle_rpm = report.spindle_rpm.value_or(readout_.spindle_rpm);
    if (report.overrides) {
        const auto& [feed, rapid, spindle] = *report.overrides;
        overrides_.reported({feed, rapid, spindle}, now);
    }
    if (report.accessories) {
        using gcode::SpindleTurning;
        const auto on = [&report](char letter) {
            return report.accessories->find(letter) != std::string::npos;
        };
        readout_.modes.spindle = on('S')   ? SpindleTurning::clockwise
                                 : on('C') ? SpindleTurning::counterclockwise
                                           : SpindleTurning::stopped;
        readout_.modes.flood = on('F');
        readout_.modes.mist = on('M');
    }
}

void GrblSession::handle(const StatusMessage& report, double now) {
    if (resets_due_ > 0) {
        return; // of the time before the reset
    }
    if (stage_ == Stage::greeting || stage_ == Stage::asking) {
        take_axis_count((report.machine_position ? *report.machine_position : *report.work_position).size());
    }
    if (!is_well_formed(report)) {
        return handle(Garbage{}, now);
    }
    take_readout(report, now);
    report_ = report;
    if (waits_for_tool()) {
        change_->highest_z = std::max(change_->highest_z, readout_.machine_position[2]);
    }
    rest_reports_ = report.moving() ? 0 : rest_reports_ + 1;
    ++idle_unanswered_;
    if (stage_ == Stage::greeting) {
        if (report.moving()) {
            stage_ = Stage::foreign;
            proof_closed_ = true;
            rest_reports_ = 0;
            message_ = "the machine was moving when the connection was made, and continues with what it has "
                       "received";
        } else {
            begin_asking(now, false);
        }
        return;
    }
    if (stage_ == Stage::foreign) {
        return watch_foreign(report, now);
    }
    if (stage_ == Stage::asking && asking_.questions.empty() && window_.empty() && !ask_more(now)) {
        finish_asking(report);
    }
    if ((active() || stage_ == Stage::braking) && !proof_closed_) {
        tracker_.reported(report, window_.empty());
    }
    watch_state(report, now);
}

/// Held or at rest by what it reports. When it has stood for a while it is asked what it is, which begins
/// with a reset: what a dwell kept back is gone then.
void GrblSession::watch_foreign(const StatusMessage& report, double now) {
    const bool held = report.held();
    if (held && !(hold_.resumed >= 0.0 && now - hold_.resumed < stale_time)) {
        hold_.state = HoldState::held;
    } else if (!held && hold_.state == HoldState::held) {
        hold_.state = HoldState::none;
    }
    constexpr int enough_reports = 5; // half a second
    if (!held && hold_.state == HoldState::none && rest_reports_ >= enough_reports) {
        begin_asking(now, false);
    }
}

void GrblSession::watch_state(const StatusMessage& report, double now) {
    const bool alarm = report.state == MachineState::alarm;
    if (alarm && (active() || stage_ == Stage::ready || stage_ == Stage::stopped) &&
        stage_ != Stage::homing) {
        if (active()) {
            end(true, "the controller raised an alarm", now);
        } else {
            stage_ = Stage::alarm;
            message_ = "the controller raised an alarm";
        }
        return;
    }
    const bool strays = report.state == MachineState::check && !checks();
    if (report.state == MachineState::sleep || strays) {
        fail("the controller entered sleep or check mode", now);
        return;
    }
    if (checks()) {
        return; // its greeting ends it
    }
    if (stage_ == Stage::running) {
        watch_motion(report, now);
        const bool all =
            next_line_ == std::ssize(program_.lines) && window_.empty() &&
            (at_ == Activity::command || tracker_.executed_lines() == std::ssize(program_.lines));
        if (stage_ == Stage::running && all && tracker_.settled() && hold_.state == HoldState::none) {
            finish(now);
        }
    }
    constexpr int enough_reports = 2;
    constexpr int no_answer_reports = 4; // whatever it has read is answered by then
    if (stage_ == Stage::jogging && jogging_.stopping && facts().cancel_drops_lines &&
        rest_reports_ >= no_answer_reports) {
        window_.clear();
    }
    if (stage_ == Stage::jogging && window_.empty() && jogging_.feed.empty() &&
        report.state == MachineState::idle && rest_reports_ >= enough_reports) {
        stage_ = Stage::ready;
        jogging_.stopping = false;
        jogging_.until.reset();
        if (facts().errors_stick && std::exchange(jogging_.refused, false)) {
            ask_again(Stage::ready, now); // a $ line that is right ends that
        }
    }
}

void GrblSession::watch_motion(const StatusMessage& report, double now) {
    const bool held = report.held();
    const bool stale = hold_.resumed >= 0.0 && now - hold_.resumed < stale_time;
    if (held && !stale) {
        if (hold_.state == HoldState::none) {
            message_ = why_held(report.state);
        }
        hold_.state = HoldState::held;
    } else if (!held && hold_.state == HoldState::held) { // resumed at the machine
        hold_.state = HoldState::none;
        message_.clear();
    }
}

} // namespace millwright::drivers::grbl
