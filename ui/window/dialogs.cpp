#include "ui/window/dialogs.h"

#include "core/jobs/recovery.h"
#include "ui/panels/fields.h"
#include "ui/panels/numbers_text.h"
#include "ui/widgets/notices.h"
#include "ui/window/color_dialog.h"
#include "ui/workspaces/at_rest.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::panels {

namespace {

using widgets::Rank;

constexpr float dialog_width = 500.0F;
constexpr float wide = 600.0F; ///< three buttons, one with a long label

std::string where(const std::filesystem::path& file) {
    return file.empty() ? "never saved" : file.string();
}

/// The end of a long path, which tells more than its beginning.
std::string shortened_path(const std::string& path) {
    constexpr std::size_t most = 52;
    std::size_t from = path.size() - std::min(path.size(), most);
    while (from < path.size() && (static_cast<unsigned char>(path[from]) & 0xC0U) == 0x80U) {
        ++from; // the middle of a letter in UTF-8
    }
    return from == 0 ? path : "\u2026" + path.substr(from);
}

} // namespace

void Dialogs::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    const auto scope = ui.scope("dialogs");
    const bool file = now.view_state.file_prompt != actions::FilePrompt::none;
    if (!file) {
        files_.close();
    }
    if (!now.view_state.start) {
        start_.close();
    }
    if (now.view_state.dialogs.quit) { // over everything: something moves
        draw_running_job(ui, now, ask);
    } else if (now.view_state.replacing) {
        draw_replacing(ui, now, ask);
    } else if (now.view_state.dialogs.gouges) {
        draw_gouges(ui, now, ask);
    } else if (file) {
        files_.draw(ui, now, ask);
    } else if (!now.leaving_to.empty()) {
        draw_unsaved(ui, now, ask);
    } else if (now.view_state.start) {
        start_.draw(ui, now, ask);
    } else if (!now.left_behind.empty()) {
        draw_left_behind(ui, now, ask);
    } else if (!now.broken_jobs->empty()) {
        draw_broken_job(ui, now, ask);
    } else if (now.view_state.help != actions::HelpPage::none) {
        help_.draw(ui, now, ask);
    } else if (now.view_state.dialogs.colors) {
        color_dialog(ui, now, ask);
    }
}

void Dialogs::draw_replacing(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const actions::Replacing& asked = *now.view_state.replacing;
    const bool project = asked.what == actions::ReplacedFile::project;
    const auto dialog = ui.dialog("replace",
                                  project ? "File changed on disk" : "Replace the file?",
                                  ui.px(project ? wide : dialog_width));
    if (!dialog) {
        return;
    }
    ui.text(project ? "Another program or another Millwright window has changed this file since it was "
                      "opened or saved here."
                    : "This file has changed since Millwright last wrote it.");
    ui.gap();
    ui.note(shortened_path(asked.file.string()));
    ui.gap();
    const auto row = ui.row(project ? 4 : 3);
    action_button(ui, now, ask, catalogue_, "replace.cancel");
    if (project) {
        action_button(ui, now, ask, catalogue_, "replace.reload");
    }
    action_button(ui, now, ask, catalogue_, "replace.elsewhere", Rank::primary);
    action_button(ui, now, ask, catalogue_, "replace.overwrite", Rank::danger);
    if (ui.escape_pressed()) {
        ask.run("replace.cancel");
    }
}

void Dialogs::draw_gouges(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto dialog = ui.dialog("gouges", "Write a program that gouges the part?", ui.px(wide));
    if (!dialog) {
        return;
    }
    const std::string warning = now.gouge_warning();
    ui.text(warning.empty() ? "The program no longer gouges the part." : warning);
    ui.note("Use a smaller or different cutter, more nodes per track, or another part position.");
    ui.gap();
    const auto row = ui.row(3);
    action_button(ui, now, ask, catalogue_, "gouges.write", Rank::danger);
    action_button(ui, now, ask, catalogue_, "gouges.show");
    action_button(ui, now, ask, catalogue_, "gouges.cancel", Rank::primary);
    if (ui.escape_pressed()) {
        ask.run("gouges.cancel");
    }
}

void Dialogs::draw_unsaved(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto dialog = ui.dialog("unsaved", "Save the changes?", ui.px(dialog_width));
    if (!dialog) {
        return;
    }
    ui.text(fmt::format("{} has unsaved changes. Save them before you {}?",
                        now.document.file.empty() ? "\u201c" + now.project.name + "\u201d"
                                                  : now.document.file.filename().string(),
                        now.leaving_to));
    ui.gap();
    const auto row = ui.row(3);
    action_button(ui, now, ask, catalogue_, "unsaved.cancel");
    action_button(ui, now, ask, catalogue_, "unsaved.discard");
    action_button(ui, now, ask, catalogue_, "unsaved.save", Rank::primary);
    if (ui.escape_pressed()) {
        ask.run("unsaved.cancel");
    }
}

void Dialogs::draw_running_job(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const bool job = now.job.running;
    const bool moves = actions::arm_moves(now.connection);
    const auto dialog = ui.dialog("running_job",
                                  job     ? "Stop the job?"
                                  : moves ? "Stop the arm?"
                                          : "Disable the motors and quit?",
                                  ui.px(dialog_width));
    if (!dialog) {
        return;
    }
    if (job) {
        ui.text(fmt::format(
            "\u201c{}\u201d is running. Closing Millwright stops the job: the machine brakes to a stop.",
            now.job.name));
    } else {
        ui.text(moves ? "The arm is moving. Closing Millwright stops it: the arm brakes to a stop, then its "
                        "motors are disabled."
                      : "The motors of the arm are enabled. Closing Millwright disables them, because they "
                        "would no longer be supervised.");
        ui.note("An arm without brakes may then drop: keep the area below it clear.");
    }
    ui.gap();
    const auto row = ui.row(2);
    action_button(ui,
                  now,
                  ask,
                  catalogue_,
                  "running_job.stop",
                  Rank::normal,
                  job || moves ? "" : "Disable motors and quit");
    action_button(ui, now, ask, catalogue_, "running_job.stay", Rank::primary);
    if (ui.escape_pressed()) {
        ask.run("running_job.stay");
    }
}

void Dialogs::draw_left_behind(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto dialog = ui.dialog("recovery", "Unsaved work found", ui.px(dialog_width));
    if (!dialog) {
        return;
    }
    const project::LeftBehind& left = now.left_behind.front();
    if (left.work()) {
        ui.text("Millwright was not closed properly. Unsaved work was found:");
        ui.gap();
        const auto labels = ui.label_share(0.2F);
        ui.value("project", "Project", left.work()->project.name);
        ui.value("file", "File", where(left.work()->file));
        ui.value("time", "Saved copy", date_time_text(left.work()->time_s));
    } else {
        ui.text("Millwright was not closed properly. The recovery copy cannot be read:");
        ui.gap();
        (void)widgets::banner(
            ui, "fault", {widgets::Severity::warning, left.fault()->message, left.copy().string()});
    }
    if (now.left_behind.size() > 1) {
        ui.note(fmt::format("{} more after this one.", now.left_behind.size() - 1));
    }
    ui.gap();
    const auto row = ui.row(3);
    action_button(ui, now, ask, catalogue_, "recovery.later");
    action_button(ui, now, ask, catalogue_, "recovery.discard");
    action_button(ui, now, ask, catalogue_, "recovery.recover", Rank::primary);
}

void Dialogs::draw_broken_job(Ui& ui, const FrameState& now, ActionQueue& ask) const {
    const auto dialog = ui.dialog("broken_job", "A job was interrupted", ui.px(wide));
    if (!dialog) {
        return;
    }
    const jobs::JobStory& story = now.broken_jobs->front();
    ui.text(story.sentence);
    ui.gap();
    {
        const auto labels = ui.label_share(0.2F);
        ui.value("program", "Program", shortened_path(story.start.project));
        const std::string at = story.start.address.empty() ? "" : " at " + story.start.address;
        ui.value("machine", "Machine", story.start.driver + at);
        if (!story.start.started_at.empty()) {
            ui.value("started", "Started", story.start.started_at);
        }
        ui.value("log", "Log", shortened_path(story.log_file.string()));
    }
    ui.gap();
    (void)widgets::banner(ui,
                          "look",
                          {widgets::Severity::warning,
                           "Inspect the machine and the part first: the controller may still be executing "
                           "blocks that it received. Millwright does not start any motion on its own.",
                           {}});
    if (now.broken_jobs->size() > 1) {
        ui.note(fmt::format("{} more after this one.", now.broken_jobs->size() - 1));
    }
    ui.gap();
    const auto row = ui.row(3);
    action_button(ui, now, ask, catalogue_, "broken_job.later");
    action_button(ui, now, ask, catalogue_, "broken_job.dismiss");
    action_button(ui,
                  now,
                  ask,
                  catalogue_,
                  "broken_job.continue",
                  Rank::primary,
                  jobs::why_not_from_line(story).empty() ? fmt::format("From line {} \u2026", story.next_line)
                                                         : std::string("From the start \u2026"));
}

} // namespace millwright::panels
