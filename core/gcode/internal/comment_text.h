// Comments that every RS-274 reader takes for comments.
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace millwright::gcode::internal {

/// `text` as one or more lines `(...)`: printable ASCII only, brackets for parentheses, at most 100 columns,
/// and never one of LinuxCNC's comments that do something (MSG, DEBUG, LOG ...).
[[nodiscard]] std::vector<std::string> comment_lines(std::string_view text);

} // namespace millwright::gcode::internal
