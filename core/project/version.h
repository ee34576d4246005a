// Which Millwright this is.
#pragma once

#include <string_view>

namespace millwright::project {

/// Like "0.1.0".
[[nodiscard]] std::string_view version();

} // namespace millwright::project
