// Which programs have a terminal open, as far as Linux shows it (/proc) to whoever asks.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

namespace millwright::links::internal {

/// "grbl-sender (process 4711)" of those that hold the far end of pseudo-terminal `near_end`, /dev/pts/7.
/// Empty where there is none that this user may look into.
[[nodiscard]] std::vector<std::string> holders_of_far_end(const std::filesystem::path& near_end);

/// The same of those that have the serial port or near end `port` open, but for this program and those that
/// hold its far end.
[[nodiscard]] std::vector<std::string> others_with(const std::filesystem::path& port);

} // namespace millwright::links::internal
