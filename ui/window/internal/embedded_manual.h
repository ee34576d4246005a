// Pages of the folder docs/, put into the program when it is built.
#pragma once

#include <string_view>

namespace millwright::panels {

/// The text of a page, by its path in docs/; empty if there is none of that name.
[[nodiscard]] std::string_view embedded_page(std::string_view file);

} // namespace millwright::panels
