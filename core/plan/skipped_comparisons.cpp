#include "core/plan/skipped_comparisons.h"

#include "core/plan/strategy_path.h"
#include "core/project/setting_tables.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cstdint>
#include <string_view>
#include <vector>

namespace millwright::plan {

bool is_comparison_skipped(const project::Project& project, project::GridMethod method) {
    return std::ranges::count(project::compared_methods, method) > 0 && method != program_grid(project) &&
           std::int64_t{project.grid.nu} * project.grid.nv > most_compared_nodes;
}

std::string skipped_comparisons_sentence(const project::Project& project) {
    std::vector<std::string_view> names;
    for (const project::GridMethod method : project::compared_methods) {
        if (is_comparison_skipped(project, method)) {
            names.push_back(project::row_of(project::grid_methods(), method).label);
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
