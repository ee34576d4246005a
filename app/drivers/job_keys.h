// A running job under the keys of the person at the terminal: p holds, r resumes (also after M0), + and -
// change the feed by 10 %, 0 makes it 100 % again, b switches single block, o optional stops, q stops.
#pragma once

#include "core/jobs/dispatcher.h"

#include <thread>

namespace millwright::app {

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

} // namespace millwright::app
