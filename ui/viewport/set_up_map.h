// The map of what the places of the part on the table cost, with its words: the same in the window and in the
// pictures of the command line.
#pragma once

#include "core/plan/set_up_study.h"
#include "ui/widgets/heat_map.h"

#include <vector>

namespace millwright::viewport {

/// `view` refers to the other members, and its values to the map that it was made of.
struct SetUpMapView {
    std::vector<double> x, y; ///< in units for people
    widgets::HeatMapView view;

    SetUpMapView(const toolpath::SetUpMap& map,
                 toolpath::SetUpGoal goal,
                 const toolpath::SetUpPlace& best,
                 const toolpath::SetUpPlace& chosen);
    SetUpMapView(const SetUpMapView&) = delete;
    SetUpMapView& operator=(const SetUpMapView&) = delete;
    ~SetUpMapView() = default;
};

/// What `goal` makes small, for people.
[[nodiscard]] std::string_view title(toolpath::SetUpGoal goal);

} // namespace millwright::viewport
