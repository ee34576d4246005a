#include "core/plan/named_tool.h"

#include "core/base/error.h"
#include "core/project/tool_file.h"
#include "core/project/tool_settings.h"
#include "core/simulation/spec_text.h"

#include <fmt/format.h>

namespace millwright::plan {

NamedTool named_tool(const std::string& text,
                     const kinematics::MachineModel& machine,
                     std::vector<std::string>& warnings) {
    simulation::ToolText parsed = simulation::parse_tool(text);
    if (parsed.body) {
        if (machine.swings_tool()) {
            warnings.push_back(fmt::format(
                "{}: the head tilts the tool, whose gauge length is taken from the machine file; name a "
                "tool file for another one",
                printable(text)));
        }
        return {parsed.number, *parsed.body, text};
    }
    const project::ToolInput input = project::read_tool(parsed.file);
    const toolpath::Tool tool = project::tool_of(input);
    if (!tool.cutter) {
        throw Error("the tool is a point, which removes nothing", parsed.file, "give it a cutter");
    }
    return {parsed.number,
            *tool.cutter,
            project::tool_text(input),
            std::make_shared<const kinematics::MachineModel>(project::machine_with(input, machine)),
            std::nullopt,
            tool.holder,
            input};
}

} // namespace millwright::plan
