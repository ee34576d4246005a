// Refused lines of a file that was sent to a PMAC, as a person finds them in it.
#pragma once

#include "core/pmac/driver/pmac_file.h"

#include <string>
#include <string_view>

namespace millwright::pmac {

/// What the card `said` to the lines of `file`, each refusal behind the number of its line, and that behind
/// `before`: "line ", or a path and a colon.
[[nodiscard]] std::string
with_line_numbers(const std::string& said, const PmacFile& file, std::string_view before);

} // namespace millwright::pmac
