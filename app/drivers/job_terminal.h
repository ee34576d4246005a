// A running job on the terminal: what a person reads of it, and the keys that act on it.
#pragma once

#include "app/command_line/watched_work.h"
#include "core/jobs/dispatcher.h"

#include <string>
#include <thread>

namespace millwright::app {

// A running job under the keys of the person at the terminal: p holds, r resumes (also after M0), + and -
// change the feed by 10 %, 0 makes it 100 % again, b switches single block, o optional stops, q stops.

struct JobSwitches {
    bool optional_stop = false;
    bool single_block = false;
};

class JobKeys {
public:
    /// Listens to standard input while it is this program's terminal; to any standard input if `always`.
    /// `now`: how the switches are.
    JobKeys(jobs::Dispatcher& dispatcher, bool always, JobSwitches now);
    JobKeys(const JobKeys&) = delete;
    JobKeys& operator=(const JobKeys&) = delete;
    ~JobKeys();

    [[nodiscard]] bool listening() const { return thread_.joinable(); }

private:
    void listen(const std::stop_token& over);
    void obey(char key);

    jobs::Dispatcher& dispatcher_;
    drivers::Overrides overrides_;
    JobSwitches switches_;
    int over_ = -1;       ///< readable when the thread is to end
    std::jthread thread_; // last: it uses what stands before it
};

// What a person reads on the terminal of a job that runs: how far it is, and what it waits for.

class JobPrinter {
public:
    /// `keys`: can be pressed.
    void show(const jobs::JobReport& report, bool keys);
    /// Of what comes before the job.
    void show(const Progress::Report& report) { printer_.show(report); }

private:
    void tell_waiting(const drivers::DriverStatus& now, bool keys);

    ProgressPrinter printer_;
    std::string waits_for_; ///< that was reported; empty: nothing
};

} // namespace millwright::app
