// Ctrl+C, asking politely: the first signal that would end the program, or a terminal that is closed, asks
// the work to stop; another SIGINT, SIGTERM or SIGQUIT, half a second later or more, ends the program; where
// it watches over a machine, the third one does.
#pragma once

#include <atomic>
#include <csignal>
#include <stop_token>
#include <thread>

namespace millwright::app {

/// What Ctrl+Z does. A program that stands still feeds no machine and brakes none.
enum class Suspending { allowed, refused };

/// Made before any other thread, so that all of them leave these signals to this one. The signals act as
/// before once it is gone; but a pipe without a reader ends the program neither then nor before: what was
/// begun is completed. A SIGHUP that was ignored at the start, as by nohup, stays ignored.
class Interrupt {
public:
    explicit Interrupt(Suspending suspending = Suspending::allowed);
    Interrupt(const Interrupt&) = delete;
    Interrupt& operator=(const Interrupt&) = delete;
    ~Interrupt();

    [[nodiscard]] std::stop_token token() const { return asked_.get_token(); }
    /// Where suspending is refused: asked for the second time, so that braking is not waited for.
    [[nodiscard]] bool insisted() const { return insisted_; }

private:
    void listen();

    Suspending suspending_;
    sigset_t watched_;
    std::atomic<bool> insisted_ = false;
    std::stop_source asked_;
    int signals_ = -1; ///< readable when a signal came
    int over_ = -1;    ///< readable when the thread is to end
    std::jthread thread_;
};

} // namespace millwright::app
