#include "app/interrupt.h"

#include "core/base/error.h"

#include <poll.h>
#include <sys/eventfd.h>
#include <sys/signalfd.h>
#include <unistd.h>

#include <array>
#include <chrono>
#include <csignal>

namespace millwright::app {

namespace {

sigset_t watched_signals() {
    sigset_t set{};
    sigemptyset(&set);
    sigaddset(&set, SIGINT);
    sigaddset(&set, SIGTERM);
    sigaddset(&set, SIGHUP); // the terminal was closed
    sigaddset(&set, SIGQUIT);
    return set;
}

} // namespace

Interrupt::Interrupt() {
    const sigset_t set = watched_signals();
    pthread_sigmask(SIG_BLOCK, &set, nullptr);
    signals_ = ::signalfd(-1, &set, SFD_CLOEXEC);
    over_ = ::eventfd(0, EFD_CLOEXEC);
    expects(signals_ >= 0 && over_ >= 0, "the system gives a handle for signals");
    thread_ = std::jthread([this] { listen(); });
}

Interrupt::~Interrupt() {
    const std::uint64_t one = 1;
    (void)!::write(over_, &one, sizeof one);
    thread_.join();
    ::close(signals_);
    ::close(over_);
    const sigset_t set = watched_signals();
    pthread_sigmask(SIG_UNBLOCK, &set, nullptr);
}

void Interrupt::listen() const {
    using Clock = std::chrono::steady_clock;
    constexpr std::chrono::milliseconds one_press{
        500}; // reaches a program once by its terminal, once by its parent
    std::stop_source asked = asked_;
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
        constexpr int interrupted = 130;
        if (!asked.stop_requested()) {
            first = Clock::now();
            asked.request_stop();
        } else if (signal.ssi_signo != SIGHUP &&
                   Clock::now() - first > one_press) { // SIGHUP comes more than once
            ::_exit(interrupted);
        }
    }
}

} // namespace millwright::app
