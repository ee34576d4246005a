#include "core/project/gcode_file.h"
#include "ui/actions/app_controller.h"
#include "ui/actions/internal/simple_action.h"
#include "ui/workspaces/at_rest.h"

namespace millwright::actions {

namespace {

using widgets::Permission;

Permission is_leaving(const FrameState& now) {
    return now.leaving_to.empty() ? Permission::refused("No command is waiting for unsaved changes.")
                                  : Permission{};
}

Permission has_left_behind(const FrameState& now) {
    return now.left_behind.empty() ? Permission::refused("There is no unsaved work to recover.")
                                   : Permission{};
}

Permission can_recover(const FrameState& now) {
    if (const Permission found = has_left_behind(now); !found.allowed) {
        return found;
    }
    return now.left_behind.front().work() ? Permission{} : Permission::refused("The copy cannot be read.");
}

Permission is_replacing(const FrameState& now) {
    return now.view_state.replacing ? Permission{} : Permission::refused("No file would be replaced.");
}

Permission is_gouging(const FrameState& now) {
    return now.view_state.dialogs.gouges ? Permission{} : Permission::refused("No program would be written.");
}

Permission can_reload(const FrameState& now) {
    const auto& asked = now.view_state.replacing;
    return asked && asked->what == ReplacedFile::project
               ? Permission{}
               : Permission::refused("No project was changed on disk.");
}

Permission is_quitting(const FrameState& now) {
    return now.view_state.dialogs.quit
               ? Permission{}
               : Permission::refused("Neither a job nor an arm keeps Millwright open.");
}

Permission has_broken_job(const FrameState& now) {
    return now.broken_jobs->empty() ? Permission::refused("No job was interrupted.") : Permission{};
}

Permission can_continue(const FrameState& now) {
    if (const Permission found = has_broken_job(now); !found.allowed) {
        return found;
    }
    const jobs::JobStory& story = now.broken_jobs->front();
    if (story.executed_blocks >= story.start.blocks) {
        return Permission::refused("All of its blocks were executed.");
    }
    const std::filesystem::path file(story.start.project);
    if (story.start.driver == "points" && !project::is_plot_file(file) && !project::is_gcode_file(file)) {
        return Permission::refused("Replay a point file with the command plot play.");
    }
    std::error_code none;
    return std::filesystem::is_regular_file(file, none)
               ? Permission{}
               : Permission::refused("Its program file no longer exists.");
}

void add_file_answers(Actions& actions) {
    add(actions,
        {"unsaved.save", dialog_menu, "Save", "Saves the changes and continues.", "", ""},
        is_leaving,
        [](ActionContext& context) { context.app.save_and_leave(); });
    add(actions,
        {"unsaved.discard", dialog_menu, "Discard", "Continues without saving the changes.", "", ""},
        is_leaving,
        [](ActionContext& context) { context.app.discard_and_leave(); });
    add(actions,
        {"unsaved.cancel", dialog_menu, "Cancel", "Nothing changes.", "", ""},
        is_leaving,
        [](ActionContext& context) { context.app.stay(); });
    add(actions,
        {"replace.overwrite", dialog_menu, "Replace", "The present content of the file is lost.", "", ""},
        is_replacing,
        [](ActionContext& context) { context.app.replace(); });
    add(actions,
        {"replace.elsewhere", dialog_menu, "Save as ...", "Asks for another file.", "", ""},
        is_replacing,
        [](ActionContext& context) { context.app.write_elsewhere(); });
    add(actions,
        {"replace.reload",
         dialog_menu,
         "Reload",
         "Loads the file from disk; Undo restores the present project.",
         "",
         ""},
        can_reload,
        [](ActionContext& context) { context.app.reload(); });
    add(actions,
        {"replace.cancel", dialog_menu, "Cancel", "Nothing changes.", "", ""},
        is_replacing,
        [](ActionContext& context) { context.app.keep_file(); });
}

void add_gouge_answers(Actions& actions) {
    add(actions,
        {"gouges.write",
         dialog_menu,
         "Write anyway",
         "Writes the program although it gouges the part.",
         "",
         ""},
        is_gouging,
        [](ActionContext& context) { context.app.write_gouging_program(); });
    add(actions,
        {"gouges.cancel", dialog_menu, "Cancel", "No program is written.", "", ""},
        is_gouging,
        [](ActionContext& context) { context.view_state.dialogs.gouges = false; });
    add(actions,
        {"gouges.show",
         dialog_menu,
         "Show the gouges",
         "Lists the gouging blocks below the view; no program is written.",
         "",
         ""},
        is_gouging,
        [](ActionContext& context) {
            context.view_state.dialogs.gouges = false;
            context.view_state.workspace = Workspace::toolpath;
            context.view_state.panes.lower_shown = true;
            context.view_state.lower_tab_now() = LowerTab::gouges;
        });
    add(actions,
        {"running_job.stay", dialog_menu, "Stay open", "Everything continues.", "", ""},
        is_quitting,
        [](ActionContext& context) { context.view_state.dialogs.quit = false; });
    add(actions,
        {"running_job.stop",
         dialog_menu,
         "Stop and quit",
         "The machine brakes, the job log records what was executed, and the motors of an arm are disabled.",
         "",
         ""},
        is_quitting,
        [](ActionContext& context) {
            context.view_state.dialogs.quit = false;
            context.jobs.stop();
            if (arm_moves(context.now.connection)) {
                context.app.connection().tell([](drivers::Driver& driver) { driver.stop(); });
            }
            context.app.quit();
        });
}

void add_recovery_answers(Actions& actions) {
    add(actions,
        {"recovery.recover",
         dialog_menu,
         "Recover",
         "Restores the unsaved work; it still has to be saved.",
         "",
         ""},
        can_recover,
        [](ActionContext& context) { context.app.recover(); });
    add(actions,
        {"recovery.discard", dialog_menu, "Discard", "Deletes the copy permanently.", "", ""},
        has_left_behind,
        [](ActionContext& context) { context.app.discard_left_behind(); });
    add(actions,
        {"recovery.later", dialog_menu, "Later", "Asks again at the next start.", "", ""},
        has_left_behind,
        [](ActionContext& context) { context.app.leave_left_behind(); });
    add(actions,
        {"broken_job.continue",
         dialog_menu,
         "Run from line",
         "Opens the program and shows the approach to the first unconfirmed line, if the job can start "
         "there. Nothing moves yet.",
         "",
         ""},
        can_continue,
        [](ActionContext& context) { context.app.continue_broken_job(); });
    add(actions,
        {"broken_job.dismiss", dialog_menu, "Dismiss", "Does not ask again; the log is kept.", "", ""},
        has_broken_job,
        [](ActionContext& context) { context.app.job_recovery().dismiss(); });
    add(actions,
        {"broken_job.later", dialog_menu, "Later", "Asks again at the next start.", "", ""},
        has_broken_job,
        [](ActionContext& context) { context.app.job_recovery().later(); });
}

} // namespace

void add_dialog_actions(Actions& actions) {
    add_file_answers(actions);
    add_gouge_answers(actions);
    add_recovery_answers(actions);
}

} // namespace millwright::actions
