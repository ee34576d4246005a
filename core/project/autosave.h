// Keeps the copy of unsaved work up to date on a thread of its own, so that no caller waits for the disk: at
// once after the first change, then at most once per interval.
#pragma once

#include "core/project/recovery.h"

#include <chrono>
#include <condition_variable>
#include <mutex>
#include <optional>
#include <thread>
#include <variant>

namespace millwright::project {

class Autosave {
public:
    /// Throws Error if no copy can be kept in `folder`.
    Autosave(const std::filesystem::path& folder, std::chrono::milliseconds interval);
    Autosave(const Autosave&) = delete;
    Autosave& operator=(const Autosave&) = delete;
    /// Writes what has not been written yet; the copy stays behind.
    ~Autosave();

    /// `work` is to be found after a crash. Returns at once.
    void keep(UnsavedWork work);
    /// Nothing is unsaved: there is to be no copy. Returns at once.
    void drop();
    /// Blocks until what was asked for stands on disk.
    void wait_idle();
    /// Why the last write failed; reported once.
    [[nodiscard]] std::optional<Diagnostic> take_failure();

private:
    struct Nothing {};
    using Wanted = std::variant<Nothing, UnsavedWork>;

    void ask(Wanted wanted, bool soon);
    void work(const std::stop_token& stop);
    void carry_out(const Wanted& wanted);

    RecoveryCopy copy_;
    std::chrono::milliseconds interval_;
    std::mutex mutex_;
    std::condition_variable_any changed_;
    std::optional<Wanted> wanted_;
    std::optional<Diagnostic> failure_;
    bool soon_ = false; ///< do not wait for the end of the interval
    bool busy_ = false;
    std::jthread thread_; // last: it is joined before what it uses goes
};

} // namespace millwright::project
