// Waves of a running processor as a Value Change Dump (IEEE 1364 section 18), which GTKWave and others show.
#pragma once

#include "core/cordic/processor.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>

namespace millwright::cordic {

class VcdWriter {
public:
    /// `clock_hz` > 0 sets the time axis; times are rounded to picoseconds.
    VcdWriter(const NumberFormat& format, double clock_hz);

    /// The state after one more clock. Text is added only for what changed.
    void add(const ProcessorState& state);

    /// Bytes of text that take() would give.
    [[nodiscard]] std::size_t size() const { return text_.size(); }
    /// The text so far; what was taken is not given again.
    [[nodiscard]] std::string take();

private:
    static constexpr int signal_count = 40;

    void declare(int index, std::string_view name, int bits);
    void change(int index, Word value);

    std::string text_;
    double half_period_ps_;
    std::int64_t clocks_ = 0;
    int word_;
    std::array<int, signal_count> bits_{};
    std::array<Word, signal_count> last_{};
};

} // namespace millwright::cordic
