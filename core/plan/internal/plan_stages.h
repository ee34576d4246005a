// The stages of a plan as a person who edits wants them: what is still true is kept, what is stale comes
// first coarse and then exact.
#pragma once

#include "core/base/error.h"
#include "core/plan/plan.h"

#include <array>
#include <filesystem>
#include <functional>
#include <optional>

namespace millwright::plan {

/// Remembers the last plan. Used by one thread at a time.
class PlanStages {
public:
    /// What is there by now; `failure` says why there will be no more.
    using Publish =
        std::function<void(const Plan& plan, const std::optional<Diagnostic>& failure, bool exact)>;

    /// Publishes one or several times. Throws Cancelled only.
    void derive(const project::Project& project,
                const Folders& folders,
                const Publish& publish,
                const Progress& progress);

private:
    /// A grid's evaluation and whether it is as for a report.
    struct Held {
        std::shared_ptr<const Evaluation> evaluation;
        bool exact = false;
    };
    /// The path of the strategy and what it was made from.
    struct HeldPath {
        std::shared_ptr<const Evaluation> evaluation;
        std::shared_ptr<const Evaluation> over; ///< whose grid it takes
        bool exact = false;
    };
    using HeldGrids = std::array<Held, project::every_grid_method.size()>; ///< by GridMethod
    /// What a plan was made from.
    struct Source {
        project::Project project;
        Folders folders;
        std::filesystem::file_time_type machine_written;
    };
    struct State {
        std::optional<Source> source; ///< nothing where the project had faults
        Plan plan;
        HeldGrids held;
        HeldPath path;
        std::shared_ptr<const Evaluation> program_of; ///< the evaluation that the program was made from
    };

    void begin(const project::Project& project, const Folders& folders);
    void keep_grids(const State& last);
    void keep_path(const State& last);
    void keep_weight(const State& last);
    void keep_program(const State& last);
    void coarse(const Publish& publish, const Progress& progress);
    void exact(const Publish& publish, const Progress& progress);
    void compare(const Progress& progress);
    void carry_over(project::GridMethod method, const Progress& progress);
    void measure_uniform(toolpath::MoveSampling sampling, const Progress& progress);
    void improve(project::GridMethod method, Effort effort, const Progress& progress);
    void add_weight(const Progress& progress);
    void add_path(toolpath::MoveSampling sampling, const Progress& progress);
    void add_program_of_chosen(const Progress& progress);
    void drop_program();
    void hold(project::GridMethod method, Held found);
    void hold(HeldPath found);

    [[nodiscard]] const Held& held(project::GridMethod method) const {
        return now_.held[static_cast<std::size_t>(method)];
    }
    [[nodiscard]] const project::Project& project() const { return now_.source->project; }
    [[nodiscard]] const project::GridInput& input() const { return project().grid; }
    [[nodiscard]] const Workpiece& workpiece() const { return *now_.plan.workpiece; }

    State now_;
    HeldGrids before_; ///< the last ones that there were: a first guess for what has changed
};

} // namespace millwright::plan
