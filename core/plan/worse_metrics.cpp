#include "core/plan/internal/worse_metrics.h"

#include "core/base/text.h"
#include "core/base/units.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <string_view>
#include <vector>

namespace millwright::plan {

std::string worse_metrics(const grid::ErrorSummary& a, const grid::ErrorSummary& b, bool turns) {
    std::vector<std::string> found;
    const auto compare =
        [&](std::string_view name, double of_a, double of_b, std::string_view unit, int decimals) {
            const std::string a_text = fixed(of_a, decimals), b_text = fixed(of_b, decimals);
            if (of_a > of_b && a_text != b_text) {
                found.push_back(fmt::format("{} {} versus {} {}", name, a_text, b_text, unit));
            }
        };
    compare("largest", a.max, b.max, "mm", 3);
    compare("mean", a.mean, b.mean, "mm", 3);
    compare("length-weighted mean", a.lmean, b.lmean, "mm", 3);
    if (turns) {
        compare("axis", to_degrees(a.axis_max), to_degrees(b.axis_max), "deg", 1);
    }
    return fmt::format("{}", fmt::join(found, ", "));
}

} // namespace millwright::plan
