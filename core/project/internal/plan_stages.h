// The stages of a plan as a person who edits wants them: what is still true is kept, what is stale comes
// first coarse and then exact.
#pragma once

#include "core/base/error.h"
#include "core/project/plan.h"

#include <array>
#include <filesystem>
#include <functional>
#include <optional>

namespace millwright::project {

/// Remembers the last plan. Used by one thread at a time.
class PlanStages {
public:
    /// What is there by now; `failure` says why there will be no more.
    using Publish =
        std::function<void(const Plan& plan, const std::optional<Diagnostic>& failure, bool exact)>;

    /// Publishes one or several times. Throws Cancelled only.
    void
    derive(const Project& project, const Folders& folders, const Publish& publish, const Progress& progress);

private:
    /// A grid's evaluation and whether it is as for a report.
    struct Held {
        std::shared_ptr<const Evaluation> evaluation;
        bool exact = false;
    };
    /// What the last plan was made from.
    struct Source {
        Project project;
        Folders folders;
        std::filesystem::file_time_type machine_written;
    };

    void begin(const Project& project, const Folders& folders);
    void coarse(const Publish& publish, const Progress& progress);
    void exact(const Publish& publish, const Progress& progress);
    void carry_over(GridMethod method, const Progress& progress);
    void measure_uniform(int samples, const Progress& progress);
    void improve(GridMethod method, Effort effort, const Progress& progress);
    void add_program_of_chosen(const Progress& progress);

    [[nodiscard]] Held& held(GridMethod method) { return held_[static_cast<std::size_t>(method)]; }
    [[nodiscard]] const GridInput& input() const { return source_->project.grid; }
    [[nodiscard]] bool exactly(GridMethod method) { return held(method).exact; }
    void hold(GridMethod method, Evaluation evaluation, bool exact);

    std::optional<Source> source_;
    Plan plan_;
    std::array<Held, 3> held_;
    std::array<Held, 3> before_;                   ///< of a plan that is stale: their grids are a first guess
    std::shared_ptr<const Evaluation> program_of_; ///< the evaluation that the program was made from
};

} // namespace millwright::project
