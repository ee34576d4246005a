// Before the link is dropped: what moves comes to rest, and motors lose the power that nobody would watch
// over.
#include "core/pmac/driver/internal/pmac_session.h"

#include <algorithm>

namespace millwright::pmac::internal {

namespace {

constexpr double kill_patience = 1.0; // s until a kill has to be seen; it is sent again with each report

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
        return !found_power_ && (any_power() || gave_power_);
    case Parting::takes_power:
        return any_power() || (gave_power_ && under_way);
    }
    return true;
}

void PmacSession::leave(double now) {
    if (stage_ == Stage::closed) {
        return; // what was told at the parting stands
    }
    farewell_.clear();
    if (stage_ == Stage::greeting) {
        return;
    }
    if (link_lost_) {
        farewell_ = any_power()
                        ? "the connection is lost, so it is unknown whether the motors are still enabled"
                        : "";
        return;
    }
    stays_armed_ = false; // else the guard would take the power of motors that are to keep it
    if (stage_ != Stage::alarm) {
        halt();
    }
    leaving_ = true;
    part(now);
}

/// Once nothing brakes any more: kills, until the card has told that nothing has power.
void PmacSession::part(double now) {
    if (!leaving_ || stage_ == Stage::stopping) {
        return;
    }
    if (!kill_by_) {
        if (!takes_power()) {
            end_leaving();
            return;
        }
        forget_all();
        kill();
        ask("CLOSE");
        give_jog_speeds_back();
        finish(Stage::parting);
        kill_by_ = now + kill_patience;
        killed_seen_ = false;
        return;
    }
    const bool over = now > *kill_by_;
    if (killed_seen_ && (over || (queue_.empty() && talk_.idle()))) {
        finish(Stage::stopped);
        end_leaving();
    } else if (over) {
        farewell_ = "the card did not report that its motors are disabled";
        finish(Stage::alarm, farewell_);
        end_leaving();
    } else {
        stage_ = Stage::parting; // whatever was wrong with an answer, the next one may tell it
    }
}

void PmacSession::end_leaving() {
    leaving_ = false;
    kill_by_.reset();
}

/// A report that was asked for after the kill.
void PmacSession::watch_parting() {
    if (any_power()) {
        kill(); // what was sent may have been lost
    } else {
        killed_seen_ = true;
    }
}

} // namespace millwright::pmac::internal
