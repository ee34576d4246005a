#include "app/command_line/interrupt.h"

#include "app/command_line/output_streams.h"
#include "core/base/error.h"

#include <fmt/format.h>
#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <cstdint>
#include <cstdio>

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

} // namespace millwright::app
