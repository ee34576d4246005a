#include "ui/toolpath_panels/compare_view.h"

#include "core/project/setting_tables.h"
#include "ui/panels/fields.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace millwright::panels {

namespace {

using actions::CompareWith;
using project::GridMethod;

struct Choice {
    CompareWith compared;
    widgets::Option option;
};

std::vector<Choice> choices_of(const FrameState& now) {
    std::vector<Choice> choices{{{}, {"nothing", "None", {}, "Single view of the current result", {}}}};
    for (const GridMethod method : project::every_grid_method) {
        if (now.evaluation(method)) {
            const auto& row = project::row_of(project::grid_methods(), method);
            choices.push_back({{method, false}, {row.id, row.label, {}, row.tip, {}}});
        }
    }
    choices.push_back({{{}, false, true},
                       {"design", "Designed surface", {}, "For comparison with the produced surface", {}}});
    if (now.view_state.kept) {
        choices.push_back({{{}, true}, {"kept", {}, {}, "Result pinned for comparison", {}}});
    }
    return choices;
}

/// "ac-table, part at 0, 0, 50 mm": what tells it from another; the rest stands over its picture.
std::string kept_text(const FrameState& now) {
    const auto& kept = now.view_state.kept;
    return kept ? kept->project.machine.file + ", " + kept->place : std::string();
}

/// The map of the last search, where it is one of the kept part, too.
std::shared_ptr<const plan::SetUpResult> map_for(const actions::KeptResult& kept, const FrameState& now) {
    return now.set_up && plan::same_but_for_place(now.set_up->project, kept.project) ? now.set_up : nullptr;
}

toolpath::SetUpPlace kept_place(const actions::KeptResult& kept, const plan::SetUpResult& map) {
    toolpath::SetUpPlace place = map.now;
    place.head<3>() = kept.cutting_setup->machine.description().workpiece_offset;
    return place;
}

/// Nothing of the path.
NamedScene designed_scene(const viewport::Scene& shown) {
    NamedScene designed{shown, "Designed"};
    designed.scene.stock = nullptr; // it is of the program
    designed.scene.now.reset();
    designed.scene.layers = {
        .design = {.lines = true}, .floor = shown.layers.floor, .origin = shown.layers.origin};
    return designed;
}

} // namespace

void compare_fields(Ui& ui, const FrameState& now, ActionQueue& ask, const actions::Catalogue& catalogue) {
    const std::vector<Choice> choices = choices_of(now);
    std::vector<widgets::Option> options;
    const std::string kept = kept_text(now);
    int index = 0;
    for (std::size_t n = 0; n < choices.size(); ++n) {
        options.push_back(choices[n].option);
        options.back().label = choices[n].compared.kept ? std::string_view(kept) : options.back().label;
        index = choices[n].compared == now.view_state.compare_with ? static_cast<int>(n) : index;
    }
    const auto labels = ui.label_share(0.32F); // a machine and a place are long words
    if (const auto chosen = ui.choice("beside",
                                      "Compare with",
                                      index,
                                      options,
                                      "Show another result on the left with the same colour scale")) {
        ask.show([compared = choices[static_cast<std::size_t>(*chosen)].compared](
                     actions::ViewState& view_state) { view_state.compare_with = compared; });
    }
    action_button(ui, now, ask, catalogue, "view.keep_result");
}

std::optional<ComparedPath> path_to_compare(const FrameState& now) {
    const CompareWith& compared = now.view_state.compare_with;
    if (now.view_state.workspace != actions::Workspace::toolpath || !compared.any() || compared.design) {
        return std::nullopt;
    }
    if (compared.kept) {
        const auto& kept = now.view_state.kept;
        return ComparedPath{kept->evaluation, "Pinned: " + kept->name + ", " + kept->place};
    }
    auto path = now.evaluation(*compared.method);
    std::string name(project::row_of(project::grid_methods(), *compared.method).label);
    return path ? std::optional(ComparedPath{std::move(path), std::move(name)}) : std::nullopt;
}

std::optional<NamedScene> compared_scene(const FrameState& now, viewport::Scene& shown) {
    const CompareWith& compared = now.view_state.compare_with;
    if (compared.design && now.view_state.workspace == actions::Workspace::toolpath && shown.shown) {
        return designed_scene(shown);
    }
    const auto path = path_to_compare(now);
    if (!path || !shown.shown) {
        return std::nullopt;
    }
    NamedScene other{shown, path->name};
    other.scene.now.reset();
    other.scene.stock = nullptr; // it is of the program
    other.scene.shown = path->path;
    if (compared.kept) {
        const auto& kept = now.view_state.kept;
        other.name = kept->name + "\n" + kept->place;
        other.scene.surface = kept->surface;
        other.scene.cutting_setup = kept->cutting_setup;
        other.scene.cut = kept->cut;
        other.scene.set_up = map_for(*kept, now);
        if (other.scene.set_up) {
            other.scene.set_up_place = kept_place(*kept, *other.scene.set_up);
        }
        other.scene.singular_points = kept->singular_points;
    } else {
        other.scene.cut = now.plan->plan.cut_of(now.project, other.scene.shown.get());
    }
    const double high =
        std::max(viewport::error_colors(shown, {}).high, viewport::error_colors(other.scene, {}).high);
    shown.error.high = other.scene.error.high = high;
    return other;
}

std::string shown_name_in_comparison(const FrameState& now) {
    return now.view_state.compare_with.kept
               ? now.shown_name() + " on " + now.project.machine.file + "\n" + now.part_place()
               : now.shown_name();
}

} // namespace millwright::panels
