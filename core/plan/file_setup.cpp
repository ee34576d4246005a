#include "core/plan/file_setup.h"

#include "core/base/error.h"
#include "core/plan/named_tool.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::plan {

namespace {

const std::string* text_of(const ToolTexts& tools, int number) {
    const auto text = tools.find(number);
    return text != tools.end() && !text->second.empty() ? &text->second : nullptr;
}

} // namespace

std::vector<gcode::ToolCall> called_tools(const OpenedProgram& opened) {
    std::vector<gcode::ToolCall> found;
    if (!opened.motion) {
        return found;
    }
    for (const gcode::ToolCall& call : opened.motion->tool_calls) {
        if (!call.empty && std::ranges::find(found, call.number, &gcode::ToolCall::number) == found.end()) {
            found.push_back(call);
        }
    }
    return found;
}

std::string suggested_stock(const OpenedProgram& opened) {
    if (!opened.motion || opened.motion->cut_box.isEmpty()) {
        return {};
    }
    const Box3& cut = opened.motion->cut_box;
    const Vec3 low = (cut.min().array().floor() - 1.0).matrix();
    Vec3 high = (cut.max().array().ceil() + 1.0).matrix();
    high.z() = std::ceil(cut.max().z());
    if (cut.min().z() < 0.0) {
        high.z() = std::max(high.z(), 0.0);
    }
    const Vec3 size = high - low;
    return fmt::format("box:{:.0f},{:.0f},{:.0f}@{:.0f},{:.0f},{:.0f}",
                       size.x(),
                       size.y(),
                       size.z(),
                       low.x() + 0.0,
                       low.y() + 0.0,
                       low.z() + 0.0);
}

std::optional<Diagnostic> missing_tool(const OpenedProgram& opened, const ToolTexts& tools) {
    for (const gcode::ToolCall& call : called_tools(opened)) {
        if (text_of(tools, call.number) == nullptr) {
            return Diagnostic{
                {{}, call.line, 0, -1},
                call.line > 0
                    ? fmt::format("the program calls tool {}, whose shape is not known", call.number)
                    : std::string("the program calls no tool, and none is chosen"),
                "enter its shape, such as flat:6"};
        }
    }
    return std::nullopt;
}

FileSetup file_setup(const OpenedProgram& opened, const ToolTexts& tools) {
    if (!opened.motion) {
        throw Error(opened.no_motion.empty() ? "the file is still being read" : opened.no_motion);
    }
    if (opened.motion->unsimulated) {
        throw Error(*opened.motion->unsimulated);
    }
    if (const auto missing = missing_tool(opened, tools)) {
        throw Error(*missing);
    }
    FileSetup setup{.machine = opened.machine, .tools = {}, .warnings = opened.unplaced};
    if (opened.start_notice) {
        setup.warnings.push_back(*opened.start_notice);
    }
    std::vector<std::string> sentences;
    for (const gcode::ToolCall& call : opened.motion->tool_calls) {
        if (call.empty) {
            setup.tools.push_back({call.first_block, 0, std::nullopt});
            continue;
        }
        const NamedTool tool = named_tool(*text_of(tools, call.number), *opened.machine, sentences);
        setup.tools.push_back({.first_block = call.first_block,
                               .number = call.number,
                               .body = tool.body,
                               .machine = tool.machine,
                               .shank = tool.shank,
                               .holder = tool.holder});
    }
    std::ranges::sort(sentences);
    sentences.erase(std::unique(sentences.begin(), sentences.end()), sentences.end());
    for (std::string& sentence : sentences) {
        setup.warnings.push_back({{}, std::move(sentence), {}});
    }
    return setup;
}

} // namespace millwright::plan
