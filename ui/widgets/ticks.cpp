#include "ui/widgets/ticks.h"

#include "core/base/text.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::widgets {

namespace {

constexpr double end_slack = 1e-9; // of a step: an end that is a multiple of the step up to rounding counts
constexpr double narrowest = 1e-9; // of the numbers' size: below, rounding would show in the spacing
constexpr int most_decimals = 6;
constexpr double longest_number = 1e7;

double power_of_ten(int exponent) {
    return std::pow(10.0, exponent);
}

/// i * mantissa * 10^exponent, rounded once, so that ticks read 0.3 and not 0.30000000000000004.
double multiple(double i, double mantissa, int exponent) {
    return exponent < 0 ? i * mantissa / power_of_ten(-exponent) : i * mantissa * power_of_ten(exponent);
}

} // namespace

Ticks ticks(double low, double high, int at_most) {
    const double span = high - low;
    const double size = std::max(std::abs(low), std::abs(high));
    if (at_most < 1 || !std::isfinite(span) || !(span > narrowest * size) ||
        span / at_most < std::numeric_limits<double>::min()) {
        return {};
    }
    int exponent = static_cast<int>(std::floor(std::log10(span / at_most)));
    for (int tries = 0; tries < 3; ++tries, ++exponent) {
        for (const double mantissa : {1.0, 2.0, 5.0}) {
            const double step = multiple(1.0, mantissa, exponent);
            const double first = std::ceil(low / step - end_slack);
            const double count = std::floor(high / step + end_slack) - first + 1.0;
            if (!(count <= at_most)) {
                continue;
            }
            Ticks found;
            found.decimals = std::max(0, -exponent);
            for (double i = 0.0; i < count; i += 1.0) {
                found.values.push_back(std::clamp(multiple(first + i, mantissa, exponent), low, high));
            }
            return found;
        }
    }
    return {};
}

Ticks scale_ticks(double low, double high, int at_most) {
    constexpr int surely_two = 5; // of five at most, two lie in any range
    Ticks found = ticks(low, high, at_most);
    for (int more = at_most + 1; found.values.size() < 2 && more <= surely_two; ++more) {
        found = ticks(low, high, more);
    }
    return found;
}

std::string tick_text(double value, const Ticks& of) {
    const bool plain = of.decimals <= most_decimals && std::abs(value) < longest_number;
    return plain ? fixed(value, of.decimals) : fmt::format("{:.3g}", value);
}

} // namespace millwright::widgets
