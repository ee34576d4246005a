// Work of a command that a person can watch, and end by Ctrl+C.
#pragma once

#include "app/command_line/interrupt.h"
#include "app/command_line/progress_printer.h"
#include "core/base/progress.h"

namespace millwright::app {

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
