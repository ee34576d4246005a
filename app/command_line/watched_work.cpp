#include "app/command_line/watched_work.h"

#include "app/command_line/terminal.h"
#include "core/base/error.h"
#include "core/base/text.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/ioctl.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <chrono>
#include <cstdint>
#include <cstdio>
#include <utility>

namespace millwright::app {

namespace {

bool is_ignored(int signal) {
    struct sigaction now {};
    return ::sigaction(signal, nullptr, &now) == 0 && now.sa_handler == SIG_IGN;
}

/// All that would end the program, but for faults of its own, SIGPROF of profilers, and SIGKILL.
sigset_t watched_signals(Suspending suspending) {
    sigset_t set{};
    sigemptyset(&set);
    for (const int signal : {SIGINT,
                             SIGTERM,
                             SIGQUIT,
                             SIGUSR1,
                             SIGUSR2,
                             SIGALRM,
                             SIGVTALRM,
                             SIGIO,
                             SIGPWR,
                             SIGXCPU,
                             SIGSTKFLT}) {
        sigaddset(&set, signal);
    }
    for (int signal = SIGRTMIN; signal <= SIGRTMAX; ++signal) {
        sigaddset(&set, signal);
    }
    if (!is_ignored(SIGHUP)) { // the terminal was closed
        sigaddset(&set, SIGHUP);
    }
    if (suspending == Suspending::refused) {
        for (const int signal : {SIGTSTP, SIGTTIN, SIGTTOU}) {
            sigaddset(&set, signal);
        }
    }
    return set;
}

bool suspends(std::uint32_t signal) {
    return signal == SIGTSTP || signal == SIGTTIN || signal == SIGTTOU;
}

/// A signal that comes once for each time that a person insists.
bool insists(std::uint32_t signal) {
    return signal == SIGINT || signal == SIGTERM || signal == SIGQUIT;
}

} // namespace

Interrupt::Interrupt(Suspending suspending) : suspending_(suspending), watched_(watched_signals(suspending)) {
    (void)std::signal(SIGPIPE, SIG_IGN);
    pthread_sigmask(SIG_BLOCK, &watched_, nullptr);
    signals_ = ::signalfd(-1, &watched_, SFD_CLOEXEC);
    over_ = ::eventfd(0, EFD_CLOEXEC);
    expects(signals_ >= 0 && over_ >= 0, "the system provides a signal handle");
    thread_ = std::jthread([this] { listen(); });
}

Interrupt::~Interrupt() {
    const std::uint64_t one = 1;
    (void)!::write(over_, &one, sizeof one);
    thread_.join();
    ::close(signals_);
    ::close(over_);
    pthread_sigmask(SIG_UNBLOCK, &watched_, nullptr);
}

void Interrupt::listen() {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds one_press{
        500}; // reaches a program once by its terminal, once by its parent
    Clock::time_point first{};
    while (true) {
        std::array<pollfd, 2> handles{{{signals_, POLLIN, 0}, {over_, POLLIN, 0}}};
        if (::poll(handles.data(), handles.size(), -1) < 0) {
            continue;
        }
        if (handles[1].revents != 0) {
            return;
        }
        signalfd_siginfo signal{};
        if (::read(signals_, &signal, sizeof signal) != sizeof signal) {
            continue;
        }
        if (suspends(signal.ssi_signo)) {
            if (signal.ssi_signo == SIGTSTP && error_takes_text()) {
                fmt::print(stderr, "\nmillwright: not suspended while it supervises a machine\n");
            }
            continue;
        }
        constexpr int interrupted = 130;
        if (!asked_.stop_requested()) {
            first = Clock::now();
            asked_.request_stop();
        } else if (insists(signal.ssi_signo) && Clock::now() - first > one_press) {
            if (suspending_ == Suspending::allowed || insisted_) {
                ::_exit(interrupted);
            }
            first = Clock::now();
            insisted_ = true;
        }
    }
}

namespace {

constexpr int widest_bar = 30;

int terminal_columns() {
    winsize size{};
    constexpr int usual = 80;
    return ::ioctl(STDERR_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : usual;
}

/// Time that is left if it goes on like this; nothing before there is something to go by.
std::string remaining(double fraction, double elapsed) {
    constexpr double enough_time = 0.5;
    constexpr double enough_work = 0.02;
    if (fraction < enough_work || elapsed < enough_time) {
        return {};
    }
    return ", " + clock_time(elapsed * (1.0 - fraction) / fraction) + " left";
}

int percent(double fraction) {
    return static_cast<int>(100.0 * std::clamp(fraction, 0.0, 1.0));
}

/// What is being done, without how far it is.
std::string without_digits(std::string text) {
    std::erase_if(text, [](unsigned char c) { return std::isdigit(c) != 0; });
    return text;
}

} // namespace

ProgressPrinter::ProgressPrinter()
    : on_terminal_(::isatty(STDERR_FILENO) == 1), begin_(Clock::now()),
      last_(begin_ - std::chrono::hours(1)) {}

ProgressPrinter::~ProgressPrinter() {
    finish();
}

void ProgressPrinter::show(const Progress::Report& report) {
    const auto now = Clock::now();
    if (!error_takes_text()) {
        return;
    }
    if (on_terminal_) {
        constexpr auto interval = std::chrono::milliseconds(80);
        if (now - last_ >= interval) {
            last_ = now;
            draw_bar(report, std::chrono::duration<double>(now - begin_).count());
        }
        return;
    }
    print_line(report);
}

void ProgressPrinter::say(const std::string& line) {
    if (!error_takes_text()) {
        return;
    }
    finish();
    fmt::print(stderr, "{}\n", printable(line));
    std::fflush(stderr);
}

void ProgressPrinter::pause(bool on) {
    const auto now = Clock::now();
    if (paused_) {
        begin_ += now - std::exchange(*paused_, now); // as if it had not passed
    }
    paused_ = on ? std::optional(now) : std::nullopt;
}

void ProgressPrinter::draw_bar(const Progress::Report& report, double elapsed) {
    const auto columns = static_cast<std::size_t>(std::max(1, terminal_columns() - 1));
    const int width = std::min(widest_bar, static_cast<int>(columns) / 4);
    const int done = static_cast<int>(width * std::clamp(report.fraction, 0.0, 1.0));
    const std::string bar =
        fmt::format("[{:#<{}}{:.<{}}] {:3} %", "", done, "", width - done, percent(report.fraction));
    const std::string left = remaining(report.fraction, elapsed);
    const std::size_t taken = bar.size() + left.size() + 2;
    const std::string text = printable(report.text).substr(0, columns > taken ? columns - taken : 0);
    fmt::print(stderr, "\r\033[K{}", fmt::format("{}{}  {}", bar, left, text).substr(0, columns));
    std::fflush(stderr);
    drawn_ = true;
}

void ProgressPrinter::print_line(const Progress::Report& report) {
    const int tenths = percent(report.fraction) / 10;
    std::string words = without_digits(report.text);
    if (words.empty() || (words == words_ && tenths == tenths_)) {
        return;
    }
    words_ = std::move(words);
    tenths_ = tenths;
    fmt::print(stderr, "{:3} %  {}\n", percent(report.fraction), printable(report.text));
    std::fflush(stderr);
}

void ProgressPrinter::finish() {
    if (drawn_ && error_takes_text()) {
        fmt::print(stderr, "\r\033[K");
        std::fflush(stderr);
        drawn_ = false;
    }
}

} // namespace millwright::app
