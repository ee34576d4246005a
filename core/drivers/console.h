// The lines that went between a driver and its controller, for people to look at: bounded, read bit by bit.
#pragma once

#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <string>
#include <vector>

namespace millwright::drivers {

enum class ConsoleKind {
    line,     ///< of a program or a command
    realtime, ///< a command outside of lines: hold, reset, override
    query,    ///< asks how the machine is
    report,   ///< tells how the machine is
    answer,   ///< to a line, when all is well
    message,  ///< anything else that the controller says
    fault     ///< a refusal, an alarm, a lost link
};

struct ConsoleLine {
    std::int64_t number = 0; ///< from 0, without gaps as they are added
    double time = 0.0;       ///< of the driver's clock, s
    bool sent = false;       ///< else received
    ConsoleKind kind = ConsoleKind::message;
    std::string text; ///< without its end; unprintable bytes are named in words
};

/// Safe from any thread.
class Console {
public:
    /// Keeps the last `capacity` lines. Queries and reports come ten times per second: they are left out
    /// until somebody asks for them.
    explicit Console(std::size_t capacity = 10'000);

    void add(double time, bool sent, ConsoleKind kind, std::string text);
    void keep_reports(bool keep);

    /// Appends the kept lines from number `from` on to `lines`, `most` at most; the number to go on from.
    /// So a reader copies each line once: `next = console.read(next, lines)`.
    std::int64_t read(std::int64_t from, std::vector<ConsoleLine>& lines, int most = 1000) const;
    /// The number of the next line that will be added.
    [[nodiscard]] std::int64_t end() const;

private:
    std::size_t capacity_;
    mutable std::mutex mutex_; ///< guards what follows
    bool keep_reports_ = false;
    std::int64_t end_ = 0;
    std::deque<ConsoleLine> lines_;
};

} // namespace millwright::drivers
