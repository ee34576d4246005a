#include "core/plan/set_up_reach.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "core/toolpath/sequencing.h"
#include "core/toolpath/tool_poses.h"
#include "core/toolpath/zigzag.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::plan {

namespace {

using toolpath::SetUpParameter;

/// "a -60.0 ... 60.0 mm, b ..."; a turn where it was searched.
std::string range_text(const toolpath::SetUpSearchSettings& within) {
    std::string text;
    for (const SetUpParameter parameter :
         {SetUpParameter::a, SetUpParameter::b, SetUpParameter::c, SetUpParameter::turn}) {
        const auto n = static_cast<Eigen::Index>(parameter);
        if (within.least[n] < within.most[n]) {
            text += fmt::format("{}{} {} ... {} {}",
                                text.empty() ? "" : ", ",
                                name(parameter),
                                fixed(for_people(parameter, within.least[n]), 1),
                                fixed(for_people(parameter, within.most[n]), 1),
                                unit(parameter));
        }
    }
    return text;
}

} // namespace

std::optional<std::string> why_out_of_reach(const CuttingSetup& cutting_setup,
                                            const SetUpStudySettings& settings,
                                            const toolpath::SetUpPlace& place) {
    const kinematics::MachineModel machine =
        cutting_setup.machine.with_workpiece_offset(toolpath::offset_of(place));
    const region::Region patch = cutting_setup.patch.turned(place[3]);
    const grid::Grid grid = grid::Grid::uniform(settings.nodes, settings.nodes);
    toolpath::Toolpath contacts =
        toolpath::zigzag(patch, grid, cutting_setup.direction, cutting_setup.flipped);
    try {
        (void)toolpath::sequence(
            machine, toolpath::with_tool(patch, machine, cutting_setup.tool, std::move(contacts)));
    } catch (const Error& error) { // as the cost of the place
        return error.diagnostic().message;
    }
    const bool in_reach = std::isfinite(set_up_cost(cutting_setup, settings).at(place, Progress()));
    return in_reach ? std::nullopt
                    : std::optional<std::string>("a point between two nodes cannot be reached");
}

void expect_in_reach(const toolpath::SetUpSearch& search,
                     const CuttingSetup& cutting_setup,
                     const SetUpStudySettings& settings,
                     const toolpath::SetUpSearchSettings& within) {
    if (std::isfinite(search.best.cost)) {
        return;
    }
    const std::string why = why_out_of_reach(cutting_setup, settings, search.start.place).value_or("");
    throw Error(fmt::format("the machine cannot reach the whole part from any position in the search range "
                            "({}); at the current position, {}",
                            range_text(within),
                            why),
                {},
                "widen the search range or allow a turn, make the part smaller, or choose another machine");
}

} // namespace millwright::plan
