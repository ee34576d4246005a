#include "ui/design_panels/no_gain_notes.h"

#include "core/plan/strategy_path.h"
#include "core/project/setting_tables.h"

#include <fmt/format.h>

namespace millwright::panels {

std::vector<std::string> no_gain_notes(const FrameState& now) {
    std::vector<std::string> notes;
    for (const project::GridMethod method : project::every_grid_method) {
        const auto found = now.evaluation(method);
        if (method != plan::program_grid(now.project) && found &&
            found->outcome.status == grid::OptimiserStatus::no_gain && !found->outcome.note.empty()) {
            notes.push_back(fmt::format("{}, same as uniform: {}",
                                        project::row_of(project::grid_methods(), method).label,
                                        found->outcome.note));
        }
    }
    return notes;
}

} // namespace millwright::panels
