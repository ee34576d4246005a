#include "core/gcode_programs/tool_calls.h"

#include "core/base/error.h"

#include <fmt/format.h>

namespace millwright::gcode {

void ToolCallRecorder::move(const Move& move, const SourceLine& now) {
    builder_.move(move, now);
}

void ToolCallRecorder::curve(const Curve& curve, const SourceLine& now) {
    builder_.curve(curve, now);
}

void ToolCallRecorder::command(const Command& command, const SourceLine& now) {
    builder_.command(command, now);
    if (command.kind == CommandKind::select_tool) {
        selections_.push_back({builder_.block_count(), command.index, command.source.line});
    } else if (command.kind == CommandKind::change_tool) {
        const int number = selections_.empty() ? 0 : selections_.back().number;
        changes_.push_back({builder_.block_count(), number, command.source.line, number == 0});
    }
}

std::vector<ToolCall> ToolCallRecorder::calls(const std::filesystem::path& file) const {
    if (!changes_.empty()) {
        return changes_;
    }
    if (selections_.empty()) {
        return {ToolCall{}};
    }
    const ToolCall& first = selections_.front();
    for (const ToolCall& other : selections_) {
        if (other.number != first.number) {
            throw Error(Diagnostic{
                {file, other.line, 0, -1},
                fmt::format("T{} is selected after T{}, and no M6 changes to it", other.number, first.number),
                "add M6 where the tool changes"});
        }
    }
    return {{0, first.number, first.line}};
}

} // namespace millwright::gcode
