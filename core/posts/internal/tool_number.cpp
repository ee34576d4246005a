#include "core/posts/internal/tool_number.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <charconv>

namespace millwright::posts::internal {

namespace {

/// The number of the tool that a block asks the operator for: a pause with "change to tool 3" or "put in tool
/// 3", the comment "tool 3" of a plot; 0: it asks for none.
int tool_asked_for(const program::Block& block) {
    const bool pauses = block.kind == program::BlockKind::pause;
    std::string_view text = block.text;
    for (const std::string_view words : {"change to tool ", "put in tool ", "tool "}) {
        const bool of_comment = words == "tool ";
        const bool applies = of_comment ? block.kind == program::BlockKind::comment : pauses;
        if (applies && text.starts_with(words)) {
            text.remove_prefix(words.size());
            int number = 0;
            const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
            return read.ec == std::errc() && read.ptr == text.data() + text.size() ? number : 0;
        }
    }
    return 0;
}

} // namespace

int tool_number(const program::Program& program, std::string_view control) {
    if (program.tool) {
        return program.tool->number;
    }
    int number = 0;
    for (const program::Block& block : program.blocks) {
        const int tool = tool_asked_for(block);
        if (tool > 0 && number > 0 && tool != number) {
            throw Error(
                fmt::format("the program uses tools {} and {}, but a program for {} calls one tool only",
                            number,
                            tool,
                            control),
                {},
                "divide the program at its tool changes");
        }
        number = tool > 0 ? tool : number;
    }
    return number > 0 ? number : 1;
}

} // namespace millwright::posts::internal
