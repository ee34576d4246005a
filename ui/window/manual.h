// The manual inside of the program: pages of docs/, as they are written, for the window of help.
#pragma once

#include "ui/widgets/reading.h"
#include "ui/workspaces/view_state.h"

#include <string_view>
#include <vector>

namespace millwright::panels {

/// What its Markdown says, without marks: pictures not at all, links by their words and the page that they
/// lead to, whose place is given from `folder`, that of this page; without one by their words alone.
[[nodiscard]] std::vector<widgets::ReadingBlock> reading_of(std::string_view markdown,
                                                            std::string_view folder = {});

/// The part of a page from the line `heading` ("## Files") to the next heading of its rank, without itself;
/// empty if it has none.
[[nodiscard]] std::string_view section_of(std::string_view markdown, std::string_view heading);

/// What the manual says of a workspace.
[[nodiscard]] std::vector<widgets::ReadingBlock> manual_of(actions::Workspace workspace);

/// The on-line commands of a PMAC.
[[nodiscard]] std::vector<widgets::ReadingBlock> manual_of_commands();

} // namespace millwright::panels
