#include "ui/actions/workshop.h"

#include "core/base/error.h"
#include "core/project/project_file.h"
#include "core/project/recent_files.h"

#include <algorithm>
#include <utility>

namespace millwright::actions {

namespace {

project::Project starting_project() {
    return project::project_from_preset("dome");
}

/// Selected control points that the project still has.
void drop_lost_selection(Session& session, const project::Project& project) {
    const auto lost = [&](const viewport::ControlPointId& id) {
        const auto patch = static_cast<std::size_t>(id.patch);
        return patch >= project.surface.patches.size() || id.i >= project.surface.patches[patch].rows ||
               id.j >= project.surface.patches[patch].columns;
    };
    std::erase_if(session.selected, lost);
}

} // namespace

Workshop::Workshop(WorkshopOptions options)
    : options_(std::move(options)), history_(starting_project()), session_(new_session()) {
    document_.saved = history_.current();
    guarded([this] { document_.recent = project::read_recent(options_.settings); });
    const auto wake = options_.wake ? options_.wake : [] {};
    pipeline_ = std::make_unique<project::Pipeline>(project::Folders{{}, options_.assets}, wake);
    jobs_ = std::make_unique<JobRunner>(options_.log_folder, wake);
    request_plan();
}

Workshop::~Workshop() = default;

Workbench Workshop::look() const {
    return {history_.current(),
            session_,
            document_,
            pipeline_->latest(),
            pipeline_->adaptation(),
            pipeline_->activity(),
            jobs_->view(),
            history_.undo_title(),
            history_.redo_title(),
            options_.assets};
}

void Workshop::request_plan() {
    drop_lost_selection(session_, history_.current());
    const auto folder = document_.file.empty() ? std::filesystem::path{} : document_.file.parent_path();
    pipeline_->request(history_.current(), {folder, options_.assets});
}

void Workshop::guarded(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        Place place = error.diagnostic().place;
        const std::string where = to_text(Diagnostic{place, {}, {}});
        const std::string& hint = error.diagnostic().hint;
        tell(session_,
             widgets::Severity::danger,
             error.diagnostic().message + (hint.empty() ? "" : " (" + hint + ")"),
             where.substr(0, where.size() - std::min<std::size_t>(2, where.size())));
    }
}

void Workshop::run(std::string_view id) {
    const Action& action = catalogue_.find(id);
    const Workbench now = look();
    if (const auto permission = action.permission(now); !permission.allowed) {
        tell(session_, widgets::Severity::info, permission.reason);
        return;
    }
    const project::Project before = history_.current();
    Hands hands{history_, session_, document_, *pipeline_, *jobs_, now};
    action.run(hands);
    if (!(before == history_.current())) {
        request_plan();
    }
}

void Workshop::perform(ActionQueue& asked) {
    for (const ActionQueue::Request& request : asked.take()) {
        guarded([&] { request(*this); });
    }
}

bool Workshop::advance(double seconds) {
    Playback& playback = session_.playback;
    const auto trajectory = look().trajectory();
    if (!trajectory) {
        playback.playing = false;
        return false;
    }
    const double before = playback.time;
    playback.time = std::clamp(playback.time, 0.0, trajectory->duration());
    if (playback.playing) {
        playback.time = std::min(playback.time + seconds * playback.speed, trajectory->duration());
        playback.playing = playback.time < trajectory->duration();
    }
    return playback.time < before || playback.time > before;
}

void Workshop::open(const std::filesystem::path& file) {
    project::Project opened = project::read_project(file);
    history_.commit(opened, "Open " + file.filename().string());
    history_.close_step();
    document_.file = file;
    document_.saved = std::move(opened);
    document_.recent = project::with_recent(std::move(document_.recent), file);
    session_.selected.clear();
    session_.fit_wanted = true;
    session_.playback = {};
    session_.question = FileQuestion::none;
    session_.shown = history_.current().grid.method;
    request_plan();
    if (!options_.settings.empty()) {
        project::write_recent(document_.recent, options_.settings);
    }
}

void Workshop::save(const std::filesystem::path& file) {
    project::write_project(history_.current(), file);
    document_.file = file;
    document_.saved = history_.current();
    document_.recent = project::with_recent(std::move(document_.recent), file);
    session_.question = FileQuestion::none;
    tell(session_, widgets::Severity::good, "Saved.", file.string());
    if (!options_.settings.empty()) {
        project::write_recent(document_.recent, options_.settings);
    }
}

void Workshop::new_from_preset(std::string_view preset_id) {
    history_.commit(project::project_from_preset(preset_id), "New project");
    history_.close_step();
    document_.file.clear();
    document_.saved = history_.current();
    session_.selected.clear();
    session_.fit_wanted = true;
    session_.playback = {};
    request_plan();
}

void Workshop::edit(const std::string& title,
                    const std::function<void(project::Project&)>& change,
                    const std::string& merge_key) {
    project::Project draft = history_.current();
    change(draft);
    if (const auto faults = faults_of(draft); !faults.empty()) {
        throw Error(faults.front());
    }
    if (draft == history_.current()) {
        return;
    }
    history_.commit(std::move(draft), title, merge_key);
    request_plan();
}

void Workshop::wait_idle() {
    pipeline_->wait_idle();
    jobs_->wait();
}

} // namespace millwright::actions
