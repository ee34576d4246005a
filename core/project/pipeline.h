// Derives a Plan from the project in the background: always the newest project, stale parts first and coarse,
// exact afterwards. Results are immutable and published whole; the owner polls `latest` once a frame.
// One worker thread; all public members are called from the owner's thread.
#pragma once

#include "core/project/plan.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>

namespace millwright::project {

/// What the worker is doing, for the status bar.
struct Activity {
    bool busy = false;
    double fraction = 0.0;
    std::string text;
};

/// A plan with the project it belongs to. `revision` grows with every publication.
struct PublishedPlan {
    Project project;
    Plan plan;
    std::optional<Diagnostic> failure; ///< why the plan stops short of a program
    std::uint64_t revision = 0;
    bool exact = false; ///< sampled as for a report, not as for a drag
};

/// A grid improvement that a person watches.
struct WatchedAdaptation {
    GridMethod method = GridMethod::elliptic;
    bool playing = false;
    std::shared_ptr<const grid::ImproverState> state; ///< null before the first step
    std::uint64_t revision = 0;
    std::optional<Diagnostic> failure;
};

class Pipeline {
public:
    /// `wake` is called from the worker whenever something new can be polled (the window then redraws).
    Pipeline(Folders folders, std::function<void()> wake);
    ~Pipeline();
    Pipeline(const Pipeline&) = delete;
    Pipeline& operator=(const Pipeline&) = delete;

    /// Derive for this project from now on; what runs for an older one is dropped within 100 ms.
    void request(const Project& project, const Folders& folders);
    /// Stops what runs; the last published plan stays.
    void cancel();

    [[nodiscard]] std::shared_ptr<const PublishedPlan> latest() const;
    [[nodiscard]] Activity activity() const;

    /// Live adaptation of the requested project's grid, beside the plan.
    void start_adaptation(GridMethod method);
    void play_adaptation();
    void pause_adaptation();
    void step_adaptation();
    void reset_adaptation();
    [[nodiscard]] std::shared_ptr<const WatchedAdaptation> adaptation() const;

    /// Blocks until nothing is left to do (tests and scripts).
    void wait_idle();

private:
    class Worker;
    std::unique_ptr<Worker> worker_;
};

} // namespace millwright::project
