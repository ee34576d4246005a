#include "core/plan/skipped_comparisons.h"

#include "core/plan/strategy_path.h"
#include "core/project/grid_methods/grid_method_row.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <cstdint>
#include <string_view>
#include <vector>

namespace millwright::plan {

bool is_comparison_skipped(const project::Project& project, project::GridMethod method) {
    return row_of(method).compared && method != program_grid(project) &&
           std::int64_t{project.grid.nu} * project.grid.nv > most_compared_nodes;
}

std::string skipped_comparisons_sentence(const project::Project& project) {
    std::vector<std::string_view> names;
    for (const project::GridMethod method : project::every_grid_method) {
        if (is_comparison_skipped(project, method)) {
            names.push_back(row_of(method).label);
        }
    }
    return names.empty()
               ? std::string()
               : fmt::format("Not computed for comparison because {} x {} nodes are more than {},000: {}.",
                             project.grid.nu,
                             project.grid.nv,
                             most_compared_nodes / 1000,
                             fmt::join(names, ", "));
}

} // namespace millwright::plan
