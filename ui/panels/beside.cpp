#include "ui/panels/beside.h"

#include "core/project/settings.h"
#include "ui/panels/internal/fields.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace millwright::panels {

namespace {

using actions::Beside;
using project::GridMethod;

struct Choice {
    Beside beside;
    widgets::Option option;
};

std::vector<Choice> choices_of(const Workbench& now) {
    std::vector<Choice> choices{{{}, {"nothing", "None", {}, "Single view of the current result", {}}}};
    for (const GridMethod method : project::every_grid_method) {
        if (now.evaluation(method)) {
            const auto& row = project::row_of(project::grid_methods(), method);
            choices.push_back({{method, false}, {row.id, row.label, {}, row.tip, {}}});
        }
    }
    choices.push_back({{{}, false, true},
                       {"design", "Designed surface", {}, "For comparison with the produced surface", {}}});
    if (now.session.kept) {
        choices.push_back({{{}, true}, {"kept", {}, {}, "Result pinned for comparison", {}}});
    }
    return choices;
}

/// "ac-table, part at 0, 0, 50 mm": what tells it from another; the rest stands over its picture.
std::string kept_text(const Workbench& now) {
    const auto& kept = now.session.kept;
    return kept ? kept->project.machine.file + ", " + kept->place : std::string();
}

/// The map of the last search, where it is one of the kept part, too.
std::shared_ptr<const plan::SetUpResult> map_for(const actions::KeptResult& kept, const Workbench& now) {
    return now.set_up && plan::same_but_for_place(now.set_up->project, kept.project) ? now.set_up : nullptr;
}

toolpath::SetUpPlace kept_place(const actions::KeptResult& kept, const plan::SetUpResult& map) {
    toolpath::SetUpPlace place = map.now;
    place.head<3>() = kept.workpiece->machine.description().workpiece_offset;
    return place;
}

/// Nothing of the path.
NamedScene designed_beside(const viewport::Scene& shown) {
    NamedScene designed{shown, "Designed"};
    designed.scene.now.reset();
    designed.scene.layers = {
        .surface_lines = true, .floor = shown.layers.floor, .origin = shown.layers.origin};
    return designed;
}

} // namespace

void beside_fields(Ui& ui, const Workbench& now, ActionQueue& ask, const actions::Catalogue& catalogue) {
    const std::vector<Choice> choices = choices_of(now);
    std::vector<widgets::Option> options;
    const std::string kept = kept_text(now);
    int index = 0;
    for (std::size_t n = 0; n < choices.size(); ++n) {
        options.push_back(choices[n].option);
        options.back().label = choices[n].beside.kept ? std::string_view(kept) : options.back().label;
        index = choices[n].beside == now.session.beside ? static_cast<int>(n) : index;
    }
    const auto labels = ui.label_share(0.32F); // a machine and a place are long words
    if (const auto chosen = ui.choice("beside",
                                      "Compare with",
                                      index,
                                      options,
                                      "Show another result on the left with the same colour scale")) {
        ask.show([beside = choices[static_cast<std::size_t>(*chosen)].beside](actions::Session& session) {
            session.beside = beside;
        });
    }
    action_button(ui, now, ask, catalogue, "view.keep_result");
}

std::optional<PathBeside> path_beside(const Workbench& now) {
    const Beside& beside = now.session.beside;
    if (now.session.workspace != actions::Workspace::toolpath || !beside.any() || beside.design) {
        return std::nullopt;
    }
    if (beside.kept) {
        const auto& kept = now.session.kept;
        return PathBeside{kept->evaluation, "Pinned: " + kept->name + ", " + kept->place};
    }
    auto path = now.evaluation(*beside.method);
    std::string name(project::row_of(project::grid_methods(), *beside.method).label);
    return path ? std::optional(PathBeside{std::move(path), std::move(name)}) : std::nullopt;
}

std::optional<NamedScene> scene_beside(const Workbench& now, viewport::Scene& shown) {
    const Beside& beside = now.session.beside;
    if (beside.design && now.session.workspace == actions::Workspace::toolpath && shown.shown) {
        return designed_beside(shown);
    }
    const auto path = path_beside(now);
    if (!path || !shown.shown) {
        return std::nullopt;
    }
    NamedScene other{shown, path->name};
    other.scene.now.reset();
    other.scene.shown = path->path;
    if (beside.kept) {
        const auto& kept = now.session.kept;
        other.name = kept->name + "\n" + kept->place;
        other.scene.surface = kept->surface;
        other.scene.workpiece = kept->workpiece;
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

std::string shown_name_beside(const Workbench& now) {
    return now.session.beside.kept
               ? now.shown_name() + " on " + now.project.machine.file + "\n" + now.part_place()
               : now.shown_name();
}

} // namespace millwright::panels
