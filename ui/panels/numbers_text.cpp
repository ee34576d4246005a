#include "ui/panels/numbers_text.h"

#include "core/base/text.h"
#include "core/base/units.h"

#include <fmt/chrono.h>

#include <algorithm>
#include <cmath>
#include <ctime>

namespace millwright::panels {

std::string length_text(double mm) {
    constexpr double small = 0.1;
    return std::isfinite(mm) ? fixed(mm, std::abs(mm) < small ? 4 : 3) : "-";
}

std::string deviation_text(double mm) {
    constexpr int least = 4;
    constexpr int most = 9;
    if (!std::isfinite(mm)) {
        return "-";
    }
    const bool is_zero = !(std::abs(mm) >= std::pow(10.0, -most));
    const int wanted = is_zero ? least : 1 + static_cast<int>(std::ceil(-std::log10(std::abs(mm))));
    return fixed(mm, std::clamp(wanted, least, most));
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
