// What a person wants of the machine, and how what is going on ends.
#include "core/base/error.h"
#include "core/drivers/linuxcnc/internal/shell_session.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::drivers::linuxcnc {

bool ShellSession::active() const {
    return stage_ == Stage::running || stage_ == Stage::commanding || stage_ == Stage::jogging ||
           stage_ == Stage::homing;
}

/// Ends whatever is going on: in a state without motion, or on the way there.
void ShellSession::finish(Stage stage, std::string why) {
    stage_ = stage;
    message_ = std::move(why);
    jog_until_.reset();
    jog_feed_.cancel();
    lines_.clear();
    jog_stopping_ = paused_ = false;
    if (stage != Stage::stopping) {
        answer_.break_off(message_);
    }
}

void ShellSession::fail(std::string why, double now) {
    if (active()) {
        set("abort");
        finish(Stage::stopping, std::move(why));
        after_stopping_ = Stage::alarm;
        quiet_rounds_ = 0;
        next_round_ = now;
    } else if (stage_ == Stage::ready || stage_ == Stage::stopped || stage_ == Stage::foreign ||
               stage_ == Stage::waking) {
        message_ = std::move(why);
    }
}

void ShellSession::require_rest(std::string_view what) const {
    if (stage_ == Stage::ready || stage_ == Stage::stopped) {
        return;
    }
    throw Error(fmt::format("LinuxCNC is {} and cannot accept a {}", in_words(status().state), what),
                {},
                stage_ == Stage::alarm     ? message_ + "; inspect the machine, then reset it"
                : stage_ == Stage::foreign ? message_
                                           : "");
}

void ShellSession::start(const program::Listing& listing,
                         const ProgramFile& file,
                         const std::string& path,
                         double now) {
    require_rest("program");
    answer_.forget();
    finish(Stage::running);
    run_ = {.listing = listing, .file = file, .start = position_};
    quiet_rounds_ = 0;
    since_ = now;
    set("mode auto");
    set("open " + path);
    set("run");
}

void ShellSession::hold(double now) {
    if (stage_ == Stage::running || stage_ == Stage::foreign) {
        set("pause");
        paused_ = true;
    } else if (stage_ == Stage::jogging) {
        stop_jog(now);
    }
}

void ShellSession::resume(double /*now*/) {
    if ((stage_ == Stage::running || stage_ == Stage::foreign) && paused_) {
        set("resume");
    }
}

void ShellSession::stop(double now) {
    if (active() || stage_ == Stage::foreign) {
        set("abort");
        finish(Stage::stopping);
        after_stopping_ = Stage::stopped;
        quiet_rounds_ = 0;
        next_round_ = now;
    }
}

/// What somebody else has begun goes on.
void ShellSession::leave(double now) {
    if (stage_ != Stage::foreign) {
        stop(now);
    }
}

void ShellSession::emergency_stop(double /*now*/) {
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
    require_rest("homing request");
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
            throw Error("the LinuxCNC driver jogs X, Y and Z only");
        }
    }
    Jog linear = jog;
    linear.way = jog.way.head(std::min<Eigen::Index>(3, jog.way.size()));
    if (stage_ != Stage::jogging) {
        finish(Stage::jogging);
        jog_feed_.begin(position_.head(3));
        quiet_rounds_ = 0;
        set("mode manual");
        set("teleop_enable on");
    }
    last_noise_ = now;
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
            line += plain ? std::string(1, c) : throw Error("a command must be plain text");
        }
    }
    std::erase(wanted, std::string());
    if (wanted.empty()) {
        throw Error("the command is empty");
    }
    finish(Stage::commanding);
    lines_ = std::move(wanted);
    answer_.begin();
    quiet_rounds_ = 0;
    next_round_ = now;
    set("mode mdi");
    return answer_.number;
}

void ShellSession::set_overrides(const Overrides& wanted) {
    if (!greeted() || stage_ == Stage::closed || link_lost_) {
        throw Error("LinuxCNC is not connected and cannot accept overrides");
    }
    constexpr int most = 200;
    set(fmt::format("feed_override {}", std::clamp(wanted.feed, 0, most)));
}

} // namespace millwright::drivers::linuxcnc
