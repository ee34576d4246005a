// What a person or a job wants of a session.
#include "core/base/error.h"
#include "core/drivers/grbl/internal/grbl_session.h"

#include <fmt/format.h>

#include <utility>

namespace millwright::drivers::grbl {

void GrblSession::require_rest(std::string_view what) const {
    if (change_ && !waits_for_tool()) {
        throw Error(fmt::format("{} is moving to or from a tool change and cannot accept a {}", name(), what),
                    {},
                    "wait until it has stopped, or stop it");
    }
    if (held_at_machine()) { // it would begin when somebody resumes
        throw Error(fmt::format("{} cannot accept a {}: {}", name(), what, why_held(report_->state)));
    }
    if (stage_ == Stage::ready || stage_ == Stage::stopped) {
        return;
    }
    if (stage_ == Stage::foreign) {
        throw Error(fmt::format("{} cannot accept a {}: {}", name(), what, message_),
                    {},
                    "wait until it has stopped; the window can hold or stop it");
    }
    throw Error(fmt::format("{} is {} and cannot accept a {}", name(), in_words(status().state), what),
                {},
                stage_ == Stage::alarm ? message_ + "; inspect the machine, then reset it" : "");
}

void GrblSession::start(ProgramLines program,
                        double now,
                        std::function<int(int)> ahead,
                        std::optional<ToolChanges> changes) {
    require_rest("program");
    if (change_) {
        throw Error("a job is waiting for a tool change", {}, "resume it, or stop it");
    }
    if (const std::string_view mode = unfollowed_mode(readout_.modes.text); !mode.empty()) {
        throw Error(fmt::format("{} has {} active, which distorts every path in a way that is not checked",
                                name(),
                                mode),
                    {},
                    mode == "G51" ? "cancel it with G50" : "cancel it with G8");
    }
    if (tool_length_.left && has_tool_length()) {
        throw Error("the tool length offset of an earlier job is still active", {}, "cancel it with G49");
    }
    begin_job(std::move(changes), program);
    answer_.forget();
    send_window_.begin(std::move(ahead), program.blocks);
    begin(std::move(program), Activity::program, now);
}

int GrblSession::command(ProgramLines lines, double now) {
    require_rest("command");
    answer_.begin();
    send_window_.begin(nullptr, lines.blocks);
    begin(std::move(lines), Activity::command, now);
    return answer_.number;
}

void GrblSession::begin(ProgramLines program, Activity activity, double now) {
    program_ = std::move(program);
    at_ = activity;
    tracker_ = ExecutedLineTracker(program_, readout_.planner_blocks, readout_.segment_blocks);
    window_ = Window(readout_.buffer_bytes,
                     settings_.one_by_one || activity == Activity::command ||
                         (activity == Activity::check && facts().errors_stick));
    proof_closed_ = false;
    next_line_ = 0;
    stage_ = Stage::running;
    hold_ = {};
    single_block_.waits = false;
    spare_welcomes_ = 0;
    message_.clear();
    readout_.modes.text.clear();
    readout_.modes.work_system = 0;
    last_answer_ = last_heard_ = now;
    idle_unanswered_ = 0;
    next_poll_ = now;
    pump();
}

void GrblSession::set_single_block(bool on) {
    single_block_.on = on;
    if (on && stage_ == Stage::running && at_ == Activity::program && !change_) {
        single_block_.waits = true;
    }
}

/// Everything that was sent so far is done and the next line waits for resume().
bool GrblSession::waits_between_blocks() const {
    return single_block_.waits && window_.empty() && tracker_.settled() &&
           next_line_ < std::ssize(program_.lines);
}

void GrblSession::hold(double now) {
    if (checks()) {
        return; // nothing moves
    }
    if ((stage_ == Stage::running || stage_ == Stage::foreign) && hold_.state == HoldState::none) {
        hold_.state = HoldState::wanted;
        hold_.sent = now;
        output_ += hold_byte();
    } else if (stage_ == Stage::jogging) {
        stop_jog(now);
    }
    if (change_ && stage_ != Stage::running) { // between two of our own steps, or while it waits
        change_->held = true;
        change_->confirmed = false;
    }
}

void GrblSession::resume(double now) {
    if (stage_ == Stage::running && waits_between_blocks()) {
        single_block_.waits = false;
        last_answer_ = now;
        idle_unanswered_ = 0;
        pump();
        return;
    }
    if ((stage_ == Stage::running || stage_ == Stage::foreign) && hold_.state != HoldState::none) {
        hold_.state = HoldState::none;
        hold_.resumed = now;
        message_.clear();
        output_ += resume_byte();
        pump();
    } else if (held_at_machine()) {
        change_->held = false;
        output_ += resume_byte();
    } else if (change_ && change_->held) {
        change_->held = false;
    } else if (waits_for_tool() && stage_ == Stage::ready) {
        change_->confirmed = true; // watch_change() goes on when it knows where the machine is
        watch_change(now);
    }
}

void GrblSession::stop(double now) {
    const bool homing = stage_ == Stage::homing;
    if (active() || (change_ && stage_ == Stage::ready)) {
        end(false, {}, now);
    }
    if (homing) { // a homing cycle knows no hold
        doubt_.arise("homing was interrupted");
        stage_ = Stage::flushing;
        send_reset(now);
    }
}

void GrblSession::leave(double now) {
    if (stage_ != Stage::foreign) {
        stop(now);
    }
}

void GrblSession::break_off(std::string why, double now) {
    if (stage_ == Stage::ready || stage_ == Stage::stopped) {
        stage_ = Stage::alarm;
        message_ = std::move(why);
    } else {
        fail(why, now);
    }
}

void GrblSession::emergency_stop(double now) {
    if (stage_ == Stage::closed) {
        return;
    }
    output_.clear();
    if (link_lost_) {
        return;
    }
    if (((active() || stage_ == Stage::braking) && !checks()) || (report_ && report_->moving())) {
        doubt_.arise("an emergency stop interrupted the motion");
    }
    stage_ = Stage::flushing;
    ending_.in_fault = true;
    ending_.message = message_ = "emergency stop";
    ending_since_ = now;
    send_reset(now);
}

void GrblSession::reset(double now) {
    if (stage_ != Stage::alarm || link_lost_) {
        return;
    }
    if (report_ && report_->moving()) { // its reset would cut the motion off
        throw Error("the machine is moving", {}, "wait until it has stopped, or stop it");
    }
    begin_asking(now, true);
}

void GrblSession::home(double now) {
    if (stage_ != Stage::alarm || link_lost_) {
        require_rest("homing request");
    }
    if (change_ && !doubt_.was_homed()) {
        throw Error("the machine was not homed before the job: homing now would shift the zero of the job",
                    {},
                    "stop the job, home, and set the work zero again");
    }
    proof_closed_ = true;
    window_ = Window(readout_.buffer_bytes, true);
    window_.push({LineKind::home, "$H\n", -1, 0.0});
    output_ += "$H\n";
    stage_ = Stage::homing;
    message_.clear();
    last_heard_ = now;
}

void GrblSession::set_overrides(const Overrides& wanted) {
    if (stage_ != Stage::ready && stage_ != Stage::stopped && !active()) {
        throw Error(fmt::format("{} is {} and cannot accept overrides", name(), in_words(status().state)));
    }
    overrides_.want(wanted);
}

} // namespace millwright::drivers::grbl
