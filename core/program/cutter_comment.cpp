#include "core/program/cutter_comment.h"

#include "core/base/units.h"
#include "core/program/number_format.h"

#include <algorithm>
#include <cctype>
#include <iterator>

namespace millwright::program {

std::string cutter_comment(const ProgramCutter& cutter, double unit) {
    constexpr int micrometres = 3;
    constexpr int more_in_inches = 3;
    const NumberFormat length{.decimals = unit > 1.0 ? micrometres + more_in_inches : micrometres,
                              .trailing_zeros = false};
    const NumberFormat angle{.decimals = 2, .trailing_zeros = false, .point = false};
    std::string text = cutter.number > 0 ? "T" + std::to_string(cutter.number) + " " : "";
    text += "D=" + length.text(cutter.diameter / unit);
    if (cutter.corner_radius) {
        text += " CR=" + length.text(*cutter.corner_radius / unit);
    }
    if (cutter.half_angle) {
        text += " TAPER=" + angle.text(to_degrees(*cutter.half_angle)) + "DEG";
    }
    if (cutter.tip_diameter > 0.0) {
        text += " TIP=" + length.text(cutter.tip_diameter / unit);
    }
    if (!cutter.kind.empty()) {
        text += " - ";
        std::ranges::transform(cutter.kind, std::back_inserter(text), [](unsigned char c) {
            return static_cast<char>(std::toupper(c));
        });
    }
    return text;
}

} // namespace millwright::program
