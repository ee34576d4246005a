// The part of AppController that deals with whole files: opening, closing, recovering.
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/sentences.h"
#include "core/base/text.h"
#include "core/jobs/job.h"
#include "core/jobs/recovery.h"
#include "core/plan/strategy_path.h"
#include "core/project/color_choices.h"
#include "core/project/gcode_file.h"
#include "core/project/imported_surface.h"
#include "core/project/project_file.h"
#include "ui/actions/app_controller.h"
#include "ui/workspaces/at_rest.h"
#include "ui/workspaces/kept_view_state.h"
#include "ui/workspaces/pending_import.h"
#include "ui/workspaces/processor_texts.h"
#include "ui/workspaces/shown_grid.h"
#include "ui/workspaces/stock_workspace.h"
#include "ui/workspaces/surface_export.h"

#include <fmt/format.h>

#include <algorithm>
#include <fstream>
#include <system_error>
#include <utility>

namespace millwright::actions {

namespace {

namespace fs = std::filesystem;

std::int64_t seconds_since_1970() {
    const auto now = std::chrono::system_clock::now().time_since_epoch();
    return std::chrono::duration_cast<std::chrono::seconds>(now).count();
}

bool is_project_file(const fs::path& file) {
    return file.extension() == ".json";
}

/// Of what is read as G-code.
void expect_text(const fs::path& file) {
    constexpr std::size_t beginning = 4096;
    std::string begin(beginning, ' ');
    std::ifstream stream(file, std::ios::binary);
    stream.read(begin.data(), static_cast<std::streamsize>(begin.size()));
    if (begin.find('\0') != std::string::npos) {
        throw Error(
            "cannot be opened: unknown file type", file, "use PNG, JPEG, BMP, PGM or PPM for pictures");
    }
}

} // namespace

void AppController::open(const fs::path& file) {
    const bool is_cut_here = view_state_.workspace == Workspace::plot && project::is_gcode_file(file);
    if (project::is_plot_file(file) || project::holds_points(file) || is_cut_here) {
        open_plot(file);
        return;
    }
    if (project::opens_as_surface(file)) {
        open_surface(file);
        return;
    }
    if (const auto kind = processor_file(file)) {
        kind == ProcessorFile::microprogram ? open_microprogram(file) : open_assembler(file);
        return;
    }
    if (!is_project_file(file)) {
        expect_text(file);
        open_gcode(file);
        return;
    }
    const fs::path whole = fs::absolute(file).lexically_normal();
    const std::string text = read_file(whole);
    project::Project opened = project::project_from_text(text, whole);
    show_program_path(view_state_, opened);
    begin(opened,
          "Open " + file.filename().string(),
          {.file = whole, .saved = opened, .hash = jobs::program_hash(text), .program = {}});
    remember(file);
}

void AppController::receive(const std::vector<fs::path>& files) {
    expects(!files.empty(), "files are received, not none");
    const std::string name = files.front().filename().string();
    received_ = files.front();
    if (files.size() > 1) {
        tell(view_state_,
             widgets::Severity::warning,
             "Only one file can be opened at a time. Of these " + std::to_string(files.size()) +
                 ", Millwright opens " + name + ".");
    }
    follow_received();
    if (received_) {
        tell(view_state_, widgets::Severity::info, name + " will be opened after you answer the prompt.");
    }
}

void AppController::follow_received() {
    if (received_ && !look().asks()) {
        ActionQueue ask;
        ask.open_file(*std::exchange(received_, std::nullopt));
        perform(ask);
    }
}

void AppController::open_gcode(const fs::path& file) {
    if (jobs_->view().running) {
        throw Error("a job is running; open another program when it has ended", file);
    }
    reader_->open(file, view_state_.file.reading, options_.assets);
    jobs_->forget_failure();
    view_state_.workspace = Workspace::program;
    view_state_.file_prompt = FilePrompt::none;
    fit_program(view_state_);
    view_state_.start_at = {};
    follow_file();
    view_state_.file.step.reset();
    view_state_.playback = {};
    tells_of_file_ = true;
    remember(file);
}

void AppController::read_again() {
    if (const auto opened = reader_->latest()) {
        open_gcode(fs::path(opened->file));
    }
}

void AppController::close_file() {
    reader_->close();
    jobs_->forget_failure();
    fit_program(view_state_);
    follow_file();
    rewind(Played::file);
}

void AppController::cancel_work() {
    if (const plan::Activity ended = look().activity; ended.busy) {
        const auto made = pipeline_->latest();
        const bool is_whole = made && made->exact && made->project == design_of(history_.current());
        const bool planned = pipeline_->activity().busy && !is_whole; // not a watched adaptation alone
        tell(view_state_,
             widgets::Severity::info,
             with_full_stop("Cancelled" + (ended.text.empty() ? "" : ": " + ended.text)) +
                 (planned ? " Missing results are computed after the next change of the project." : ""));
    }
    pipeline_->cancel();
    reader_->cancel();
    set_up_->cancel();
    stock_->cancel();
    plot_->cancel();
    if (import_->activity().busy) {
        import_->close();
    }
    export_->cancel();
    writes_plot_.reset();
}

void AppController::rewind(Played program) {
    FileView& file = view_state_.file;
    if (file.played == program) {
        view_state_.playback = {};
        file.step.reset();
    } else {
        file.parked[static_cast<std::size_t>(program)] = {};
    }
}

/// The motions of the file, the plot and the project each keep their time; and what is wrong with the file is
/// reported once.
void AppController::follow_file() {
    const Played played = view_state_.workspace == Workspace::plot ? Played::plot
                          : look().in_file()                       ? Played::file
                                                                   : Played::project;
    if (FileView& file = view_state_.file; played != file.played) {
        view_state_.playback.playing = false;
        file.parked[static_cast<std::size_t>(file.played)] = {view_state_.playback, file.step};
        const ParkedPlayback& before = file.parked[static_cast<std::size_t>(played)];
        view_state_.playback = before.playback;
        file.step = before.step;
        file.played = played;
    }
    const auto opened = reader_->latest();
    if (!tells_of_file_ || !opened || !opened->finished) {
        return;
    }
    tells_of_file_ = false;
    const std::size_t faults = opened->errors.size() + opened->faults.size();
    if (faults > 0) {
        const Diagnostic& first = opened->errors.empty() ? opened->faults.front() : opened->errors.front();
        const std::string more = faults > 1 ? ", and " + std::to_string(faults - 1) + " more" : "";
        const Diagnostic shown{{first.place.file.filename(), first.place.line, first.place.column, -1},
                               first.message,
                               first.hint};
        tell(view_state_, widgets::Severity::warning, to_text(shown) + more);
    }
}

void AppController::new_from_preset(std::string_view preset_id) {
    const project::Project made = project::project_from_preset(preset_id);
    begin(made, "New project", {{}, made});
}

void AppController::begin(project::Project other, const std::string& title, Document document) {
    drag_.commit();
    const bool nothing_done = history_.undo_title().empty() && history_.redo_title().empty();
    if (nothing_done &&
        this->document().file.empty()) { // as the program makes it at its start: nothing to go back to
        history_ = project::History(std::move(other));
        documents_ = {std::move(document)};
    } else {
        history_.begin(std::move(other), title);
        documents_.resize(static_cast<std::size_t>(history_.project_number()) + 1);
        this->document() = std::move(document);
    }
    look_at_another();
}

void AppController::look_at_another() {
    import_->drop_reference();
    jobs_->forget_failure();
    view_state_.start_at = {};
    view_state_.selected.clear();
    fit_project(view_state_);
    view_state_.playback = {};
    view_state_.file_prompt = FilePrompt::none;
    follow_project();
}

void AppController::remember(const fs::path& file) {
    recent_ = project::with_recent(std::move(recent_), file);
    if (!options_.settings.empty()) {
        project::write_recent(recent_, options_.settings);
    }
}

fs::path AppController::colors_file() const {
    return options_.settings.empty() ? fs::path() : options_.settings.parent_path() / "colors.json";
}

/// Layers that a later version knows are left alone.
void AppController::read_colors() {
    const project::ColorChoices chosen = project::read_colors(colors_file());
    for (const render::LayerColorInfo& info : render::layer_color_infos()) {
        if (const auto found = chosen.find(std::string(info.id)); found != chosen.end()) {
            view_state_.colors.set(info.which, render::color_from(found->second));
        }
    }
}

void AppController::read_window_settings() {
    const fs::path file = project::window_settings_place(options_.settings);
    kept_settings_ = project::read_window_settings(file);
    for (const std::string& refused : restore(view_state_, kept_settings_)) {
        tell(view_state_, widgets::Severity::warning, as_sentence(refused), file.string());
    }
    kept_settings_ =
        kept_of(view_state_, std::move(kept_settings_)); // with what was not in the file, to see changes
}

/// Another window may have kept its own meanwhile: what was not changed here stays as that left it.
void AppController::keep_window_settings() {
    const fs::path file = project::window_settings_place(options_.settings);
    const project::WindowSettings now = kept_of(view_state_, kept_settings_);
    if (file.empty() || now == kept_settings_) {
        return;
    }
    guarded([&] {
        project::WindowSettings on_disk;
        try {
            on_disk = project::read_window_settings(file);
        } catch (const Error&) { // broken, which was said at the start
            on_disk = {};
        }
        for (const auto& [name, value] : now) {
            const auto before = kept_settings_.find(name);
            if (before == kept_settings_.end() || before->second != value) {
                on_disk[name] = value;
            }
        }
        project::write_window_settings(on_disk, file);
        kept_settings_ = now;
    });
}

void AppController::choose_color(render::LayerColor which, const std::optional<glm::vec3>& color) {
    view_state_.colors.set(which, color);
    if (colors_file().empty()) {
        return;
    }
    project::ColorChoices chosen = project::read_colors(colors_file());
    for (const render::LayerColorInfo& info : render::layer_color_infos()) {
        chosen.erase(std::string(info.id));
        if (const auto& own = view_state_.colors.of(info.which)) {
            chosen[std::string(info.id)] = render::color_text(*own);
        }
    }
    project::write_colors(chosen, colors_file());
}

void AppController::quit() {
    leave("close Millwright", [](AppController& app) {
        MachineConnection& connection = app.connection();
        bool unsure = false; // a card that did not report its motors as off is shown in the window
        if (arm_under_power(connection.view())) {
            connection.disconnect();
            connection.wait_idle();
            unsure = connection.view().failure.has_value();
        }
        app.view_state().quit = !unsure;
    });
}

void AppController::start_autosave() {
    if (!options_.recovery.empty()) {
        left_behind_ = project::left_behind(options_.recovery);
        autosave_ = std::make_unique<project::Autosave>(options_.recovery, options_.autosave_interval);
    }
}

void AppController::follow_autosave() {
    if (!autosave_) {
        return;
    }
    if (!changed()) {
        if (std::exchange(kept_, std::nullopt)) {
            autosave_->drop();
        }
    } else if (Document now{document().file, history_.current()}; kept_ != now) {
        autosave_->keep({now.saved, now.file, seconds_since_1970()});
        kept_ = std::move(now);
    }
    if (const auto failure = autosave_->take_failure()) {
        tell(view_state_,
             widgets::Severity::warning,
             "The unsaved changes cannot be backed up: " + failure->message,
             failure->place.file.string());
    }
}

void AppController::recover() {
    expects(!left_behind_.empty(), "something was left behind");
    const project::LeftBehind& left = left_behind_.front();
    if (!left.work()) {
        throw Error(*left.fault());
    }
    const project::UnsavedWork& work = *left.work();
    begin(work.project, "Recover " + work.project.name, document_of(work));
    follow_autosave();
    if (autosave_) {
        autosave_->wait_idle(); // the old copy stays until the new one is there
    }
    discard_left_behind();
    tell(view_state_, widgets::Severity::good, "Recovered. It is not saved yet.", document().file.string());
}

void AppController::discard_left_behind() {
    left_behind_.front().discard();
    left_behind_.erase(left_behind_.begin());
}

void AppController::leave_left_behind() {
    left_behind_.clear();
}

/// Points are played from their beginning, by the pane of the table.
void AppController::play_again(const jobs::JobStory& story) {
    view_state_.workspace = Workspace::plot;
    open(story.start.project);
    plot_->set_table_port(story.start.address);
}

void AppController::continue_broken_job() {
    const auto stories = job_recovery_->broken();
    expects(!stories->empty(), "a job was broken off");
    const jobs::JobStory story = stories->front();
    const fs::path file(story.start.project);
    if (story.start.driver == "points") {
        play_again(story);
        job_recovery_->dismiss();
        return;
    }
    if (is_project_file(file)) {
        close_file();
    }
    open(file);
    view_state_.workspace = Workspace::machine;
    if (!connection_->view().connected()) {
        view_state_.manual.choice.driver = machine::driver_row(story.start.driver).name;
        view_state_.manual.choice.address = story.start.address;
    }
    const bool in_the_middle = jobs::why_not_from_line(story).empty();
    view_state_.start_at =
        in_the_middle ? StartAt{true, story.next_line, std::nullopt, story.start.program_hash} : StartAt{};
    job_recovery_->dismiss();
}

void AppController::close() {
    keep_window_settings();
    if (autosave_) {
        autosave_->drop();
        autosave_.reset();
    }
}

} // namespace millwright::actions
