#include "core/plan/plan.h"

#include "core/base/sentences.h"
#include "core/plan/internal/derivation.h"
#include "core/plan/skipped_comparisons.h"
#include "core/plan/strategy_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cstdint>

namespace millwright::plan {

namespace {

using project::GridMethod;

} // namespace

const std::shared_ptr<const Evaluation>& Plan::program_path(const project::Project& project) const {
    return has_own_path(project) ? path : grid(program_grid(project)).evaluation;
}

std::optional<double>& Plan::program_time(const project::Project& project) {
    return has_own_path(project) ? path_time : grid(program_grid(project)).estimated_time;
}

std::shared_ptr<const CutStudy> Plan::cut_of(const project::Project& project,
                                             const Evaluation* evaluation) const {
    if (evaluation == nullptr || evaluation == program_path(project).get()) {
        return evaluation == nullptr ? nullptr : cut;
    }
    const auto found = std::ranges::find(
        grids, evaluation, [](const GridResult& result) { return result.evaluation.get(); });
    return found == grids.end() ? nullptr : found->cut;
}

std::vector<std::string> memory_sentences(const project::Project& project, const Scope& scope) {
    constexpr std::int64_t many_nodes = 10'000;
    const std::int64_t nodes = std::int64_t{project.grid.nu} * project.grid.nv;
    std::vector<std::string> sentences;
    if (nodes < many_nodes) {
        return sentences;
    }
    for (const GridMethod method : project::every_grid_method) {
        const bool made =
            method == program_grid(project) || (scope.compared.grids && row_of(method).compared);
        const std::string sentence = !made || is_comparison_skipped(project, method)
                                         ? std::string()
                                         : memory_sentence(method, project.grid);
        if (!sentence.empty()) {
            sentences.push_back(with_full_stop(sentence));
        }
    }
    if (nodes > most_compared_nodes && scope.compared.grids) {
        constexpr double gigabytes_per_point = 3.9e-6; // `plan` of the dome with a million, nothing compared
        sentences.push_back(fmt::format("The path, program and motion of {} points need about {:.1f} GB.",
                                        nodes,
                                        gigabytes_per_point * static_cast<double>(nodes)));
    }
    return sentences;
}

Plan make_plan(const project::Project& project,
               const Folders& folders,
               const Progress& progress,
               const Scope& scope) {
    refuse_faults(project);
    expect_memory(program_grid(project), project.grid);
    return Derivation().finish(project, folders, scope, progress);
}

} // namespace millwright::plan
