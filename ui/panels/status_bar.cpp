#include "ui/panels/status_bar.h"

#include "core/base/text.h"

#include <fmt/format.h>

#include <string>

namespace millwright::panels {

namespace {

std::string machine_state(const Workbench& now) {
    if (now.job.running && now.job.report) {
        return fmt::format("virtual machine {}", machine::to_text(now.job.report->driver.state));
    }
    return "virtual machine idle";
}

std::string mouse_text(const std::optional<Vec3>& p) {
    return p ? fmt::format("x {}  y {}  z {} mm", fixed(p->x(), 2), fixed(p->y(), 2), fixed(p->z(), 2))
             : std::string("mm, deg, mm/min");
}

} // namespace

void status_bar(Ui& ui, const Workbench& now, ActionQueue& ask, const std::optional<Vec3>& under_mouse) {
    if (now.activity.busy) {
        if (ui.progress("work", now.activity.text, now.activity.fraction)) {
            ask.run("work.cancel");
        }
        return;
    }
    const std::string file =
        now.document.file.empty() ? now.project.name : now.document.file.filename().string();
    ui.note(fmt::format("{}     {}     {}     {}{}",
                        now.failure().empty() ? "Ready" : "No program: see the outline",
                        machine_state(now),
                        mouse_text(under_mouse),
                        file,
                        now.changed() ? " (changed)" : ""));
}

} // namespace millwright::panels
