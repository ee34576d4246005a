// A running job under the keys of the person at the terminal: p holds, r resumes (also after M0), + and -
// change the feed by 10 %, 0 makes it 100 % again, b switches single block, o optional stops, q stops.
#pragma once

#include "core/machine/dispatcher.h"

#include <thread>

namespace millwright::app {

class JobKeys {
public:
    /// Listens to standard input while it is this program's terminal; to any standard input if `always`.
    /// `optional_stop`: how the switch is now.
    JobKeys(machine::Dispatcher& dispatcher, bool always, bool optional_stop);
    JobKeys(const JobKeys&) = delete;
    JobKeys& operator=(const JobKeys&) = delete;
    ~JobKeys();

    [[nodiscard]] bool listening() const { return thread_.joinable(); }

private:
    void listen(const std::stop_token& over);
    void obey(char key);

    machine::Dispatcher& dispatcher_;
    machine::Overrides overrides_;
    bool single_block_ = false;
    bool optional_stop_;
    int over_ = -1;       ///< readable when nobody listens any more
    std::jthread thread_; // last: it uses what stands before it
};

} // namespace millwright::app
