#include "app/workbench.h"

#include "app/command_line/watched_work.h"
#include "core/base/error.h"
#include "core/project/assets.h"
#include "core/project/recent_files.h"
#include "core/project/recovery.h"
#include "core/project/window_settings.h"
#include "ui/render/window_context.h"
#include "ui/window/desktop.h"
#include "ui/workspaces/kept_view_state.h"

#include <fmt/format.h>

#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <memory>
#include <stop_token>

namespace millwright::app {

namespace {

std::string title_of(const actions::FrameState& now) {
    const std::string project =
        now.document.file.empty() ? now.project.name : now.document.file.filename().string();
    const std::string name = now.opened ? now.opened->file.filename().string() + " - " + project : project;
    return name + (now.changed() ? " * - Millwright" : " - Millwright");
}

/// An event shows a frame or two late: what it asks for is carried out after drawing, and a menu is measured
/// before it is shown.
constexpr int frames_per_event = 3;

/// Blocks until a frame is to be drawn; counts down `due` frames after an event.
void wait_for_frame(render::WindowContext& window, const panels::Desktop& desktop, int& due) {
    --due;
    if (window.wait(due > 0 ? 0.0 : desktop.next_change().value_or(-1.0))) {
        due = frames_per_event;
    }
    while (due <= 0 && !desktop.next_change()) {
        due = window.wait(-1.0) ? frames_per_event : 0;
    }
}

/// Until the user closes the window, or the system asks for the end: then without a question, and what has
/// not been saved stays for the next start. Whatever moves is stopped with the app controller.
void run_window(render::WindowContext& window, actions::AppController& app, const std::stop_token& system) {
    panels::Desktop desktop(window, app);
    int due = frames_per_event;
    using Clock = std::chrono::steady_clock;
    Clock::time_point before = Clock::now();
    while (true) {
        const Clock::time_point now = Clock::now();
        (void)app.advance(std::chrono::duration<double>(now - before).count());
        before = now;
        desktop.frame();
        window.present();
        window.set_title(title_of(app.look()));
        app.view_state().window = window.place();
        if (window.close_requested()) {
            window.keep_open();
            app.run("file.quit");
        }
        if (system.stop_requested()) {
            throw Cancelled();
        }
        if (app.view_state().quit) {
            app.close();
            return;
        }
        wait_for_frame(window, desktop, due);
    }
}

/// What moves is stopped; motors that may have kept their power are reported on standard error.
void let_go(actions::AppController& app) {
    app.keep_window_settings();
    app.connection().disconnect();
    app.connection().wait_idle();
    if (const auto failure = app.connection().view().failure) {
        fmt::print(stderr, "millwright: {}\n", to_text(*failure));
    }
}

/// The window is gone without a word: whatever moves is stopped, as at the end that the system asks for, and
/// what has not been saved stays for the next start. Nothing that belongs to a display may be touched again.
[[noreturn]] void end_without_display(std::unique_ptr<actions::AppController>& app) {
    fmt::print(stderr, "millwright: the display connection is lost; all motion is stopped\n");
    app.reset();
    constexpr int display_lost = 1;
    std::_Exit(display_lost);
}

/// Of the window when it was last closed.
render::WindowPlace last_place() {
    actions::ViewState last;
    try {
        (void)actions::restore(
            last,
            project::read_window_settings(project::window_settings_place(project::recent_files_place())));
    } catch (const Error&) { // the app controller says it in the window
        return {};
    }
    return last.window;
}

} // namespace

void run_workbench(const std::optional<std::filesystem::path>& file) {
    const Interrupt interrupt; // before any thread
    render::WindowContext window({.place = last_place()});
    auto app = std::make_unique<actions::AppController>(
        actions::AppOptions{.assets = project::assets_folder(),
                            .log_folder = project::job_logs_place(),
                            .settings = project::recent_files_place(),
                            .recovery = project::recovery_place(),
                            .wake = [&window] { window.request_redraw(); }});
    window.on_display_lost([&app] { end_without_display(app); });
    window.on_drop([&app](const std::vector<std::filesystem::path>& files) { app->receive(files); });
    if (file) {
        app->receive({*file});
    }
    const std::stop_callback wake(interrupt.token(), [&window] { window.request_redraw(); });
    try {
        run_window(window, *app, interrupt.token());
    } catch (const Cancelled&) {
        let_go(*app);
        throw;
    }
}

} // namespace millwright::app
