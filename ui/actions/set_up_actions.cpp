#include "core/base/numbers.h"
#include "ui/actions/internal/simple_action.h"
#include "ui/actions/workshop.h"

#include <optional>

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using widgets::Permission;

/// Also of a part that is out of reach where it stands: another place may help.
Permission can_search(const Workbench& now) {
    return now.plan && now.plan->plan.workpiece
               ? Permission{}
               : Permission::refused("There is no part on a machine yet. " + now.failure());
}

/// The part is where the map is marked, and a turn of it is none.
bool stands_there(const Workbench& now) {
    const toolpath::SetUpPlace place = now.set_up_place();
    std::optional<Vec3> stands = now.project.machine.workpiece_offset;
    if (!stands && now.plan && now.plan->plan.workpiece) {
        stands = now.plan->plan.workpiece->machine.description().workpiece_offset;
    }
    const double turn = place[static_cast<Eigen::Index>(toolpath::SetUpParameter::turn)];
    return stands == toolpath::offset_of(place) && exactly_equal(turn, 0.0);
}

Permission can_accept(const Workbench& now) {
    if (!now.set_up || !now.set_up->study) {
        return Permission::refused("No place has been searched for.");
    }
    if (!plan::same_but_for_place(now.set_up->project, now.project)) {
        return Permission::refused(
            "Part, machine or tracks are others than those that the place was searched for.");
    }
    return stands_there(now) ? Permission::refused("The part stands there already.") : Permission{};
}

} // namespace

void add_set_up_actions(Actions& actions) {
    add(actions,
        {"set_up.search",
         "Grid",
         "Search the best place on the table",
         "Looks in the background for the place of the part with the least error or travel, and maps what "
         "the "
         "places around it cost.",
         "",
         icons::search},
        can_search,
        [](Hands& hands) { hands.workshop.search_set_up(); });
    add(actions,
        {"set_up.accept",
         "Grid",
         "Accept the place on the table",
         "Puts the part where the map is marked: at the best place, or where the map was clicked.",
         "",
         icons::check},
        can_accept,
        [](Hands& hands) { hands.workshop.accept_set_up(); });
}

} // namespace millwright::actions
