#include "core/plan/gouges.h"

#include "core/base/counted.h"
#include "core/base/text.h"
#include "core/plan/cut_remarks.h"

#include <fmt/format.h>

namespace millwright::plan {

namespace {

struct DeepestBite {
    const BlockBite* bite = nullptr; ///< null: none
    int blocks = 0;
};

DeepestBite deepest_of(const CutStudy& cut, bool by_holder) {
    DeepestBite found;
    for (const BlockBite& bite : cut.bites) {
        if (bite.by_holder == by_holder) {
            ++found.blocks;
            found.bite =
                found.bite == nullptr || bite.bite.depth > found.bite->bite.depth ? &bite : found.bite;
        }
    }
    return found;
}

std::string blocks_text(const DeepestBite& found) {
    const std::string blocks = counted(found.blocks, "block");
    return found.bite->line > 0 ? fmt::format("{}, the deepest in line {}", blocks, found.bite->line)
                                : blocks;
}

} // namespace

std::string gouge_text(const project::Project& project, const CutStudy& cut) {
    std::string text;
    if (const DeepestBite cutter = deepest_of(cut, false); cutter.bite != nullptr) {
        text = fmt::format("the cutter goes up to {} mm below the surface; the limit is {} mm ({})",
                           fixed(cutter.bite->bite.depth, 4),
                           shortest(project.tool.gouge_limit_mm),
                           blocks_text(cutter));
    }
    if (const DeepestBite holder = deepest_of(cut, true); holder.bite != nullptr) {
        text += fmt::format("{}the holder penetrates the part by up to {} mm ({})",
                            text.empty() ? "" : "; ",
                            fixed(holder.bite->bite.depth, 4),
                            blocks_text(holder));
    }
    return text.empty() ? text : text + "; " + checked_text(project);
}

} // namespace millwright::plan
