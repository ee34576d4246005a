#include "ui/design_panels/patch_fields.h"

#include "core/project/reshaped_surface.h"

#include <fmt/format.h>

#include <array>
#include <string>

namespace millwright::panels {

namespace {

using geometry::Parameter;

/// The points that are selected are not those of the new net.
void reshape(ActionQueue& ask, std::string title, std::function<void(project::Project&)> change) {
    ask.show([](actions::ViewState& view_state) { view_state.selected.clear(); });
    ask.edit(std::move(title), std::move(change));
}

void degree_fields(Ui& ui, ActionQueue& ask, const geometry::ControlNet& net, int patch) {
    const std::array<int, 2> degrees{net.rows - 1, net.columns - 1};
    const std::array<const char*, 2> ids{"degree_u", "degree_v"}, labels{"Degree u", "Degree v"};
    for (std::size_t n = 0; n < 2; ++n) {
        const widgets::FieldInfo info{ids[n],
                                      labels[n],
                                      "",
                                      "Raise the degree: more control points, same shape",
                                      static_cast<double>(degrees[n]),
                                      static_cast<double>(geometry::max_degree),
                                      std::numeric_limits<double>::quiet_NaN(),
                                      0};
        if (const auto wanted = ui.integer(degrees[n], info)) {
            const int u = n == 0 ? *wanted : degrees[0];
            const int v = n == 1 ? *wanted : degrees[1];
            reshape(ask, "Elevate the degree", [patch, u, v](project::Project& draft) {
                draft.surface = project::with_degrees(draft.surface, patch, u, v);
            });
        }
    }
}

} // namespace

int edited_patch(const FrameState& now) {
    return now.view_state.selected.empty() ? now.project.surface.machined_patch
                                           : static_cast<int>(now.view_state.selected.front().patch);
}

void PatchFields::draw_split(Ui& ui, ActionQueue& ask, int patch) {
    const widgets::FieldInfo info{
        "at",
        "Split parameter",
        "",
        "Parameter (0..1) of the line at which the patch is split in two; the shape does not change",
        project::narrowest_split,
        1.0 - project::narrowest_split,
        0.5,
        3};
    if (const auto at = ui.number(split_at_, info)) {
        split_at_ = *at;
    }
    const auto row = ui.row(2);
    const auto button = [&](const char* id, const char* name, Parameter parameter) {
        const std::string tip =
            fmt::format("Split into two patches that meet at {} = {:.4g}", name, split_at_);
        if (ui.button(id, fmt::format("Split in {}", name), {}, {{}, widgets::Rank::normal, -1.0F, tip})) {
            reshape(ask, "Split the patch", [patch, parameter, at = split_at_](project::Project& draft) {
                draft = project::with_split(std::move(draft), patch, parameter, at);
            });
        }
    };
    button("split_u", "u", Parameter::u);
    button("split_v", "v", Parameter::v);
}

void PatchFields::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto section = ui.section("patch", "Patch");
    if (!section) {
        return;
    }
    const auto& patches = now.project.surface.patches;
    const int patch = edited_patch(now);
    if (patches.size() > 1) {
        ui.value("which", "Patch", fmt::format("{} of {}, numbered from 0", patch, patches.size()));
    }
    degree_fields(ui, ask, patches[static_cast<std::size_t>(patch)], patch);
    draw_split(ui, ask, patch);
}

} // namespace millwright::panels
