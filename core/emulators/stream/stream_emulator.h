// A machine that takes a coordinate stream: goes to one sample per period, says nothing, and remembers where
// it was sent. Format: docs/reference/coordinate-stream.md. Lengths mm, angles degrees, as in the stream.
#pragma once

#include "core/emulators/emulator.h"

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::emulators {

struct StreamTruth {
    std::int64_t headings = 0;
    std::int64_t samples = 0; ///< that were gone to
    std::int64_t bad_lines =
        0;                   ///< that were neither, or came before a heading; the machine stays where it is
    std::string first_fault; ///< in a sentence; empty without any
    std::vector<double> greatest_speed; ///< of each axis, mm/s or deg/s, from one sample to the next
    double last_motion = -1.0;          ///< when it last moved; negative: never
};

class StreamEmulator final : public Emulator {
public:
    void receive(std::string_view bytes) override;
    [[nodiscard]] bool full() const override { return due_.size() >= most_due; }
    void advance(double seconds) override;
    [[nodiscard]] std::string take_output() override { return {}; }
    [[nodiscard]] bool moving() const override { return !due_.empty(); }
    /// Stands where it is, deaf, until the next heading.
    void raise_alarm() override;
    void power_cycle() override;

    [[nodiscard]] double time() const { return time_; }
    [[nodiscard]] const StreamTruth& truth() const { return truth_; }
    /// Of the last heading; empty before there was one.
    [[nodiscard]] const std::vector<std::string>& axes() const { return axes_; }
    /// Its position; empty before the first sample.
    [[nodiscard]] const std::vector<double>& position() const { return position_; }

private:
    static constexpr std::size_t most_due = 10'000; ///< samples that wait
    void take(std::string_view line);
    void take_heading(std::string_view line);
    void bad(std::string_view line, std::string_view why);
    void go_to(std::vector<double> sample);

    std::string input_; ///< a line that has no end yet
    bool too_long_ = false;
    double period_ = 0.0; ///< 0: no heading, so samples mean nothing
    std::vector<std::string> axes_;
    std::deque<std::vector<double>> due_;
    std::vector<double> position_;
    double time_ = 0.0, next_ = 0.0; ///< now, and when the next sample is due
    StreamTruth truth_;
};

} // namespace millwright::emulators
