// Derives a Plan from the project in the background: always the newest project, what still holds is kept,
// what is stale comes coarse first and exact afterwards. Results are immutable and published whole; the owner
// polls `latest` once per frame. One worker for the plan, one for an adaptation that is watched; all public
// members are called from the owner's thread and return at once.
#pragma once

#include "core/base/error.h"
#include "core/plan/plan.h"

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace millwright::plan {

/// What the workers are doing, for the status bar.
struct Activity {
    bool busy = false;
    double fraction = 0.0; ///< 0 to 1
    std::string text = {};
    bool stopping = false; ///< no longer needed: it ends with its next check
};

/// A plan with the project it belongs to. `revision` grows with every publication.
struct PublishedPlan {
    project::Project project;
    Plan plan;                         ///< parts that are not there yet are null
    std::optional<Diagnostic> failure; ///< why the plan stops short of a program
    std::uint64_t revision = 0;
    bool program_exact = false; ///< the program, and what the cutter does on it, are as for a report
    bool exact = false;         ///< complete and sampled as for a report, not as for a drag
};

/// A grid improvement that a person watches.
struct WatchedAdaptation {
    project::GridMethod method = project::GridMethod::elliptic;
    bool playing = false;
    std::shared_ptr<const grid::OptimiserState> state; ///< null before the first step
    std::uint64_t revision = 0;
    std::optional<Diagnostic> failure;

    /// It could not begin or go on, or its solver gave up: there is no grid of it to use.
    [[nodiscard]] bool failed() const;
    /// Another step would do nothing.
    [[nodiscard]] bool ended() const;
};

class Pipeline {
public:
    /// `wake` is called from a worker whenever something new can be polled (the window then redraws).
    Pipeline(Folders folders, std::function<void()> wake);
    Pipeline(const Pipeline&) = delete;
    Pipeline& operator=(const Pipeline&) = delete;
    /// Waits until the workers have noticed: 100 ms at most.
    ~Pipeline();

    /// What of the plan is looked at, from now on; at first all of it. What comes to it is made after what
    /// runs, but nothing after cancel() before the next request; what goes from it is made no more for later
    /// projects.
    void want(const Scope& scope);

    /// Derive for this project from now on; what runs for an older one is dropped within 100 ms. Does nothing
    /// if it is the project already asked for. A watched adaptation ends if its surface, machine or grid
    /// changed.
    void request(const project::Project& project, const Folders& folders);
    void request(const project::Project& project) { request(project, folders_); }
    /// Stops what runs, here and in a watched adaptation; the last published plan stays.
    void cancel();

    /// Null before the first publication.
    [[nodiscard]] std::shared_ptr<const PublishedPlan> latest() const;
    [[nodiscard]] Activity activity() const;

    /// Live adaptation of the requested project's grid, beside the plan. Starting pauses at the uniform grid.
    /// The others do nothing while none is watched. `method` is not uniform.
    void start_adaptation(project::GridMethod method);
    void play_adaptation();
    /// The step under way is dropped.
    void pause_adaptation();
    /// One step, after those already asked for; pauses.
    void step_adaptation();
    /// Back to the uniform grid, paused.
    void reset_adaptation();
    /// Null while none is watched.
    [[nodiscard]] std::shared_ptr<const WatchedAdaptation> adaptation() const;

    /// Blocks until nothing is left to do (tests and scripts).
    void wait_idle() const;

private:
    class Planner;
    class Adapter;

    Folders folders_;
    Scope wanted_ = Scope::everything;
    std::optional<project::Project> requested_;
    Scope derived_;          ///< what of its plan was asked for
    bool cancelled_ = false; ///< what was asked for last may be asked for again
    std::unique_ptr<Planner> planner_;
    std::unique_ptr<Adapter> adapter_;
};

} // namespace millwright::plan
