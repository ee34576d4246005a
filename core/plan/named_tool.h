// A tool of a simulation, as a person names it. Lengths mm.
#pragma once

#include "core/kinematics/machine_model.h"
#include "core/project/tool_input.h"
#include "core/toolpath/profile.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::plan {

struct NamedTool {
    std::optional<int> number;
    toolpath::Profile body;
    std::string text;
    std::shared_ptr<const kinematics::MachineModel> machine{}; ///< with its gauge length; null: as it is
    std::optional<toolpath::Profile> shank{}, holder{};
    std::optional<project::ToolInput> input{}; ///< of a tool file
};

/// [N=]SPEC or [N=]FILE, as core/simulation/spec_text.h has it; a tool file is read. Throws Error. A warning
/// is a sentence.
[[nodiscard]] NamedTool named_tool(const std::string& text,
                                   const kinematics::MachineModel& machine,
                                   std::vector<std::string>& warnings);

} // namespace millwright::plan
