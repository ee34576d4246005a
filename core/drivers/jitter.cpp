#include "core/drivers/jitter.h"

#include <algorithm>
#include <cmath>

namespace millwright::drivers {

namespace {

constexpr double first_cell = 1e-7; // s: all that is less falls into it
constexpr double growth = 1.01;
constexpr int cell_count = 2320; // up to 1000 s

} // namespace

JitterMeter::JitterMeter() : cells_(cell_count) {}

void JitterMeter::add(double delay) {
    delay = std::max(delay, 0.0);
    sums_.least = sums_.count == 0 ? delay : std::min(sums_.least, delay);
    sums_.most = std::max(sums_.most, delay);
    ++sums_.count;
    total_ += delay;
    const auto* const bound = std::ranges::lower_bound(Jitter::bounds, delay);
    ++sums_.histogram[static_cast<std::size_t>(bound - Jitter::bounds.begin())];
    const double cell = delay > first_cell ? std::ceil(std::log(delay / first_cell) / std::log(growth)) : 0.0;
    ++cells_[static_cast<std::size_t>(std::min(cell, cell_count - 1.0))];
}

double JitterMeter::percentile(double part) const {
    const auto wanted = static_cast<std::int64_t>(std::ceil(part * static_cast<double>(sums_.count)));
    std::int64_t seen = 0;
    for (int n = 0; n < cell_count; ++n) {
        seen += cells_[static_cast<std::size_t>(n)];
        if (seen >= wanted) {
            return std::clamp(first_cell * std::pow(growth, n), sums_.least, sums_.most);
        }
    }
    return sums_.most;
}

Jitter JitterMeter::jitter() const {
    Jitter result = sums_;
    if (result.count > 0) {
        result.mean = total_ / static_cast<double>(result.count);
        result.median = percentile(0.5);
        result.p95 = percentile(0.95);
        result.p99 = percentile(0.99);
    }
    return result;
}

} // namespace millwright::drivers
