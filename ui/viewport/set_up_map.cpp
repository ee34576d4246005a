#include "ui/viewport/set_up_map.h"

namespace millwright::viewport {

namespace {

using toolpath::SetUpParameter;

std::vector<double> for_people(SetUpParameter parameter, std::vector<double> values) {
    for (double& value : values) {
        value = plan::for_people(parameter, value);
    }
    return values;
}

widgets::MapPlace on_map(const toolpath::SetUpMap& map, const toolpath::SetUpPlace& place) {
    const auto at = [&](SetUpParameter parameter) {
        return plan::for_people(parameter, place[static_cast<Eigen::Index>(parameter)]);
    };
    return {at(map.across), at(map.up)};
}

} // namespace

std::string_view title(toolpath::SetUpGoal goal) {
    return goal == toolpath::SetUpGoal::error ? "mean distance to curve" : "travel of the linear axes";
}

SetUpMapView::SetUpMapView(const toolpath::SetUpMap& map,
                           toolpath::SetUpGoal goal,
                           const toolpath::SetUpPlace& best,
                           const toolpath::SetUpPlace& chosen)
    : x(for_people(map.across, map.x)), y(for_people(map.up, map.y)) {
    view.title = title(goal);
    view.x_label = plan::name(map.across);
    view.x_unit = plan::unit(map.across);
    view.y_label = plan::name(map.up);
    view.y_unit = plan::unit(map.up);
    view.unit = "mm";
    view.when_empty = "All positions of the map are out of reach.";
    view.x = x;
    view.y = y;
    view.values = map.costs;
    view.best = on_map(map, best);
    view.chosen = on_map(map, chosen);
}

} // namespace millwright::viewport
