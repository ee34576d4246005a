// Before the link is dropped: what moves comes to rest, and motors lose the power that would no longer be
// monitored.
#include "core/pmac/driver/internal/pmac_session.h"
#include "core/pmac/driver/internal/watchdog.h"

#include <algorithm>

namespace millwright::pmac::internal {

namespace {

constexpr double kill_patience = 1.0; // s until a kill has to be seen; it is sent again with each report
constexpr int enough_reports = 2;     // the first may be of just before a PLC program gave power again

} // namespace

bool PmacSession::any_power() const {
    return std::any_of(motors_.begin(), motors_.end(), [](const MotorState& m) { return m.enabled(); });
}

/// A request that is still on its way may have given it.
bool PmacSession::takes_power() const {
    const bool under_way = !talk_.idle() || !queue_.empty() || !rests();
    switch (settings_.parting) {
    case Parting::keeps_power:
        return false;
    case Parting::as_found:
        return !power_.found && (any_power() || power_.given);
    case Parting::takes_power:
        return any_power() || power_.plcs_run || (power_.given && under_way);
    }
    return true;
}

void PmacSession::leave(double now) {
    if (stage_ == Stage::closed) {
        return; // what was reported at the parting stands
    }
    farewell_.clear();
    if (stage_ == Stage::greeting) {
        return;
    }
    if (link_lost()) {
        farewell_ = any_power()
                        ? "the connection is lost, so it is unknown whether the motors are still enabled"
                        : "";
        return;
    }
    watchdog_.stays_armed = false; // else the guard would take the power of motors that are to keep it
    if (stage_ != Stage::alarm) {
        halt();
    }
    leaving_ = leaving_.value_or(Leaving{});
    part(now);
}

/// Once nothing brakes any more: kills, until the card has reported that nothing has power.
void PmacSession::part(double now) {
    if (!leaving_ || stage_ == Stage::stopping) {
        return;
    }
    if (!leaving_->kill_by) {
        if (!takes_power()) {
            leaving_.reset();
            return;
        }
        forget_all();
        kill();
        ask("CLOSE");
        power_.plcs_run = true; // a program of the card may have enabled one, too
        ask(disable_plcs);
        give_jog_speeds_back();
        finish(Stage::parting);
        leaving_->kill_by = now + kill_patience;
        return;
    }
    const bool over = now > *leaving_->kill_by;
    if (leaving_->quiet_reports >= enough_reports && (over || (queue_.empty() && talk_.idle()))) {
        finish(Stage::stopped);
        leaving_.reset();
    } else if (over) {
        farewell_ = "the card did not report that its motors are disabled";
        finish(Stage::alarm, farewell_);
        leaving_.reset();
    } else {
        stage_ = Stage::parting; // whatever was wrong with an answer, the next one may tell it
    }
}

/// A report that was asked for after the kill.
void PmacSession::watch_parting() {
    if (any_power()) {
        kill(); // what was sent may have been lost
    }
    if (leaving_ && any_power()) {
        leaving_->quiet_reports = 0;
    } else if (leaving_ && !power_.plcs_run) {
        ++leaving_->quiet_reports;
    }
}

/// All but the guard, before what else is to be asked: they would move what is just stopped. A buffer that is
/// open is closed; of a command nothing more is sent then, since its lines would act at once.
void PmacSession::switch_plcs_off() {
    power_.plcs_run = true;
    queue_.push_front({disable_plcs, Kind::step, 0});
    if (exchange_.buffer_open) {
        command_.lines.clear();
        std::erase_if(queue_, [](const Request& request) { return request.kind == Kind::command; });
        queue_.push_front({"CLOSE", Kind::step, 0});
    }
}

} // namespace millwright::pmac::internal
