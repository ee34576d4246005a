// What a round of answers says about the machine, and about what is going on.
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/drivers/linuxcnc/internal/shell_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace millwright::drivers::linuxcnc {

using kinematics::AxisPositions;

namespace {

constexpr std::string_view all_letters = "XYZABC"; // in the order of ABS_ACT_POS
constexpr const char* somebody_else = "LinuxCNC is running a program that was started elsewhere";

} // namespace

void ShellSession::round_done(double now) {
    take_machine();
    speed_ /= std::max(1e-3, now - std::exchange(last_round_, now));
    quiet_rounds_ = idle_now() && speed_ < 1e-6 ? quiet_rounds_ + 1 : 0;
    busy_rounds_ = idle_now() ? 0 : busy_rounds_ + 1;
    last_noise_ = quiet_rounds_ > 0 ? last_noise_ : now;
    if (!watch_power(now)) {
        return;
    }
    if (stage_ == Stage::ready && !error_.empty()) {
        message_ = error_;
    }
    watch_others();
    watch_program(now);
    watch_command(now);
    watch_jog(now);
    watch_homing(now);
    if (stage_ == Stage::stopping && quiet_rounds_ >= 2) {
        finish(after_stopping_, message_);
    }
}

/// Whether the round says anything else: the greeting is over, and the machine did not go off.
bool ShellSession::watch_power(double now) {
    const bool off = value("ESTOP") == "ON" || value("MACHINE") == "OFF";
    if (stage_ == Stage::greeting || stage_ == Stage::waking) {
        const bool takes_its_time = off && stage_ == Stage::waking && now - since_ < settings_.patience;
        if (!takes_its_time) {
            finish(off ? Stage::alarm : Stage::ready,
                   off ? "LinuxCNC is in emergency stop or switched off: inspect the machine, then reset it"
                       : "");
        }
        if (stage_ == Stage::ready && !idle_now()) { // before it is reported as connected
            finish(Stage::foreign, somebody_else);
        }
        return false;
    }
    const bool between = value("MACHINE") == "OFF" && value("ESTOP") != "ON"; // of an emergency stop?
    if (off && between && !std::exchange(off_without_estop_, between)) {
        return false; // the next round tells
    }
    off_without_estop_ = between;
    if (off && stage_ != Stage::alarm) {
        finish(Stage::alarm, value("ESTOP") == "ON" ? "emergency stop" : "the machine was switched off");
        return false;
    }
    return true;
}

double ShellSession::unit() const {
    return value("USER_LINEAR_UNITS") == "INCH" ? gcode::mm_per_inch : 1.0;
}

AxisPositions ShellSession::axes_of(const std::string& subject) const {
    const auto numbers = read_numbers(value(subject));
    AxisPositions axes = AxisPositions::Zero(std::ssize(settings_.axes));
    for (Eigen::Index n = 0; n < axes.size(); ++n) {
        const std::size_t index = all_letters.find(settings_.axes[static_cast<std::size_t>(n)]);
        if (numbers && index < numbers->size()) {
            axes[n] = index < 3 ? (*numbers)[index] * unit() : from_degrees((*numbers)[index]);
        }
    }
    return axes;
}

void ShellSession::take_machine() {
    const AxisPositions before = std::exchange(position_, axes_of("ABS_ACT_POS"));
    offset_ = position_ - axes_of("REL_ACT_POS");
    const auto percent = [this](const std::string& subject, int otherwise) {
        const auto numbers = read_numbers(value(subject));
        const bool usable = numbers && numbers->size() == 1 && (*numbers)[0] >= 0.0 && (*numbers)[0] < 1000.0;
        return usable ? static_cast<int>(std::lround((*numbers)[0])) : otherwise;
    };
    overrides_.feed = percent("FEED_OVERRIDE", overrides_.feed);
    speed_ = 0.0;
    if (before.size() == position_.size()) {
        for (Eigen::Index n = 0; n < std::min<Eigen::Index>(3, position_.size()); ++n) {
            speed_ = std::hypot(speed_, position_[n] - before[n]);
        }
    }
}

/// A program that was begun elsewhere, or by a Millwright that is gone: nothing of ours may push it aside.
void ShellSession::watch_others() {
    constexpr int enough = 2;
    if ((stage_ == Stage::ready || stage_ == Stage::stopped) && busy_rounds_ >= enough) {
        finish(Stage::foreign, somebody_else);
    } else if (stage_ == Stage::foreign && quiet_rounds_ >= enough) {
        finish(Stage::ready);
    }
    if (stage_ == Stage::foreign) {
        paused_ = value("PROGRAM_STATUS") == "PAUSED";
    }
}

/// A line counts when two reports in a row agree that a later one is in motion, and no error came after them:
/// while LinuxCNC begins or aborts, it shows lines that it has only read. It has begun when the machine has
/// left its place.
void ShellSession::watch_program(double now) {
    if (stage_ != Stage::running || !run_) {
        return;
    }
    Run& run = *run_;
    if (!error_.empty()) {
        fail(error_, now);
        return;
    }
    const std::string& status = value("PROGRAM_STATUS");
    paused_ = status == "PAUSED";
    if (status == "RUNNING" || status == "PAUSED") {
        run.seen_running = true;
        const auto line = read_numbers(value("PROGRAM_LINE"));
        int bound = 0;
        if (run.file.in_order && line && line->size() == 1 && (*line)[0] >= 1.0 &&
            (*line)[0] <= run.file.end_line) {
            const auto at = std::ranges::lower_bound(run.listing.line_of_block, static_cast<int>((*line)[0]));
            bound = static_cast<int>(at - run.listing.line_of_block.begin());
        }
        constexpr double same_place = 0.002; // mm or rad: more than the last digit that is reported
        const double way = (position_ - run.start).cwiseAbs().maxCoeff();
        run.executed = std::max(run.executed, run.left_start ? std::min(bound, run.last_bound) : 0);
        run.last_bound = bound;
        run.left_start = run.left_start || way > same_place;
    } else if (run.marked && quiet_rounds_ >= 2) {
        run.executed = static_cast<int>(run.listing.line_of_block.size());
        finish(Stage::ready);
    } else if (!run.marked && (run.seen_running || now - since_ > settings_.patience) && quiet_rounds_ >= 3) {
        finish(Stage::alarm, "the program was ended at the machine");
    }
}

void ShellSession::watch_command(double now) {
    if (stage_ != Stage::commanding) {
        return;
    }
    if (!error_.empty()) {
        lines_.clear();
        answer_.state = CommandAnswer::State::refused;
        answer_.text = error_;
    }
    if (quiet_rounds_ < 3) { // an error may come a moment later
        return;
    }
    if (!lines_.empty()) {
        set("mdi " + lines_.front());
        lines_.pop_front();
        quiet_rounds_ = 0;
        next_round_ = now;
        return;
    }
    answer_.end(CommandAnswer::State::done);
    finish(Stage::ready);
}

void ShellSession::watch_jog(double now) {
    if (stage_ != Stage::jogging) {
        return;
    }
    if (!error_.empty()) {
        jog_feed_.cancel();
        message_ = error_;
        stop_jog(now);
    }
    if (jog_feed_.empty() && jog_is_over(now)) {
        const std::string why = message_;
        finish(Stage::ready, why);
    }
}

/// At rest where it was sent; elsewhere, as after an early stop, only after a while: a busy LinuxCNC shows
/// the same position more than once.
bool ShellSession::jog_is_over(double now) const {
    constexpr double same_place = 0.002; // mm: more than the last reported digit of an inch
    constexpr double long_enough = 0.5;  // s
    const internal::JogFeed::Axes& target = jog_feed_.target();
    const double away = (position_.head(target.size()) - target).norm();
    return quiet_rounds_ >= 2 && (away < same_place || now - last_noise_ > long_enough);
}

void ShellSession::watch_homing(double now) {
    if (stage_ != Stage::homing) {
        return;
    }
    std::string homed;
    for (std::size_t n = 0; n < settings_.axes.size(); ++n) {
        homed += n == 0 ? "YES" : " YES";
    }
    if (!error_.empty()) {
        fail(error_, now);
    } else if (value("JOINT_HOMED").starts_with(homed) && quiet_rounds_ >= 2) {
        finish(Stage::ready);
    }
}

void ShellSession::pump_jog() {
    if (stage_ != Stage::jogging || jog_stopping_ || position_.size() < 3) {
        return;
    }
    internal::JogLimits limits;
    constexpr Eigen::Index jogged_axes = 3;
    limits.rate.setConstant(jogged_axes, std::numeric_limits<double>::max());
    limits.acceleration.setConstant(jogged_axes, settings_.jog_acceleration);
    constexpr double seconds_per_minute = 60.0;
    while (const auto slice = jog_feed_.next(position_.head(jogged_axes), speed_, limits)) {
        const double length = slice->way.norm();
        for (Eigen::Index n = 0; n < slice->way.size(); ++n) {
            const double way = slice->way[n];
            if (std::abs(way) > 0.0) {
                const double speed = slice->speed * std::abs(way) / length * seconds_per_minute / unit();
                set(fmt::format("jog_incr {} {} {}",
                                all_letters[static_cast<std::size_t>(n)],
                                fixed(std::copysign(std::max(1e-3, speed), way), 4),
                                fixed(std::abs(way) / unit(), 5)));
            }
        }
        quiet_rounds_ = 0;
    }
}

} // namespace millwright::drivers::linuxcnc
