#include "app/drivers/job_terminal.h"

#include "core/base/error.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <termios.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cstdint>
#include <cstdio>
#include <utility>

namespace millwright::app {

namespace {

constexpr int feed_step = 10; // percent
constexpr int least_feed = 10;
constexpr int most_feed = 200;

/// In the foreground: a job in the background must not be stopped by the terminal for reading it.
bool is_own_terminal() {
    return ::isatty(STDIN_FILENO) == 1 && ::tcgetpgrp(STDIN_FILENO) == ::getpgrp();
}

/// Keys as they are pressed, without echo; the terminal is as before at the end of the scope.
class KeyByKey {
public:
    KeyByKey() : set_(::isatty(STDIN_FILENO) == 1 && ::tcgetattr(STDIN_FILENO, &before_) == 0) {
        if (set_) {
            termios keys = before_;
            keys.c_lflag &= ~static_cast<tcflag_t>(ICANON | ECHO);
            ::tcsetattr(STDIN_FILENO, TCSANOW, &keys);
        }
    }
    KeyByKey(const KeyByKey&) = delete;
    KeyByKey& operator=(const KeyByKey&) = delete;
    ~KeyByKey() {
        if (set_) {
            ::tcsetattr(STDIN_FILENO, TCSANOW, &before_);
        }
    }

private:
    termios before_{};
    bool set_;
};

} // namespace

JobKeys::JobKeys(jobs::Dispatcher& dispatcher, bool always, JobSwitches now)
    : dispatcher_(dispatcher), switches_(now) {
    if (!always && !is_own_terminal()) {
        return;
    }
    over_ = ::eventfd(0, EFD_CLOEXEC);
    expects(over_ >= 0, "an event can be made");
    thread_ = std::jthread([this](const std::stop_token& over) { listen(over); });
}

JobKeys::~JobKeys() {
    if (thread_.joinable()) {
        thread_.request_stop();
        const std::uint64_t one = 1;
        static_cast<void>(::write(over_, &one, sizeof one));
        thread_.join();
        ::close(over_);
    }
}

void JobKeys::listen(const std::stop_token& over) {
    const KeyByKey keys;
    while (!over.stop_requested()) {
        std::array<pollfd, 2> waiting{{{STDIN_FILENO, POLLIN, 0}, {over_, POLLIN, 0}}};
        const bool woken = ::poll(waiting.data(), waiting.size(), -1) > 0;
        if (!woken || waiting[0].revents == 0) {
            continue;
        }
        char key = 0;
        if (::read(STDIN_FILENO, &key, 1) != 1) {
            return; // the terminal is gone; the job goes on
        }
        obey(key);
    }
}

void JobKeys::obey(char key) {
    try {
        switch (key) {
        case 'p':
            return dispatcher_.hold();
        case 'r':
            return dispatcher_.resume();
        case 'q':
            return dispatcher_.stop();
        case 'b':
            dispatcher_.set_single_block(!switches_.single_block);
            switches_.single_block = !switches_.single_block; // unless it was refused
            return;
        case 'o':
            dispatcher_.set_optional_stop(!switches_.optional_stop);
            switches_.optional_stop = !switches_.optional_stop;
            return;
        case '+':
        case '-':
            overrides_.feed =
                std::clamp(overrides_.feed + (key == '+' ? feed_step : -feed_step), least_feed, most_feed);
            return dispatcher_.set_overrides(overrides_);
        case '0':
            overrides_.feed = 100;
            return dispatcher_.set_overrides(overrides_);
        default:
            return;
        }
    } catch (const Error& error) {
        fmt::print(stderr, "\nmillwright: {}\n", to_text(error.diagnostic()));
    }
}

namespace {

using drivers::DriverState;

} // namespace

void JobPrinter::show(const jobs::JobReport& report, bool keys) {
    const drivers::DriverStatus& now = report.driver;
    const bool holding = now.state == DriverState::holding;
    tell_waiting(now, keys);
    printer_.pause(holding);
    printer_.show({report.fraction(), report.progress_text() + (holding ? ", holding" : "")});
}

/// On a line of its own, whole: a bar has no room for what a person has to do.
void JobPrinter::tell_waiting(const drivers::DriverStatus& now, bool keys) {
    const std::string why = now.state == DriverState::holding
                                ? "holding" + (now.message.empty() ? "" : ": " + now.message)
                                : std::string();
    if (why != std::exchange(waits_for_, why) && !why.empty()) {
        const auto& change = now.tool_change;
        const bool for_tool = change && change->waits && !change->held && !change->keeps_zero;
        const std::string_view goes_on =
            for_tool ? " (r to resume, with the current Z zero)" : " (r to resume)";
        printer_.say(why + (keys ? std::string(goes_on) : ""));
    }
}

} // namespace millwright::app
