#include "ui/toolpath_panels/program_panel.h"

#include "core/base/text.h"
#include "core/base/units.h"
#include "ui/panels/axis_positions.h"
#include "ui/panels/fields.h"
#include "ui/panels/numbers_text.h"
#include "ui/simulation_panels/simulation_fields.h"
#include "ui/workspaces/shown_grid.h"

#include <fmt/format.h>

namespace millwright::panels {

void ProgramPanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    if (now.in_file()) {
        return file_.draw(ui, now, ask);
    }
    draw_settings(ui, now, ask);
    draw_summary(ui, now, ask);
    simulation_fields(ui, now, ask, catalogue_);
    draw_block(ui, now);
    if (const auto section = ui.section("position", "Axis positions at this block")) {
        axis_positions(ui, now);
    }
}

void ProgramPanel::draw_settings(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto section = ui.section("settings", "Feeds and clearances");
    if (!section) {
        return;
    }
    number_fields<project::ProgramInput>(
        ui,
        ask,
        project::program_numbers(),
        now.project.program,
        [](project::Project& p) -> project::ProgramInput& { return p.program; });
    choice_field<project::LinkInput>(ui,
                                     ask,
                                     "link",
                                     "Track linking",
                                     "Change the track links",
                                     project::links(),
                                     now.project.program.link,
                                     [](project::Project& p, project::LinkInput l) { p.program.link = l; });
}

void ProgramPanel::draw_summary(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto section = ui.section("summary", "Program");
    if (!section) {
        return;
    }
    const auto program = now.program();
    const auto trajectory = now.trajectory();
    if (!program || !trajectory) {
        ui.note(now.failure().empty() ? "Computing \u2026" : now.failure());
        return;
    }
    ui.value("machine", "Machine", program->machine);
    const auto path = now.program_path();
    const std::string mark = path && actions::is_so_far(*path) ? "~ " : "";
    ui.value("blocks", "Blocks", fmt::format("{}{}", mark, program->block_count()));
    ui.value("time", "Estimated time", mark + clock_time(trajectory->duration()));
    ui.value("length", "Tool-tip travel", mark + fixed(trajectory->part_length(), 1), "mm");
    action_button(ui, now, ask, catalogue_, "file.write_program");
}

void ProgramPanel::draw_block(Ui& ui, const FrameState& now) const {
    const auto section = ui.section("block", "Current block");
    const auto program = now.program();
    const auto trajectory = now.trajectory();
    if (!section || !program || !trajectory || program->blocks.empty()) {
        return;
    }
    const int n = now.block();
    const program::Block& block = program->blocks[static_cast<std::size_t>(n)];
    if (const auto listing = now.listing()) {
        ui.value("line", "Line", fmt::format("{}", listing->line_of_block[static_cast<std::size_t>(n)]));
    }
    ui.value("limit", "Limited by", limit_text(trajectory->limit_of(n), *program));
    if (block.kind == program::BlockKind::feed) {
        ui.value("feed", "Feed rate", fixed(to_mm_per_min(block.feed), 0), "mm/min");
    }
    const auto shown = now.program_path();
    const auto move = static_cast<std::size_t>(block.path_point - 1);
    if (shown && block.path_point > 0 && move < shown->field.moves.size()) {
        ui.value("error", "Move error", length_text(shown->field.moves[move].closest), "mm");
        ui.value("axis", "Axis deviation", angle_text(shown->field.moves[move].axis), "deg");
    }
}

} // namespace millwright::panels
