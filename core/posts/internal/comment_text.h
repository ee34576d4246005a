// Comments that every reader takes for comments.
#pragma once

#include "core/posts/post_format.h"

#include <string>
#include <string_view>
#include <vector>

namespace millwright::posts::internal {

/// `text` as one or more lines, open and close around it: printable ASCII only, brackets for parentheses,
/// nothing that is forbidden, no line longer than allowed, and never one of LinuxCNC's comments that do
/// something (MSG, DEBUG, LOG ...).
[[nodiscard]] std::vector<std::string> comment_lines(std::string_view text, const CommentFormat& format = {});

} // namespace millwright::posts::internal
