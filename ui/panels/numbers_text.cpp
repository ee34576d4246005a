#include "ui/panels/numbers_text.h"

#include "core/base/text.h"
#include "core/base/units.h"

#include <fmt/chrono.h>

#include <cmath>
#include <ctime>

namespace millwright::panels {

std::string length_text(double mm) {
    constexpr double small = 0.1;
    return std::isfinite(mm) ? fixed(mm, std::abs(mm) < small ? 4 : 3) : "-";
}

std::string angle_text(double rad) {
    return std::isfinite(rad) ? fixed(to_degrees(rad), 2) : "-";
}

std::string date_time_text(std::int64_t time_s) {
    const auto time = static_cast<std::time_t>(time_s);
    std::tm local{};
    return time_s > 0 && ::localtime_r(&time, &local) != nullptr ? fmt::format("{:%Y-%m-%d %H:%M}", local)
                                                                 : "-";
}

std::string change_text(double before, double now) {
    if (!std::isfinite(before) || !std::isfinite(now) || !(before > 0.0)) {
        return "-";
    }
    const double percent = 100.0 * (now - before) / before;
    return (percent > 0.0 ? "+" : "") + fixed(percent, 1) + " %";
}

} // namespace millwright::panels
