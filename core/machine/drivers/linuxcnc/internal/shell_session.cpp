#include "core/machine/drivers/linuxcnc/internal/shell_session.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace millwright::machine::linuxcnc {

using kinematics::AxisPositions;

namespace {

constexpr double seconds_per_minute = 60.0;
constexpr std::string_view all_letters = "XYZABC"; // in the order of ABS_ACT_POS

std::string upper(std::string text) {
    for (char& c : text) {
        c = c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c;
    }
    return text;
}

} // namespace

bool ShellSession::active() const {
    return stage_ == Stage::running || stage_ == Stage::commanding || stage_ == Stage::jogging ||
           stage_ == Stage::homing;
}

std::string ShellSession::take_output() {
    return std::exchange(output_, {});
}

void ShellSession::send(const std::string& request, std::string subject) {
    output_ += request + "\r\n";
    outstanding_.push_back({request, std::move(subject)});
}

void ShellSession::set(const std::string& words) {
    send("set " + words, upper(words.substr(0, words.find(' '))));
}

void ShellSession::get(const std::string& subject) {
    send("get " + subject, upper(subject));
}

void ShellSession::opened(double now) {
    *this = ShellSession(settings_);
    stage_ = Stage::greeting;
    last_heard_ = since_ = now;
    send("hello " + settings_.password + " millwright 1.0", "HELLO");
    output_ += "set echo off\r\n"; // answered by its echo, or not at all
    set("verbose on");
    set("enable " + settings_.enable_password);
    set("set_wait received");
    get("user_linear_units");
}

void ShellSession::closed() {
    stage_ = Stage::closed;
    output_.clear();
}

void ShellSession::lost(const std::string& why) {
    if (stage_ == Stage::closed || link_lost_) {
        return;
    }
    link_lost_ = true;
    const bool program = stage_ == Stage::running;
    finish(Stage::alarm, "the link was lost: " + why);
    message_ += program ? "; LinuxCNC goes on with the program, so look at the machine" : "";
    output_.clear();
}

void ShellSession::receive(std::string_view bytes, double now) {
    constexpr std::size_t longest = 4096;
    for (const char byte : bytes) {
        if (byte != '\n' && byte != '\r') {
            input_ += input_.size() < longest ? std::string(1, byte) : "";
        } else if (!input_.empty() && stage_ != Stage::closed && !link_lost_) {
            last_heard_ = now;
            handle(read_reply(std::exchange(input_, {})), now);
        }
    }
}

void ShellSession::handle(const Reply& reply, double now) {
    if (reply.kind == Reply::Kind::other || outstanding_.empty() ||
        outstanding_.front().subject != reply.subject) {
        return; // an echo
    }
    const Request request = outstanding_.front();
    outstanding_.pop_front();
    if (reply.kind == Reply::Kind::refused) {
        refused(request.text, now);
        return;
    }
    if (reply.kind == Reply::Kind::value) {
        values_[reply.subject] = reply.text;
        if (reply.subject == "ERROR" && reply.text != "OK") {
            error_ += (error_.empty() ? "" : "; ") + reply.text;
        }
        if (reply.subject == "OPERATOR_DISPLAY" && !file_.end_mark.empty() &&
            reply.text.find(file_.end_mark) != std::string::npos) {
            marked_ = true;
        }
    }
    if (outstanding_.empty() && in_round_) {
        in_round_ = false;
        round_done(now);
    }
}

void ShellSession::refused(const std::string& request, double now) {
    if (stage_ == Stage::greeting) {
        finish(Stage::alarm,
               request.starts_with("hello") || request.starts_with("set enable")
                   ? "linuxcncrsh refuses the password"
                   : "linuxcncrsh refuses '" + request + "'");
        return;
    }
    fail("LinuxCNC refuses '" + request + "'", now);
}

void ShellSession::tick(double now) {
    if (stage_ == Stage::closed || link_lost_) {
        return;
    }
    if (now - last_heard_ > settings_.patience && !outstanding_.empty()) {
        finish(Stage::alarm,
               stage_ == Stage::greeting ? "no linuxcncrsh answers at this port"
                                         : "LinuxCNC does not answer any more, so look at the machine");
        outstanding_.clear();
        in_round_ = false;
    }
    if (jog_until_ && now > *jog_until_) {
        stop_jog(now);
    }
    if (outstanding_.empty() && now >= next_round_) {
        ask(now);
    }
    pump_jog();
}

void ShellSession::ask(double now) {
    const bool hurry = stage_ == Stage::jogging;
    next_round_ = now + (hurry ? 0.25 : 1.0) * settings_.poll_interval;
    in_round_ = true;
    error_.clear();
    for (const char* subject : {"estop",
                                "machine",
                                "mode",
                                "error",
                                "operator_display",
                                "program_status",
                                "program_line",
                                "abs_act_pos",
                                "rel_act_pos",
                                "joint_homed",
                                "feed_override",
                                "program_codes",
                                "mist",
                                "flood",
                                "tool"}) {
        get(subject);
    }
}

const std::string& ShellSession::value(const std::string& subject) const {
    static const std::string nothing;
    const auto found = values_.find(subject);
    return found == values_.end() ? nothing : found->second;
}

bool ShellSession::idle_now() const {
    return value("PROGRAM_STATUS") == "IDLE";
}

AxisPositions ShellSession::axes_of(const std::string& subject) const {
    const auto numbers = read_numbers(value(subject));
    const double unit = value("USER_LINEAR_UNITS") == "INCH" ? gcode::mm_per_inch : 1.0;
    AxisPositions axes = AxisPositions::Zero(std::ssize(settings_.axes));
    for (Eigen::Index n = 0; n < axes.size(); ++n) {
        const std::size_t index = all_letters.find(settings_.axes[static_cast<std::size_t>(n)]);
        if (numbers && index < numbers->size()) {
            axes[n] = index < 3 ? (*numbers)[index] * unit : from_degrees((*numbers)[index]);
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

void ShellSession::round_done(double now) {
    take_machine();
    speed_ /= std::max(1e-3, now - std::exchange(last_round_, now));
    quiet_rounds_ = idle_now() && speed_ < 1e-6 ? quiet_rounds_ + 1 : 0;
    const bool off = value("ESTOP") == "ON" || value("MACHINE") == "OFF";
    if (stage_ == Stage::greeting || stage_ == Stage::waking) {
        if (off && stage_ == Stage::waking && now - since_ < settings_.patience) {
            return; // it takes its time
        }
        finish(off ? Stage::alarm : Stage::ready,
               off ? "LinuxCNC is in its emergency stop or switched off: look at the machine, then reset it"
                   : "");
        return;
    }
    if (off && stage_ != Stage::alarm) {
        finish(Stage::alarm, value("ESTOP") == "ON" ? "emergency stop" : "the machine was switched off");
        return;
    }
    if (stage_ == Stage::ready && !error_.empty()) {
        message_ = error_;
    }
    watch_program(now);
    watch_command(now);
    watch_jog(now);
    if (stage_ == Stage::homing) {
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
    if (stage_ == Stage::stopping && quiet_rounds_ >= 2) {
        finish(ending_in_fault_ ? Stage::alarm : Stage::stopped, message_);
    }
}

/// A line counts when two reports in a row agree that a later one is in motion, and no error came after them:
/// while LinuxCNC aborts, it shows lines that it has only read.
void ShellSession::watch_program(double now) {
    if (stage_ != Stage::running) {
        return;
    }
    if (!error_.empty()) {
        fail(error_, now);
        return;
    }
    const std::string& status = value("PROGRAM_STATUS");
    paused_ = status == "PAUSED";
    if (status == "RUNNING" || status == "PAUSED") {
        seen_running_ = true;
        const auto line = read_numbers(value("PROGRAM_LINE"));
        int bound = 0;
        if (file_.in_order && line && line->size() == 1 && (*line)[0] >= 1.0 &&
            (*line)[0] <= file_.end_line) {
            const auto at = std::ranges::lower_bound(listing_.line_of_block, static_cast<int>((*line)[0]));
            bound = static_cast<int>(at - listing_.line_of_block.begin());
        }
        executed_ = std::max(executed_, std::min(bound, last_bound_));
        last_bound_ = bound;
    } else if (marked_ && quiet_rounds_ >= 2) {
        executed_ = static_cast<int>(listing_.line_of_block.size());
        finish(Stage::ready);
    } else if (!marked_ && (seen_running_ || now - since_ > settings_.patience) && quiet_rounds_ >= 3) {
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
    if (answer_.state == CommandAnswer::State::pending) {
        answer_.state = CommandAnswer::State::done;
    }
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
    if (jog_feed_.empty() && quiet_rounds_ >= 2) {
        const std::string why = message_;
        finish(Stage::ready, why);
    }
}

void ShellSession::pump_jog() {
    if (stage_ != Stage::jogging || jog_stopping_ || position_.size() < 3) {
        return;
    }
    internal::JogLimits limits;
    limits.rate.fill(std::numeric_limits<double>::max());
    limits.acceleration.fill(settings_.jog_acceleration);
    const double unit = value("USER_LINEAR_UNITS") == "INCH" ? gcode::mm_per_inch : 1.0;
    while (const auto slice = jog_feed_.next({position_[0], position_[1], position_[2]}, speed_, limits)) {
        const double length = std::hypot(slice->way[0], slice->way[1], slice->way[2]);
        for (std::size_t n = 0; n < slice->way.size(); ++n) {
            const double way = slice->way[n];
            if (std::abs(way) > 0.0) {
                const double speed = slice->speed * std::abs(way) / length * seconds_per_minute / unit;
                set(fmt::format("jog_incr {} {} {}",
                                all_letters[n],
                                fixed(std::copysign(std::max(1e-3, speed), way), 4),
                                fixed(std::abs(way) / unit, 5)));
            }
        }
        quiet_rounds_ = 0;
    }
}

/// Ends whatever is going on: in a state without motion, or on the way there.
void ShellSession::finish(Stage stage, std::string why) {
    stage_ = stage;
    message_ = std::move(why);
    jog_until_.reset();
    jog_feed_.cancel();
    lines_.clear();
    jog_stopping_ = paused_ = false;
    if (answer_.state == CommandAnswer::State::pending && stage != Stage::stopping) {
        answer_.state = CommandAnswer::State::refused;
        answer_.text = message_.empty() ? "stopped" : message_;
    }
}

void ShellSession::fail(std::string why, double now) {
    if (active()) {
        set("abort");
        finish(Stage::stopping, std::move(why));
        ending_in_fault_ = true;
        quiet_rounds_ = 0;
        next_round_ = now;
    } else if (stage_ == Stage::ready || stage_ == Stage::stopped || stage_ == Stage::waking) {
        message_ = std::move(why);
    }
}

void ShellSession::require_rest(std::string_view what) const {
    if (stage_ == Stage::ready || stage_ == Stage::stopped) {
        return;
    }
    throw Error(fmt::format("LinuxCNC is {} and takes no {}", to_text(status().state), what),
                {},
                stage_ == Stage::alarm ? message_ + "; look at the machine, then reset it" : "");
}

void ShellSession::start(const gcode::Listing& listing,
                         const ProgramFile& file,
                         const std::string& path,
                         double now) {
    require_rest("program");
    listing_ = listing;
    file_ = file;
    finish(Stage::running);
    has_program_ = true;
    seen_running_ = marked_ = ending_in_fault_ = false;
    executed_ = last_bound_ = quiet_rounds_ = 0;
    since_ = now;
    set("mode auto");
    set("open " + path);
    set("run");
}

void ShellSession::hold() {
    if (stage_ == Stage::running) {
        set("pause");
        paused_ = true;
    } else if (stage_ == Stage::jogging) {
        stop_jog(last_heard_);
    }
}

void ShellSession::resume() {
    if (stage_ == Stage::running && paused_) {
        set("resume");
        message_.clear();
    }
}

void ShellSession::stop(double now) {
    if (active()) {
        set("abort");
        finish(Stage::stopping);
        ending_in_fault_ = false;
        quiet_rounds_ = 0;
        next_round_ = now;
    }
}

void ShellSession::emergency_stop() {
    if (stage_ == Stage::closed || link_lost_) {
        return;
    }
    set("estop on");
    finish(Stage::alarm, "emergency stop");
}

void ShellSession::reset(double now) {
    if (stage_ == Stage::alarm && !link_lost_) {
        finish(Stage::waking);
        since_ = now;
        set("estop off");
        set("machine on");
    }
}

void ShellSession::home(double now) {
    require_rest("homing");
    finish(Stage::homing);
    quiet_rounds_ = 0;
    next_round_ = now;
    set("mode manual");
    set("home -1");
}

void ShellSession::jog(const Jog& jog, double now) {
    if (stage_ != Stage::jogging || jog_stopping_) {
        require_rest("jog");
    }
    for (Eigen::Index n = 3; n < jog.way.size(); ++n) {
        if (std::abs(jog.way[n]) > 0.0) {
            throw Error("the LinuxCNC driver jogs X, Y and Z alone");
        }
    }
    Jog linear = jog;
    linear.way = jog.way.head(std::min<Eigen::Index>(3, jog.way.size()));
    if (stage_ != Stage::jogging) {
        finish(Stage::jogging);
        jog_feed_.begin({position_[0], position_[1], position_[2]});
        quiet_rounds_ = 0;
        set("mode manual");
        set("teleop_enable on");
    }
    jog_feed_.add(linear);
    jog_until_ = jog.dead_man > 0.0 ? std::optional(now + jog.dead_man) : std::nullopt;
}

void ShellSession::stop_jog(double now) {
    if (stage_ == Stage::jogging && !jog_stopping_) {
        jog_stopping_ = true;
        jog_until_.reset();
        jog_feed_.cancel();
        for (const char letter : settings_.axes.substr(0, 3)) {
            set(fmt::format("jog_stop {}", letter));
        }
        quiet_rounds_ = 0;
        next_round_ = now;
    }
}

int ShellSession::command(const std::string& lines, double now) {
    require_rest("command");
    std::deque<std::string> wanted;
    std::string line;
    for (const char c : lines + "\n") {
        if (c == '\n') {
            wanted.push_back(std::exchange(line, {}));
        } else if (c != '\r') {
            const bool plain = (c >= ' ' && c <= '~') || c == '\t';
            line += plain ? std::string(1, c) : throw Error("a command is plain text");
        }
    }
    std::erase(wanted, std::string());
    if (wanted.empty()) {
        throw Error("there is nothing in the command");
    }
    finish(Stage::commanding);
    lines_ = std::move(wanted);
    answer_ = {answer_.number + 1, CommandAnswer::State::pending, {}};
    quiet_rounds_ = 0;
    next_round_ = now;
    set("mode mdi");
    return answer_.number;
}

void ShellSession::set_overrides(const Overrides& wanted) {
    if (!greeted() || stage_ == Stage::closed || link_lost_) {
        throw Error("LinuxCNC is not connected and takes no overrides");
    }
    constexpr int most = 200;
    set(fmt::format("feed_override {}", std::clamp(wanted.feed, 0, most)));
}

DriverState ShellSession::state() const {
    switch (stage_) {
    case Stage::closed:
    case Stage::greeting:
    case Stage::waking:
        return DriverState::disconnected;
    case Stage::ready:
        return DriverState::idle;
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

DriverStatus ShellSession::status() const {
    DriverStatus status;
    status.message = message_;
    status.link_lost = link_lost_;
    status.state = state();
    if (status.state == DriverState::disconnected) {
        return status;
    }
    status.activity = stage_ == Stage::running      ? Activity::program
                      : stage_ == Stage::commanding ? Activity::command
                      : stage_ == Stage::jogging    ? Activity::jog
                      : stage_ == Stage::homing     ? Activity::homing
                                                    : Activity::none;
    const auto axes = static_cast<Eigen::Index>(settings_.axes.size());
    status.position = position_.size() == axes ? position_ : AxisPositions(AxisPositions::Zero(axes));
    status.work_offset = offset_.size() == axes ? offset_ : AxisPositions(AxisPositions::Zero(axes));
    status.velocity = AxisPositions::Zero(axes);
    status.feed = speed_;
    status.overrides = overrides_;
    status.modes = value("PROGRAM_CODES");
    constexpr std::array<std::string_view, 9> systems = {
        " G54 ", " G55 ", " G56 ", " G57 ", " G58 ", " G59 ", " G59.1 ", " G59.2 ", " G59.3 "};
    for (std::size_t n = 0; n < systems.size(); ++n) {
        if ((" " + status.modes + " ").find(systems[n]) != std::string::npos) {
            status.work_system = static_cast<int>(n) + 1;
        }
    }
    status.mist = value("MIST") == "ON";
    status.flood = value("FLOOD") == "ON";
    const auto tool = read_numbers(value("TOOL"));
    status.tool = tool && tool->size() == 1 && std::abs((*tool)[0]) < 1e6 ? static_cast<int>((*tool)[0]) : 0;
    status.answer = answer_;
    if (has_program_) {
        status.executed_blocks = executed_;
        status.block = std::min(executed_, static_cast<int>(listing_.line_of_block.size()) - 1);
    }
    return status;
}

} // namespace millwright::machine::linuxcnc
