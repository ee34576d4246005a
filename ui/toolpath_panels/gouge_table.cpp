#include "ui/toolpath_panels/gouge_table.h"

#include "core/base/text.h"
#include "core/plan/cut_remarks.h"
#include "core/plan/cut_study.h"
#include "ui/panels/numbers_text.h"
#include "ui/panels/table_height.h"
#include "ui/widgets/table.h"

#include <fmt/format.h>

#include <array>

namespace millwright::panels {

namespace {

using plan::BlockBite;

constexpr std::array<widgets::Column, 6> gouge_columns{{{"Line", "", 0.8F, true},
                                                        {"Body", "", 1.0F, false},
                                                        {"Depth", "mm", 1.0F, true},
                                                        {"x", "mm", 1.0F, true},
                                                        {"y", "mm", 1.0F, true},
                                                        {"z", "mm", 1.0F, true}}};

std::string gouge_cell(const BlockBite& bite, int column) {
    switch (column) {
    case 0:
        return fmt::format("{}", bite.line);
    case 1:
        return bite.by_holder ? "holder" : "cutter";
    case 2:
        return length_text(bite.bite.depth);
    default:
        return fixed(bite.bite.position[column - 3], 3);
    }
}

} // namespace

void gouge_table(Ui& ui, const FrameState& now, ActionQueue& ask) {
    if (now.project.tool.cutter == toolpath::CutterKind::point) {
        ui.note("The tool is a point and cannot gouge. Select a cutter in Toolpath > Tool.");
        return;
    }
    const auto cut = now.plan ? now.plan->plan.cut : nullptr;
    if (!cut) {
        ui.note(now.failure().empty() ? "Computing \u2026" : now.failure());
        return;
    }
    widgets::TableView view;
    view.columns = gouge_columns;
    view.rows = std::ssize(cut->bites);
    view.cell = [&](std::ptrdiff_t row, int column) {
        return gouge_cell(cut->bites[static_cast<std::size_t>(row)], column);
    };
    view.row_id = [&](std::ptrdiff_t row) {
        const BlockBite& bite = cut->bites[static_cast<std::size_t>(row)];
        return fmt::format("{}_{}", bite.by_holder ? "holder" : "cutter", bite.block);
    };
    const std::string nothing =
        "No gouges above the limit and no holder collisions: " + plan::checked_text(now.plan->project) + ".";
    view.when_empty = nothing;
    const auto trajectory = now.trajectory();
    view.height = table_height(ui, view.rows);
    if (const auto row = widgets::table(ui, "gouges", view); row && trajectory && !now.follows_job()) {
        const int block = cut->bites[static_cast<std::size_t>(*row)].block;
        ask.show([time = trajectory->start_of(block)](actions::ViewState& view_state) {
            view_state.playback.playing = false;
            view_state.playback.time = time;
        });
    }
}

} // namespace millwright::panels
