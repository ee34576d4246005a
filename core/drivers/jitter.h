// How late things were that should have happened at equal intervals. Times s.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

namespace millwright::drivers {

/// What is known of many delays; all 0 while there is none.
struct Jitter {
    std::int64_t count = 0;
    double least = 0.0, mean = 0.0, most = 0.0;
    double median = 0.0, p95 = 0.0, p99 = 0.0; ///< not exceeded by 50, 95, 99 % of them, to 1 % of itself

    /// By how late: up to 10 us, 32 us, 100 us, 0.3 ms, 1 ms, 3 ms, 10 ms, later.
    static constexpr std::array<double, 7> bounds{1e-5, 3.2e-5, 1e-4, 3.2e-4, 1e-3, 3.2e-3, 1e-2};
    std::array<std::int64_t, bounds.size() + 1> histogram{};
};

/// Counts them in cells of 1 %, from 0.1 us to 1000 s, so that any number takes the same memory.
class JitterMeter {
public:
    JitterMeter();
    /// Too early counts as in time.
    void add(double delay);
    [[nodiscard]] Jitter jitter() const;

private:
    [[nodiscard]] double percentile(double part) const;

    std::vector<std::int64_t> cells_;
    Jitter sums_; ///< least, most, histogram, count
    double total_ = 0.0;
};

} // namespace millwright::drivers
