// Round numbers for the ticks of an axis: steps of 1, 2 or 5 times a power of ten.
#pragma once

#include <string>
#include <vector>

namespace millwright::widgets {

struct Ticks {
    std::vector<double> values; ///< ascending, from low to high inclusive; empty if low..high is no range
    int decimals = 0;           ///< that the step needs
};

/// At most `at_most` ticks (at least 2 when `at_most` >= 5). Not finite, or high not
/// above low by at least 1e-9 of their size: no ticks.
[[nodiscard]] Ticks ticks(double low, double high, int at_most);

/// The same for an axis that is read: where that would be one tick, which tells no scale, a few more.
[[nodiscard]] Ticks scale_ticks(double low, double high, int at_most);

/// The value as a tick of these writes it; very large and very small ones as 1.2e-07.
[[nodiscard]] std::string tick_text(double value, const Ticks& of);

} // namespace millwright::widgets
