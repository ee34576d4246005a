// Work of a command that a person can watch, and end by Ctrl+C.
#pragma once

#include "core/base/progress.h"

#include <atomic>
#include <chrono>
#include <csignal>
#include <optional>
#include <stop_token>
#include <string>
#include <thread>

namespace millwright::app {

// Ctrl+C, asking politely: the first signal that would end the program, or a terminal that is closed, asks
// the work to stop; another SIGINT, SIGTERM or SIGQUIT, half a second later or more, ends the program; where
// it watches over a machine, the third one does.

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

// Progress on standard error: a bar with the remaining time on a terminal, else a line now and then.

class ProgressPrinter {
public:
    ProgressPrinter();
    ProgressPrinter(const ProgressPrinter&) = delete;
    ProgressPrinter& operator=(const ProgressPrinter&) = delete;
    ~ProgressPrinter();

    void show(const Progress::Report& report);
    /// A whole line that stays, above the bar.
    void say(const std::string& line);
    /// While nothing is done, so that the remaining time is estimated from the rest.
    void pause(bool on);
    /// Takes the bar away, so that other lines can follow.
    void finish();

private:
    using Clock = std::chrono::steady_clock;

    void draw_bar(const Progress::Report& report, double elapsed);
    void print_line(const Progress::Report& report);

    bool on_terminal_;
    bool drawn_ = false;
    Clock::time_point begin_;
    Clock::time_point last_;
    std::optional<Clock::time_point> paused_; ///< since when
    std::string words_;                       ///< of the last line that was printed
    int tenths_ = -1;                         ///< of the work, in that line
};

class WatchedWork {
public:
    WatchedWork()
        : progress_([this](const Progress::Report& report) { printer_.show(report); }, interrupt_.token()) {}
    WatchedWork(const WatchedWork&) = delete;
    WatchedWork& operator=(const WatchedWork&) = delete;
    ~WatchedWork() = default;

    [[nodiscard]] const Progress& progress() const { return progress_; }
    /// Takes the bar away, so that other lines can follow.
    void finish() { printer_.finish(); }

private:
    Interrupt interrupt_;
    ProgressPrinter printer_;
    Progress progress_;
};

} // namespace millwright::app
