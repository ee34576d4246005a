// The tools that `millwright simulate` is given by name, and how long their flutes are. Lengths mm.
#pragma once

#include "core/kinematics/machine_model.h"
#include "core/toolpath/profile.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::app {

/// A tool that a person named.
struct NamedTool {
    std::optional<int> number;
    toolpath::Profile body;
    std::string text;
    std::shared_ptr<const kinematics::MachineModel> machine{}; ///< with its gauge length; null: as it is
    std::optional<toolpath::Profile> shank{}, holder{};
};

/// [N=]SPEC or [N=]FILE. Throws Error. A warning is a sentence.
[[nodiscard]] NamedTool named_tool(const std::string& text,
                                   const kinematics::MachineModel& machine,
                                   std::vector<std::string>& warnings);

/// Throws UsageError where two have the same number.
void expect_different_numbers(const std::vector<NamedTool>& tools);

/// Above its flutes a tool is shank, which does not cut. `texts`: [N=]LENGTH; a length for tool N wins over
/// one for all tools. Throws UsageError for two lengths of the same tool.
void take_flutes(const std::vector<std::string>& texts, std::vector<NamedTool>& tools);

} // namespace millwright::app
