#include "core/base/numbers.h"
#include "ui/actions/app_controller.h"
#include "ui/actions/internal/simple_action.h"

#include <optional>

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using widgets::Permission;

/// Also of a part that is out of reach in its present place: another place may help.
Permission can_search(const FrameState& now) {
    return now.plan && now.plan->plan.cutting_setup
               ? Permission{}
               : Permission::refused("There is no part on a machine yet. " + now.failure());
}

/// The part is where the map is marked, and a turn of it is none.
bool stands_there(const FrameState& now) {
    const toolpath::SetUpPlace place = now.set_up_place();
    std::optional<Vec3> stands = now.project.machine.workpiece_offset;
    if (!stands && now.plan && now.plan->plan.cutting_setup) {
        stands = now.plan->plan.cutting_setup->machine.description().workpiece_offset;
    }
    const double turn = place[static_cast<Eigen::Index>(toolpath::SetUpParameter::turn)];
    return stands == toolpath::offset_of(place) && exactly_equal(turn, 0.0);
}

Permission can_accept(const FrameState& now) {
    if (!now.set_up || !now.set_up->study) {
        return Permission::refused("No position has been searched for.");
    }
    if (!plan::same_but_for_place(now.set_up->project, now.project)) {
        return Permission::refused("The part, machine or tracks have changed since the search.");
    }
    return stands_there(now) ? Permission::refused("The part is already there.") : Permission{};
}

} // namespace

void add_set_up_actions(Actions& actions) {
    add(actions,
        {"set_up.search",
         "Grid",
         "Find the best position on the table",
         "Searches in the background for the position of the part with the smallest error or travel, and "
         "maps the cost of the positions around it.",
         "",
         icons::search},
        can_search,
        [](ActionContext& context) { context.app.search_set_up(); });
    add(actions,
        {"set_up.accept",
         "Grid",
         "Accept the position on the table",
         "Moves the part to the position marked on the map: the best one, or the one that was clicked.",
         "",
         icons::check},
        can_accept,
        [](ActionContext& context) { context.app.accept_set_up(); });
}

} // namespace millwright::actions
