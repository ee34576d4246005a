#include "ui/actions/app_controller.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "ui/workspaces/arm_workspace.h"
#include "ui/workspaces/at_rest.h"
#include "ui/workspaces/control_points.h"
#include "ui/workspaces/job_source.h"
#include "ui/workspaces/pending_import.h"
#include "ui/workspaces/processor_workspace.h"
#include "ui/workspaces/stock_workspace.h"
#include "ui/workspaces/surface_export.h"
#include "ui/workspaces/wanted_plan.h"

#include <algorithm>
#include <utility>

namespace millwright::actions {

namespace {

project::Project starting_project(const AppOptions& options) {
    return options.start ? *options.start : project::project_from_preset("dome");
}

Box3 box_of(const project::SurfaceInput& surface) {
    Box3 box;
    for (const geometry::ControlNet& net : surface.patches) {
        for (const Vec3& point : net.points) {
            box.extend(point);
        }
    }
    for (const project::FaceInput* face : surface.exact_faces()) {
        for (const Vec3& point : face->net.points) {
            box.extend(point);
        }
    }
    return box;
}

/// So much larger, smaller or away from `before` that a view of that does not show `now`: another body, not a
/// point that was dragged.
bool is_elsewhere(const project::SurfaceInput& before, const project::SurfaceInput& now) {
    constexpr double growth = 1.5;
    constexpr double way = 0.25; // of the size
    const Box3 a = box_of(before);
    const Box3 b = box_of(now);
    const double old_size = a.diagonal().norm();
    const double new_size = b.diagonal().norm();
    return new_size > growth * old_size || old_size > growth * new_size ||
           (a.center() - b.center()).norm() > way * new_size;
}

plan::Activity activity_of(const SurfaceExport& work) {
    Progress::Report now = work.progress();
    return {true, now.fraction, "Writing the surface" + (now.text.empty() ? "" : ": " + now.text)};
}

} // namespace

AppController::AppController(AppOptions options)
    : options_(std::move(options)), history_(starting_project(options_)), view_state_(new_view_state()),
      queue_(options_.log_folder / "queue.json") {
    documents_.push_back({{}, history_.current()});
    guarded([this] { recent_ = project::read_recent(options_.settings); });
    guarded([this] { read_colors(); });
    guarded([this] { read_window_settings(); });
    guarded([this] { start_autosave(); });
    const auto wake = options_.wake ? options_.wake : [] {};
    pipeline_ = std::make_unique<plan::Pipeline>(plan::Folders{{}, options_.assets}, wake);
    reader_ = std::make_unique<plan::ProgramReader>(wake);
    set_up_ = std::make_unique<plan::SetUpWorker>(wake);
    stock_ = std::make_unique<StockWorkspace>(wake);
    plot_ = std::make_unique<PlotWorkspace>(options_.assets, options_.log_folder, wake);
    import_ = std::make_unique<PendingImport>(wake);
    export_ = std::make_unique<SurfaceExport>(wake);
    connection_ = std::make_unique<MachineConnection>(options_.log_folder, wake);
    jog_ = std::make_unique<HoldToRunJog>(*connection_);
    jobs_ = std::make_unique<JobRunner>(options_.log_folder, wake);
    processor_ = std::make_unique<ProcessorWorkspace>(wake);
    arm_ = std::make_unique<ArmWorkspace>(options_.assets, wake);
    approach_ = std::make_unique<ApproachFinder>(wake);
    start_ = std::make_unique<StartChecker>(check_start, wake);
    run_check_ = std::make_unique<RunChecker>(check_run, wake);
    next_check_ = std::make_unique<RunChecker>(check_run, wake);
    job_recovery_ = std::make_unique<JobRecovery>(options_.log_folder, wake);
    follow_project();
}

AppController::~AppController() = default;

std::shared_ptr<const plan::OpenedProgram> AppController::opened() const {
    if (view_state_.workspace == Workspace::plot) {
        return plot_->opened();
    }
    auto file = reader_->latest();
    return !file && view_state_.workspace == Workspace::arm ? plot_->opened() : file;
}

FrameState AppController::look() const {
    const auto answer_of = [](const RunChecker& checker, const std::shared_ptr<const RunWish>& wish) {
        auto found = checker.answer();
        return found && wish && found->wish == wish ? found : nullptr;
    };
    return {history_.current(),
            view_state_,
            document(),
            pipeline_->latest(),
            pipeline_->adaptation(),
            import_->activity().busy   ? import_->activity()
            : export_->busy()          ? activity_of(*export_)
            : plot_->activity().busy   ? plot_->activity()
            : reader_->activity().busy ? reader_->activity()
            : set_up_->activity().busy ? set_up_->activity()
            : stock_->activity().busy  ? stock_->activity()
                                       : pipeline_->activity(),
            reader_->latest(),
            opened(),
            jobs_->view(),
            approach_->answer(),
            connection_->view(),
            connection_->console(),
            history_.undo_title(),
            history_.redo_title(),
            options_.assets,
            recent_,
            leaving_ ? leaving_->to : std::string(),
            left_behind_,
            job_recovery_->broken(),
            gamepad_,
            *processor_,
            *arm_,
            *plot_,
            *import_,
            queue_.jobs(),
            machine_solids_.bodies(),
            set_up_->latest(),
            queue_.problem(),
            start_->answer(),
            answer_of(*run_check_, run_wish_),
            answer_of(*next_check_, next_wish_),
            *stock_};
}

void AppController::follow_project() {
    std::erase_if(view_state_.selected, [&](const viewport::ControlPointId& id) {
        return !has_point(history_.current().surface, id);
    });
    const auto& file = document().file;
    const auto folder = file.empty() ? std::filesystem::path{} : file.parent_path();
    const project::Project design = design_of(history_.current());
    const project::PlotInput plot = history_.current().plot;
    want_plan();
    pipeline_->request(design, {folder, options_.assets});
    guarded([&] { machine_solids_.follow(design, {folder, options_.assets}); });
    if (!(plot_->input() == plot)) {
        writes_plot_.reset();
        if (plot_->file() != plot.file) { // another one begins at its beginning
            rewind(Played::plot);
        }
        guarded([&] { plot_->follow(plot); });
    }
}

void AppController::want_plan() {
    pipeline_->want(wanted_plan(view_state_, history_.current()));
}

void AppController::search_set_up() {
    const auto& file = document().file;
    view_state_.set_up.place.reset();
    set_up_->request(history_.current(),
                     {file.empty() ? std::filesystem::path{} : file.parent_path(), options_.assets},
                     view_state_.set_up.settings);
}

void AppController::accept_set_up() {
    const toolpath::SetUpPlace place = look().set_up_place();
    edit("Accept the position on the table",
         [&](project::Project& draft) { draft = plan::with_set_up(std::move(draft), place); },
         {});
}

void AppController::guarded(const std::function<void()>& action) {
    try {
        action();
    } catch (const Error& error) {
        Place place = error.diagnostic().place;
        const std::string where = to_text(Diagnostic{place, {}, {}});
        const std::string& hint = error.diagnostic().hint;
        tell(view_state_,
             widgets::Severity::danger,
             error.diagnostic().message + (hint.empty() ? "" : " (" + hint + ")"),
             where.substr(0, where.size() - std::min<std::size_t>(2, where.size())));
        view_state_.notices.back().passing = dynamic_cast<const MachineError*>(&error) != nullptr;
    } catch (const std::filesystem::filesystem_error& failure) { // links in a loop, a folder that is gone
        tell(view_state_, widgets::Severity::danger, failure.code().message(), failure.path1().string());
    }
}

void AppController::run(std::string_view id) {
    const Action& action = catalogue_.find(id);
    const FrameState now = look();
    if (const auto permission = action.permission(now); !permission.allowed) {
        tell(view_state_, widgets::Severity::info, permission.reason);
        return;
    }
    drag_.commit(); // what is dragged on is a step of its own
    const project::Project before = history_.current();
    const int number_before = history_.project_number();
    ActionContext context{history_, view_state_, document(), *pipeline_, *jobs_, now, *this};
    action.run(context);
    if (history_.project_number() != number_before) { // undo and redo go from file to file, too
        look_at_another();
    } else if (!(before == history_.current())) {
        if (is_elsewhere(before.surface, history_.current().surface)) {
            fit_project(view_state_);
        }
        follow_project();
    }
}

void AppController::perform(ActionQueue& asked, bool focused) {
    const auto wish = asked.take_jog();
    for (const ActionQueue::Request& request : asked.take()) {
        guarded([&] { request(*this); });
    }
    view_state_.dialogs.quit =
        view_state_.dialogs.quit && (jobs_->view().running || arm_under_power(connection_->view()));
    const bool allowed = focused && !look().asks() && !view_state_.quit;
    guarded([&] { jog_->follow(wish, allowed); });
    queue_.rest();
    follow_autosave();
}

void AppController::connect() {
    const FrameState now = look();
    std::shared_ptr<const kinematics::MachineModel> model;
    if (now.opened && now.opened->machine) {
        model = now.opened->machine;
    } else if (now.plan && now.plan->plan.cutting_setup) {
        model = std::make_shared<const kinematics::MachineModel>(now.plan->plan.cutting_setup->machine);
    }
    ManualSettings& manual = view_state_.manual;
    manual.keys_armed = manual.pad_armed = manual.arm_keys = manual.single_block = false;
    machine::DriverChoice choice = manual.choice;
    if (choice.driver != "records") {
        choice.record.reset(); // of the table alone: a coordinate stream has lines of its own here
    }
    std::shared_ptr<const arm::ArmModel> arm;
    if (const machine::DriverRow& row = machine::driver_row(choice.driver);
        row.kind == machine::MachineKind::arm) {
        if (!arm_->loaded()) {
            arm_->load(std::string(row.arm));
        }
        arm = {arm_->look(), &arm_->arm()};
    }
    connection_->connect(choice, std::move(model), std::move(arm));
}

void AppController::watch_jog(bool held, bool focused) {
    if (jog_->moving() && (!held || !focused)) {
        jog_->let_go();
    }
}

bool AppController::advance(double seconds) {
    want_plan();
    follow_received();
    follow_plot();
    follow_import();
    follow_file();
    follow_begin(look());          // drops an approach to what is no longer wished
    const FrameState now = look(); // one for all that follows
    follow_run(now);
    follow_queue(now);
    follow_next(now);
    arm_->news().follow(now.connection, connection_->driver(), view_state_);
    stock_->follow(now, view_state_);
    const bool armed = follow_arm(now, seconds);
    const bool processed = follow_processor(seconds) || armed;
    Playback& playback = view_state_.playback;
    const double duration = now.duration();
    if (!(duration > 0.0)) {
        playback.playing = false;
        return processed;
    }
    const double before = playback.time;
    follow_job(now);
    playback.time = std::clamp(playback.time, 0.0, duration);
    if (playback.playing) {
        view_state_.file.step.reset();
        playback.time = std::min(playback.time + seconds * playback.speed, duration);
        playback.playing = playback.time < duration;
    }
    return processed || playback.time < before || playback.time > before;
}

/// Of what a job is made of: none is made of what the Plot & Picture workspace shows.
void AppController::follow_begin(const FrameState& now) {
    const bool is_plot = view_state_.workspace == Workspace::plot;
    if (!view_state_.start_at.on || is_plot || now.job.running || !program_ready(now).allowed) {
        approach_->want(std::nullopt);
        return;
    }
    const auto dialect = now.connection.can.dialect.value_or(gcode::Dialect::linuxcnc);
    approach_->want(ApproachWish{job_source(now), view_state_.start_at, dialect});
}

/// Where Run starts something, and not while a machine moves: then the last answer stays.
void AppController::follow_run(const FrameState& now) {
    if (now.view_state.workspace != Workspace::machine || now.job.running || !job_ready(now).allowed) {
        if (std::exchange(run_wish_, nullptr)) {
            run_check_->forget();
        }
        return;
    }
    if (now.connection.connected() && !at_rest(now.connection).allowed) {
        return;
    }
    if (RunWish wish = run_wish(now); !run_wish_ || !asks_the_same(*run_wish_, wish)) {
        run_wish_ = std::make_shared<const RunWish>(std::move(wish));
        run_check_->want(run_wish_);
    }
}

/// The same of the job that the queue would begin with.
void AppController::follow_next(const FrameState& now) {
    const auto next = std::ranges::find_if(
        now.queue, [](const jobs::QueuedJob& job) { return job.state != jobs::QueueState::done; });
    const bool waits =
        next != now.queue.end() && next->state == jobs::QueueState::waiting && next->has_program;
    if (now.view_state.workspace != Workspace::machine || now.job.running || !waits) {
        if (std::exchange(next_wish_, nullptr)) {
            next_check_->forget();
        }
        return;
    }
    if (now.connection.connected() && !at_rest(now.connection).allowed) {
        return;
    }
    const auto job = queue_.open().program_of(next->id);
    if (RunWish wish = run_wish(now, job); !next_wish_ || !asks_the_same(*next_wish_, wish)) {
        next_wish_ = std::make_shared<const RunWish>(std::move(wish));
        next_check_->want(next_wish_);
    }
}

void AppController::ask_to_start(StartWish wish) {
    view_state_.start = std::make_shared<const StartWish>(std::move(wish));
    view_state_.start_answer = 0;
    start_->want(view_state_.start);
}

/// So that the timeline stays where the machine came to rest.
void AppController::follow_job(const FrameState& now) {
    const bool follows = now.follows_job();
    const bool ended = follows_job_ && now.job.report && now.job_is_shown();
    if (follows || ended) {
        view_state_.playback.time = now.job_time();
    }
    follows_job_ = follows;
}

void AppController::edit(const std::string& title,
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
    follow_project();
}

void AppController::revert_step(const std::string& merge_key) {
    history_.revert_step(merge_key);
    follow_project();
}

void AppController::wait_idle() {
    want_plan();
    pipeline_->wait_idle();
    set_up_->wait_idle();
    import_->wait_idle();
    export_->wait_idle();
    follow_import();
    plot_->wait_idle();
    follow_plot();
    reader_->wait_idle();
    jobs_->wait();
    follow_begin(look());
    approach_->wait_idle();
    follow_run(look());
    run_check_->wait_idle();
    follow_next(look());
    next_check_->wait_idle();
    start_->wait_idle();
    job_recovery_->wait_idle();
    arm_->wait_idle();
    stock_->wait_idle();
    stock_->follow(look(), view_state_);
    stock_->wait_idle();
    stock_->follow(look(), view_state_); // the picture that the first one asked for
}

} // namespace millwright::actions
