#include "ui/design_panels/chain_stage_text.h"

#include "core/base/text.h"
#include "core/base/units.h"

#include <fmt/format.h>

namespace millwright::panels {

std::string stage_figures(const grid::ChainStage& stage, bool turns) {
    const grid::ErrorSummary& best = stage.of_best;
    return fmt::format("{} / {} / {}",
                       fixed(best.max, 3),
                       fixed(best.mean, 3),
                       turns ? fixed(to_degrees(best.axis_max), 1) : "-");
}

std::string stage_tip(const grid::ChainStage& stage, bool turns) {
    const grid::ErrorSummary& end = stage.reached;
    const std::string axis = turns ? fmt::format(", axis {} deg", fixed(to_degrees(end.axis_max), 2)) : "";
    return fmt::format("{}: {} / {} mm{} at the end of this stage{}.",
                       stage.name,
                       fixed(end.max, 4),
                       fixed(end.mean, 4),
                       axis,
                       stage.refused.empty() ? "" : ", rejected: " + stage.refused);
}

} // namespace millwright::panels
