#include "ui/panels/link_text.h"

#include "core/base/text.h"
#include "core/base/units.h"

#include <fmt/format.h>

namespace millwright::panels {

std::string link_figures(const grid::ImproverLink& link, bool turns) {
    const grid::ErrorSummary& best = link.of_best;
    return fmt::format("{} / {} / {}",
                       fixed(best.max, 3),
                       fixed(best.mean, 3),
                       turns ? fixed(to_degrees(best.axis_max), 1) : "-");
}

std::string link_tip(const grid::ImproverLink& link, bool turns) {
    const grid::ErrorSummary& end = link.reached;
    const std::string axis = turns ? fmt::format(", axis {} deg", fixed(to_degrees(end.axis_max), 2)) : "";
    return fmt::format("{}: {} / {} mm{} at the end of this stage{}.",
                       link.name,
                       fixed(end.max, 4),
                       fixed(end.mean, 4),
                       axis,
                       link.refused.empty() ? "" : ", rejected: " + link.refused);
}

} // namespace millwright::panels
