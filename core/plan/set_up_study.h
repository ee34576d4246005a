// Where on the table the part of a project is cut best: a search over its place and turn, and a map of what
// they cost around the best.
#pragma once

#include "core/plan/plan.h"
#include "core/toolpath/set_up_search.h"

#include <string>
#include <string_view>

namespace millwright::plan {

/// Values outside their range throw Defect.
struct SetUpStudySettings {
    toolpath::SetUpGoal goal = toolpath::SetUpGoal::error;
    toolpath::SetUpParameter across = toolpath::SetUpParameter::a; ///< of the map's columns
    toolpath::SetUpParameter up = toolpath::SetUpParameter::b;     ///< of its rows, another one
    int places = 21;                                               ///< each way of the map, 2 to 500
    double reach = 60.0;        ///< mm that the part may be shifted both ways along a and b, above 0
    double height_reach = 80.0; ///< the same along c
    double turn_reach = 0.0;    ///< rad that it may be turned both ways about the vertical, 0 to pi
    int nodes = 20;             ///< of the grid each way that the cost is measured on, 2 to 200

    friend bool operator==(const SetUpStudySettings&, const SetUpStudySettings&) = default;
};

/// a and b about the part's own middle on the table's origin, c about the machine's.
[[nodiscard]] toolpath::SetUpSearchSettings set_up_box(const CuttingSetup& cutting_setup,
                                                       const SetUpStudySettings& settings);

/// What a uniform grid on this workpiece costs.
[[nodiscard]] toolpath::SetUpCost set_up_cost(const CuttingSetup& cutting_setup,
                                              const SetUpStudySettings& settings);

struct SetUpStudy {
    toolpath::SetUpSearch search;
    toolpath::SetUpMap map; ///< through the best place
};

/// `measure`: who measures many places at once; empty for this process's threads. The same bytes by any
/// number of them. Throws Cancelled, what `measure` throws, and Error, with the reason, if no place is in
/// reach.
[[nodiscard]] SetUpStudy set_up_study(const CuttingSetup& cutting_setup,
                                      const SetUpStudySettings& settings,
                                      const Progress& progress,
                                      const toolpath::SetUpCosts& measure = {});

/// The project with the part there: the offset is of the machine, a turn is one of all control points.
[[nodiscard]] project::Project with_set_up(project::Project project, const toolpath::SetUpPlace& place);

/// Of a parameter, for people and in files; its unit.
[[nodiscard]] std::string_view name(toolpath::SetUpParameter parameter);
[[nodiscard]] std::string_view unit(toolpath::SetUpParameter parameter);
/// mm or degrees.
[[nodiscard]] double for_people(toolpath::SetUpParameter parameter, double value);

/// The map, comma-separated, one line a place; nothing where it is out of reach, or of the tool axis where
/// nothing was measured.
[[nodiscard]] std::string set_up_csv(const toolpath::SetUpMap& map);

} // namespace millwright::plan
