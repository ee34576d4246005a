#include "core/plan/pipeline.h"

#include "core/base/published.h"
#include "core/plan/internal/background.h"
#include "core/plan/internal/derivation.h"
#include "core/plan/internal/failure.h"
#include "core/plan/internal/stages.h"
#include "core/project/surface.h"

#include <utility>

namespace millwright::plan {

/// The plan's worker, with what it published last.
class Pipeline::Planner {
public:
    explicit Planner(const std::function<void()>& wake) : wake_(wake), background_(wake) {}

    void derive(const project::Project& project, const Folders& folders, const Scope& scope) {
        background_.replace(job_of(project, folders, scope));
    }
    /// After what runs.
    void derive_more(const project::Project& project, const Folders& folders, const Scope& scope) {
        background_.append(job_of(project, folders, scope));
    }
    void stop() { background_.clear(); }

    [[nodiscard]] std::shared_ptr<const PublishedPlan> latest() const { return published_.latest(); }
    [[nodiscard]] Activity activity() const { return background_.activity(); }
    void wait_idle() const { background_.wait_idle(); }

private:
    Background::Job job_of(const project::Project& project, const Folders& folders, const Scope& scope) {
        return [this, project, folders, scope](const Progress& progress) {
            const auto publish = [&](const Publication& now) {
                progress.check();
                set({project, now.plan, now.failure, 0, now.program_exact, now.exact});
            };
            if (const auto failure =
                    failure_of([&] { derivation_.derive(project, folders, scope, publish, progress); })) {
                const Plan nothing;
                publish({nothing, failure});
            }
        };
    }

    void set(PublishedPlan plan) {
        published_.publish(std::move(plan));
        wake_();
    }

    std::function<void()> wake_;
    Published<PublishedPlan> published_;
    Derivation derivation_; // of the worker
    Background background_; // last: its thread uses all of the above
};

/// The worker of a watched adaptation. A session is made by its first step, in the worker.
class Pipeline::Adapter {
public:
    explicit Adapter(const std::function<void()>& wake) : wake_(wake), background_(wake) {}

    void start(project::GridMethod method, const project::Project& project, const Folders& folders) {
        background_.clear();
        auto session =
            std::make_shared<Session>(Session{method, source_of(project, folders), nullptr, nullptr});
        session_ = std::move(session); // the arguments may be the old one's
        set(session_.get(), {method, false, nullptr, 0, std::nullopt});
    }
    void play() {
        if (session_) {
            background_.clear();
            mark_playing(true);
            background_.append([this, session = session_](const Progress& progress) {
                while (step(*session, progress)) {
                }
            });
        }
    }
    void pause() {
        if (session_) {
            background_.clear();
            mark_playing(false);
        }
    }
    void step() {
        if (session_) {
            if (watched()->playing) {
                pause();
            }
            background_.append(
                [this, session = session_](const Progress& progress) { (void)step(*session, progress); });
        }
    }
    void reset() {
        if (session_) {
            start(session_->method, session_->source.project, session_->source.folders);
        }
    }
    void end() {
        background_.clear();
        session_ = nullptr;
        const std::scoped_lock lock(mutex_);
        watched_ = nullptr;
        current_ = nullptr;
    }

    /// What the session, if there is one, is about.
    [[nodiscard]] bool is_about(const project::Project& project, const Folders& folders) const {
        return session_ && session_->source.project.grid == project.grid &&
               same_cutting_setup(session_->source, source_of(project, folders));
    }
    [[nodiscard]] std::shared_ptr<const WatchedAdaptation> watched() const {
        const std::scoped_lock lock(mutex_);
        return watched_;
    }
    [[nodiscard]] Activity activity() const { return background_.activity(); }
    void wait_idle() const { background_.wait_idle(); }

private:
    /// All that the worker needs; the optimiser refers to the error model.
    struct Session {
        project::GridMethod method;
        Source source;
        std::unique_ptr<const toolpath::KinematicError> error;
        std::unique_ptr<grid::GridOptimiser> optimiser;
    };

    /// One step in the worker; true while there is more to do.
    bool step(Session& session, const Progress& progress) {
        bool more = false;
        const auto failure = failure_of([&] {
            if (!session.optimiser) {
                const project::Project& project = session.source.project;
                session.error = std::make_unique<const toolpath::KinematicError>(
                    cutting_setup_of(
                        project, session.source.folders, project::machined_region(project.surface, progress))
                        .error_model());
                session.optimiser =
                    make_optimiser(session.method, session.source.project.grid, *session.error);
            }
            more = session.optimiser->advance(progress);
        });
        WatchedAdaptation now{session.method, false, nullptr, 0, failure};
        if (session.optimiser) {
            now.state = std::make_shared<const grid::OptimiserState>(session.optimiser->state());
        }
        publish(session, std::move(now), more);
        return more;
    }

    void publish(const Session& session, WatchedAdaptation now, bool more) {
        {
            const std::scoped_lock lock(mutex_);
            if (current_ != &session) {
                return;
            }
            now.playing = more && watched_->playing;
            now.revision = ++revision_;
            watched_ = std::make_shared<const WatchedAdaptation>(std::move(now));
        }
        wake_();
    }

    void set(const Session* session, WatchedAdaptation now) {
        const std::scoped_lock lock(mutex_);
        current_ = session;
        now.revision = ++revision_;
        watched_ = std::make_shared<const WatchedAdaptation>(std::move(now));
    }

    void mark_playing(bool playing) {
        const std::scoped_lock lock(mutex_);
        WatchedAdaptation now = *watched_;
        now.playing = playing;
        now.revision = ++revision_;
        watched_ = std::make_shared<const WatchedAdaptation>(std::move(now));
    }

    std::function<void()> wake_;
    std::shared_ptr<Session> session_; // of the owner; its content is the worker's
    mutable std::mutex mutex_;
    const Session* current_ = nullptr; // whose steps are still wanted
    std::shared_ptr<const WatchedAdaptation> watched_;
    std::uint64_t revision_ = 0;
    Background background_; // last: its thread uses all of the above
};

bool WatchedAdaptation::failed() const {
    using grid::OptimiserStatus;
    return failure || (state && (state->status == OptimiserStatus::folded ||
                                 state->status == OptimiserStatus::singular ||
                                 state->status == OptimiserStatus::not_finite));
}

bool WatchedAdaptation::ended() const {
    return failure || (state && state->status != grid::OptimiserStatus::running);
}

Pipeline::Pipeline(Folders folders, std::function<void()> wake)
    : folders_(std::move(folders)), planner_(std::make_unique<Planner>(wake)),
      adapter_(std::make_unique<Adapter>(wake)) {}

Pipeline::~Pipeline() = default;

void Pipeline::want(const Scope& scope) {
    wanted_ = scope;
    if (const Scope all = derived_.with(scope); requested_ && !cancelled_ && !(all == derived_)) {
        derived_ = all;
        planner_->derive_more(*requested_, folders_, derived_);
    }
}

void Pipeline::request(const project::Project& project, const Folders& folders) {
    if (!cancelled_ && requested_ == project && folders_ == folders) {
        return;
    }
    cancelled_ = false;
    requested_ = project;
    folders_ = folders;
    if (!adapter_->is_about(project, folders)) {
        adapter_->end();
    }
    derived_ = wanted_;
    planner_->derive(project, folders, derived_);
}

void Pipeline::cancel() {
    cancelled_ = cancelled_ || planner_->activity().busy;
    planner_->stop();
    adapter_->pause();
}

std::shared_ptr<const PublishedPlan> Pipeline::latest() const {
    return planner_->latest();
}

Activity Pipeline::activity() const {
    const Activity planning = planner_->activity();
    return planning.busy ? planning : adapter_->activity();
}

void Pipeline::start_adaptation(project::GridMethod method) {
    expects(method != project::GridMethod::uniform, "the uniform grid is not adapted");
    expects(requested_.has_value(), "a project is set before its grid is adapted");
    adapter_->start(method, *requested_, folders_);
}

void Pipeline::play_adaptation() {
    adapter_->play();
}
void Pipeline::pause_adaptation() {
    adapter_->pause();
}
void Pipeline::step_adaptation() {
    adapter_->step();
}

void Pipeline::reset_adaptation() {
    adapter_->reset();
}

std::shared_ptr<const WatchedAdaptation> Pipeline::adaptation() const {
    return adapter_->watched();
}

void Pipeline::wait_idle() const {
    planner_->wait_idle();
    adapter_->wait_idle();
}

} // namespace millwright::plan
