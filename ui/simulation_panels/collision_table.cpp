#include "ui/simulation_panels/collision_table.h"

#include "core/base/text.h"
#include "core/motion/trajectory.h"
#include "core/plan/stock_simulation.h"
#include "ui/panels/numbers_text.h"
#include "ui/panels/table_height.h"
#include "ui/widgets/table.h"
#include "ui/workspaces/stock_workspace.h"

#include <fmt/format.h>

#include <array>
#include <string>

namespace millwright::panels {

namespace {

using plan::StockEvent;
using plan::StockEventKind;

constexpr std::array<widgets::Column, 6> collision_columns{{{"Line", "", 0.7F, true},
                                                            {"Time", "s", 0.9F, true},
                                                            {"What", "", 1.6F, false},
                                                            {"Bodies", "", 2.4F, false},
                                                            {"Depth", "", 1.1F, true},
                                                            {"Moves", "", 0.8F, true}}};

std::string what_text(StockEventKind kind) {
    switch (kind) {
    case StockEventKind::collision:
        return "Collision";
    case StockEventKind::rapid_in_stock:
        return "Rapid in material";
    case StockEventKind::spindle_off:
        return "Spindle is off";
    case StockEventKind::axis_limit:
        return "Axis limit";
    case StockEventKind::near_miss:
        return "Near miss";
    }
    return {};
}

std::string collision_cell(const StockEvent& event, const motion::Trajectory& trajectory, int column) {
    switch (column) {
    case 0:
        return fmt::format("{}", event.line);
    case 1:
        return fixed(trajectory.time_at(event.block, event.fraction), 2);
    case 2:
        return what_text(event.kind);
    case 3:
        return event.bodies;
    case 4:
        return event.kind == StockEventKind::spindle_off ? std::string("-")
               : event.angle                             ? angle_text(event.depth) + " deg"
                                                         : length_text(event.depth) + " mm";
    default:
        return fmt::format("{}", event.moves);
    }
}

} // namespace

void collision_table(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto result = now.stock.view().result;
    const auto trajectory = now.trajectory();
    if (!result || !trajectory || !actions::stock_is_current(now)) {
        ui.note(result ? "The program has changed since the last simulation."
                       : "No simulation yet. Use Simulation > Simulate in the inspector.");
        return;
    }
    for (const std::string& sentence : result->unchecked) {
        ui.note("Not checked: " + sentence);
    }
    widgets::TableView view;
    view.columns = collision_columns;
    view.rows = std::ssize(result->events);
    const auto event = [&](std::ptrdiff_t row) -> const StockEvent& {
        return result->events[static_cast<std::size_t>(row)];
    };
    view.cell = [&](std::ptrdiff_t row, int column) {
        return collision_cell(event(row), *trajectory, column);
    };
    view.row_id = [](std::ptrdiff_t row) { return fmt::format("event_{}", row); };
    view.is_muted = [&](std::ptrdiff_t row, int) { return event(row).kind == StockEventKind::near_miss; };
    view.when_empty = "No collisions, no near misses.";
    view.height = table_height(ui, view.rows);
    if (const auto row = widgets::table(ui, "collisions", view); row && !now.follows_job()) {
        const double time = trajectory->time_at(event(*row).block, event(*row).fraction);
        ask.show([time](actions::ViewState& view_state) {
            view_state.playback.playing = false;
            view_state.playback.time = time;
            view_state.file.step.reset(); // the motion says where one is
        });
    }
}

} // namespace millwright::panels
