#include "ui/toolpath_panels/set_up_fields.h"

#include "core/base/sentences.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/plan/set_up_edge.h"
#include "ui/panels/fields.h"
#include "ui/panels/numbers_text.h"
#include "ui/viewport/map_picture.h"
#include "ui/viewport/set_up_map.h"
#include "ui/widgets/heat_map.h"
#include "ui/widgets/notices.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>

namespace millwright::panels {

namespace {

using plan::SetUpStudySettings;
using toolpath::SetUpGoal;
using toolpath::SetUpParameter;

constexpr std::array<widgets::Option, 2> goals{
    {{"error", "Error", "", "Minimise the mean distance of the actual tool tip from the surface curve"},
     {"travel", "Travel", "", "Minimise the travel of the linear axes over the whole path"}}};
constexpr std::array<widgets::Option, 4> parameters{
    {{"a", "a", "", "Part offset across the table"},
     {"b", "b", "", "Part offset along the table"},
     {"c", "c", "", "Part height above the table"},
     {"turn", "turn", "", "Part rotation about the vertical axis, applied before the offset"}}};

/// Another one where both would be the same: a map has two.
SetUpParameter other_than(SetUpParameter taken, SetUpParameter wanted) {
    if (taken != wanted) {
        return wanted;
    }
    return taken == SetUpParameter::a ? SetUpParameter::b : SetUpParameter::a;
}

template <class Value>
void choose_set_up(Ui& ui,
                   ActionQueue& ask,
                   std::string_view id,
                   std::string_view label,
                   Value now,
                   std::span<const widgets::Option> options,
                   void (*set)(SetUpStudySettings&, Value)) {
    if (const auto chosen = ui.choice(id, label, static_cast<int>(now), options)) {
        ask.show([set, value = static_cast<Value>(*chosen)](actions::ViewState& view_state) {
            set(view_state.set_up.settings, value);
        });
    }
}

void set_up_number(Ui& ui,
                   ActionQueue& ask,
                   double now,
                   const widgets::FieldInfo& info,
                   void (*set)(SetUpStudySettings&, double)) {
    if (const auto value = ui.number(now, info)) {
        ask.show([set, v = *value](actions::ViewState& view_state) { set(view_state.set_up.settings, v); });
    }
}

void setting_fields(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const SetUpStudySettings& set = now.view_state.set_up.settings;
    choose_set_up<SetUpGoal>(
        ui, ask, "goal", "Minimise", set.goal, goals, [](SetUpStudySettings& s, SetUpGoal g) { s.goal = g; });
    choose_set_up<SetUpParameter>(
        ui, ask, "across", "Map X axis", set.across, parameters, [](SetUpStudySettings& s, SetUpParameter p) {
            s.across = p;
            s.up = other_than(p, s.up);
        });
    choose_set_up<SetUpParameter>(
        ui, ask, "up", "Map Y axis", set.up, parameters, [](SetUpStudySettings& s, SetUpParameter p) {
            s.up = p;
            s.across = other_than(p, s.across);
        });
    set_up_number(ui,
                  ask,
                  set.reach,
                  {"reach",
                   "Search range a, b",
                   "mm",
                   "Search range around the table centre, in both directions",
                   1.0,
                   1000.0,
                   60.0,
                   1},
                  [](SetUpStudySettings& s, double v) { s.reach = v; });
    set_up_number(ui,
                  ask,
                  set.height_reach,
                  {"height_reach",
                   "Search range c",
                   "mm",
                   "Search range around the default height of the machine, in both directions",
                   1.0,
                   1000.0,
                   80.0,
                   1},
                  [](SetUpStudySettings& s, double v) { s.height_reach = v; });
    set_up_number(ui,
                  ask,
                  to_degrees(set.turn_reach),
                  {"turn_reach",
                   "Search range turn",
                   "deg",
                   "Search range of the part rotation, in both directions; 0: no rotation",
                   0.0,
                   180.0,
                   0.0,
                   1},
                  [](SetUpStudySettings& s, double v) { s.turn_reach = from_degrees(v); });
    constexpr double most_places = 101.0;
    set_up_number(
        ui,
        ask,
        set.places,
        {"places", "Map samples", "", "Samples per direction of the map", 2.0, most_places, 21.0, 0},
        [](SetUpStudySettings& s, double v) { s.places = static_cast<int>(std::lround(v)); });
}

void map_field(Ui& ui, const FrameState& now, ActionQueue& ask, const plan::SetUpResult& found) {
    const toolpath::SetUpMap& map = found.study->map;
    const viewport::SetUpMapView labelled(
        map, found.settings.goal, found.study->search.best.place, now.set_up_place());
    widgets::HeatMapView view = labelled.view;
    view.colours = viewport::map_colours();
    view.height = ui.px(240.0F);
    if (const auto clicked = widgets::heat_map(ui, "map", view)) {
        ask.show([clicked = *clicked,
                  map_across = map.across,
                  map_up = map.up,
                  best = found.study->search.best.place](actions::ViewState& view_state) {
            toolpath::SetUpPlace place = best;
            const auto of_people = [](SetUpParameter parameter, double value) {
                return parameter == SetUpParameter::turn ? from_degrees(value) : value;
            };
            place[static_cast<Eigen::Index>(map_across)] = of_people(map_across, clicked.x);
            place[static_cast<Eigen::Index>(map_up)] = of_people(map_up, clicked.y);
            view_state.set_up.place = place;
        });
    }
}

std::string cost_text(double cost) {
    return std::isfinite(cost) ? length_text(cost) : std::string("out of reach");
}

std::string axis_text(const std::optional<double>& axis_max) {
    return axis_max ? angle_text(*axis_max) : std::string("-");
}

/// That the best place lies at the edge of what was searched, as long as that is known.
std::string edge_text(const FrameState& now, const plan::SetUpResult& found) {
    if (!now.plan || !now.plan->plan.cutting_setup || !plan::same_but_for_place(found.project, now.project)) {
        return {};
    }
    plan::CuttingSetup then = *now.plan->plan.cutting_setup;
    then.machine = then.machine.with_workpiece_offset(toolpath::offset_of(found.now));
    return plan::edge_sentence(
        found.study->search,
        plan::set_up_box(then, found.settings),
        {"Search range a, b", "Search range a, b", "Search range c", "Search range turn"});
}

void result_fields(Ui& ui, const FrameState& now, ActionQueue& ask, const plan::SetUpResult& found) {
    if (found.failure) {
        (void)widgets::banner(
            ui,
            "failure",
            {widgets::Severity::warning,
             with_sentence(as_sentence(found.failure->message), as_sentence(found.failure->hint)),
             {}});
        return;
    }
    map_field(ui, now, ask, found);
    const toolpath::SetUpSearch& search = found.study->search;
    const bool by_error = found.settings.goal == SetUpGoal::error;
    ui.note(fmt::format("{} for a uniform grid of {} x {} nodes{}:",
                        by_error ? "Mean distance to the surface curve" : "Travel of the linear axes",
                        found.settings.nodes,
                        found.settings.nodes,
                        by_error ? " (the outline shows the distance to the surface)" : ""));
    ui.value("start",
             "Start position",
             cost_text(search.start.cost),
             "mm",
             "Value at the part position at which the search started");
    ui.value("best",
             "Best position",
             cost_text(search.best.cost) +
                 (std::isfinite(search.start.cost)
                      ? "  (" + change_text(search.start.cost, search.best.cost) + ")"
                      : std::string()),
             "mm");
    if (by_error) {
        ui.value("axis",
                 "Axis deviation",
                 axis_text(search.start.axis_max) + " \u2192 " + axis_text(search.best.axis_max),
                 "deg",
                 "Largest angle between tool axis and surface normal along the path: start position \u2192 "
                 "best position");
    }
    const std::string edge = edge_text(now, found);
    if (!edge.empty()) {
        (void)widgets::banner(ui, "edge", {widgets::Severity::info, edge, {}});
    }
    const toolpath::SetUpPlace place = now.set_up_place();
    ui.value("place",
             "Selected a, b, c",
             fmt::format("{}, {}, {}", fixed(place[0], 1), fixed(place[1], 1), fixed(place[2], 1)),
             "mm");
    if (found.settings.turn_reach > 0.0 || std::abs(place[3]) > 0.0) {
        ui.value("place_turn", "Selected rotation", fixed(to_degrees(place[3]), 1), "deg");
    }
}

} // namespace

void set_up_fields(Ui& ui, const FrameState& now, ActionQueue& ask, const actions::Catalogue& catalogue) {
    const auto section = ui.section("set_up_search", "Best position on table", false);
    if (!section) {
        return;
    }
    setting_fields(ui, now, ask);
    {
        const auto row = ui.row(2);
        action_button(ui, now, ask, catalogue, "set_up.search", widgets::Rank::normal, "Search");
        action_button(ui, now, ask, catalogue, "set_up.accept", widgets::Rank::primary, "Accept");
    }
    if (now.set_up) {
        result_fields(ui, now, ask, *now.set_up);
    } else {
        ui.note("Search for the part position with the smallest error or the shortest machine travel.");
    }
}

} // namespace millwright::panels
