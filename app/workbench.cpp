#include "app/workbench.h"

#include "core/project/assets.h"
#include "core/project/recent_files.h"
#include "ui/panels/desktop.h"
#include "ui/render/window_context.h"

#include <chrono>

namespace millwright::app {

namespace {

std::string title_of(const actions::Workbench& now) {
    const std::string name =
        now.document.file.empty() ? now.project.name : now.document.file.filename().string();
    return name + (now.changed() ? " * - Millwright" : " - Millwright");
}

/// May the window close? Asks once where work would be lost.
bool may_close(actions::Workshop& workshop) {
    actions::Session& session = workshop.session();
    if (!workshop.look().changed() || session.discard_agreed) {
        return true;
    }
    session.discard_agreed = true;
    session.quit_wanted = false;
    actions::tell(session,
                  widgets::Severity::warning,
                  "There are unsaved changes. Save them (Ctrl+S), or close again to lose them.");
    return false;
}

void run(render::WindowContext& window, actions::Workshop& workshop) {
    panels::Desktop desktop(window, workshop);
    using Clock = std::chrono::steady_clock;
    Clock::time_point before = Clock::now();
    while (true) {
        const Clock::time_point now = Clock::now();
        (void)workshop.advance(std::chrono::duration<double>(now - before).count());
        before = now;
        desktop.frame();
        window.present();
        window.set_title(title_of(workshop.look()));
        if ((window.close_requested() || workshop.session().quit_wanted) && may_close(workshop)) {
            return;
        }
        window.keep_open();
        while (!window.wait(desktop.next_change().value_or(-1.0)) && !desktop.next_change()) {
        }
    }
}

} // namespace

void run_workbench(const std::optional<std::filesystem::path>& project) {
    render::WindowContext window({});
    actions::Workshop workshop({project::assets_folder(), "jobs", project::recent_files_place(), [&window] {
                                    window.request_redraw();
                                }});
    window.on_drop([&workshop](const std::vector<std::filesystem::path>& files) {
        actions::ActionQueue ask;
        ask.open_file(files.front());
        workshop.perform(ask);
    });
    if (project) {
        actions::ActionQueue ask;
        ask.open_file(*project);
        workshop.perform(ask);
    }
    run(window, workshop);
}

} // namespace millwright::app
