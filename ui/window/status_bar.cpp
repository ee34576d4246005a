#include "ui/window/status_bar.h"

#include "core/base/text.h"
#include "ui/machine_panels/connection_panel.h"
#include "ui/plot_panels/table_pane.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>

namespace millwright::panels {

namespace {

std::string machine_state(const FrameState& now) {
    if (const std::string table = table_text(now); !table.empty()) {
        return now.connection.link == actions::LinkState::none ? table : table + ", " + controller_text(now);
    }
    if (now.connection.link == actions::LinkState::none && now.job.running && now.job.report) {
        return fmt::format("virtual machine {}", to_text(now.job.report->driver.state));
    }
    return controller_text(now);
}

std::string mouse_text(const std::optional<Vec3>& p) {
    return p ? fmt::format("x {}  y {}  z {} mm", fixed(p->x(), 2), fixed(p->y(), 2), fixed(p->z(), 2))
             : std::string("mm, deg, mm/min");
}

/// Of the file that is looked at.
std::string program_name(const FrameState& now) {
    if (now.view_state.workspace == actions::Workspace::plot && !now.plot.file().empty()) {
        return ", " + now.plot.file().filename().string();
    }
    return now.opened_file ? ", " + now.opened_file->file.filename().string() : "";
}

} // namespace

void status_bar(Ui& ui, const FrameState& now, ActionQueue& ask, const std::optional<Vec3>& under_mouse) {
    constexpr float left = 12.0F;
    constexpr float top = 5.0F;
    constexpr float least_work = 380.0F;
    constexpr float between = 18.0F;
    const float gap = ui.px(between + widgets::gaps::small);
    const std::string machine = machine_state(now), mouse = mouse_text(under_mouse);
    std::string file = now.document.file.empty() ? now.project.name : now.document.file.filename().string();
    file += now.changed() ? " (not saved)" : "";
    file += program_name(now);
    ui.move_by(ui.px(left), ui.px(top));
    if (now.activity.busy) {
        const float others =
            ui.words_width(machine) + ui.words_width(mouse) + ui.words_width(file) + 3.0F * gap;
        const auto width = ui.width(std::max(ui.px(least_work), ui.rest().w - others - ui.px(left)));
        const bool stopping = now.activity.stopping;
        if (ui.progress("work",
                        (stopping ? "Cancelling: " : "") + now.activity.text,
                        now.activity.fraction,
                        stopping ? widgets::Permission::refused("The work stops after the current step.")
                                 : widgets::Permission{})) {
            ask.run("work.cancel");
        }
    } else {
        ui.words(now.failure().empty() ? "Ready"
                 : now.program()       ? "A comparison grid failed: see the outline"
                                       : "No program: see the outline",
                 widgets::Tone::muted);
    }
    for (const std::string& text : {machine, mouse}) {
        ui.beside();
        ui.move_by(ui.px(between), 0.0F);
        ui.words(text, widgets::Tone::muted);
    }
    ui.beside();
    ui.move_by(ui.px(between), 0.0F);
    ui.words(file, widgets::Tone::muted, std::max(ui.rest().w - ui.px(left), 1.0F));
}

} // namespace millwright::panels
