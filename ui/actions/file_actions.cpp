#include "ui/actions/app_controller.h"
#include "ui/actions/internal/simple_action.h"
#include "ui/workspaces/at_rest.h"

namespace millwright::actions {

namespace icons = widgets::icons;

namespace {

using widgets::Permission;

void ask_for(ActionContext& context, FilePrompt prompt) {
    context.view_state.file_prompt = prompt;
}

void save(ActionContext& context) {
    if (context.document.file.empty()) {
        ask_for(context, FilePrompt::save_as);
        return;
    }
    context.app.save(std::filesystem::path(context.document.file));
}

Permission has_listing(const FrameState& now) {
    if (!now.listing()) {
        return Permission::refused("There is no program yet.");
    }
    return now.program_is_final() ? Permission{}
                                  : Permission::refused("The program is still being computed.");
}

Permission can_change_file(const FrameState& now) {
    if (!now.opened_file) {
        return Permission::refused("No G-code file is open.");
    }
    return now.job.running ? Permission::refused("A job is running.") : Permission{};
}

void add_project_files(Actions& actions) {
    add(actions,
        {"file.new",
         "File",
         "New project",
         "Starts with the dome from the literature.",
         "Ctrl+N",
         icons::file},
        always,
        [](ActionContext& context) {
            context.app.leave("start a new project", [](AppController& app) { app.new_from_preset("dome"); });
        });
    add(actions,
        {"file.open",
         "File",
         "Open ...",
         "Opens a project, or opens a G-code file, plot, picture or imported surface next to the present "
         "project.",
         "Ctrl+O",
         icons::folder},
        always,
        [](ActionContext& context) { ask_for(context, FilePrompt::open); });
    add(actions,
        {"file.save",
         "File",
         "Save",
         "Saves the project; if that fails, the old file is kept.",
         "Ctrl+S",
         icons::save},
        always,
        save);
    add(actions,
        {"file.save_as", "File", "Save as ...", "Saves the project to another file.", "Ctrl+Shift+S", ""},
        always,
        [](ActionContext& context) { ask_for(context, FilePrompt::save_as); });
}

void add_program_files(Actions& actions) {
    add(actions,
        {"file.write_program",
         "File",
         "Write G-code",
         "Asks for a file the first time, then writes to the same file.",
         "Ctrl+E",
         ""},
        has_listing,
        [](ActionContext& context) { context.app.write_program(); });
    add(actions,
        {"file.read_again",
         "File",
         "Reload the G-code file",
         "Reads a file again that another program has changed.",
         "",
         icons::redo},
        can_change_file,
        [](ActionContext& context) { context.app.read_again(); });
    add(actions,
        {"file.close_program",
         "File",
         "Close the G-code file",
         "The Program workspace shows the project's own program again.",
         "Ctrl+W",
         ""},
        can_change_file,
        [](ActionContext& context) { context.app.close_file(); });
}

} // namespace

void add_file_actions(Actions& actions) {
    add_project_files(actions);
    add_program_files(actions);
}

void add_quit_action(Actions& actions) {
    add(actions,
        {"file.quit",
         "File",
         "Quit",
         "Closes Millwright; asks first if a job is running or the motors of an arm have power.",
         "Ctrl+Q",
         ""},
        always,
        [](ActionContext& context) {
            if (context.now.job.running || arm_under_power(context.now.connection)) {
                context.view_state.dialogs.quit = true;
            } else {
                context.app.quit();
            }
        });
}

} // namespace millwright::actions
