// Progress on standard error: a bar with the remaining time on a terminal, else a line now and then.
#pragma once

#include "core/base/progress.h"

#include <chrono>
#include <optional>
#include <string>

namespace millwright::app {

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

} // namespace millwright::app
