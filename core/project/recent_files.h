// The projects opened before, kept in a small file of the user's.
#pragma once

#include <cstddef>
#include <filesystem>
#include <vector>

namespace millwright::project {

/// Newest first, absolute, each once.
using RecentFiles = std::vector<std::filesystem::path>;
inline constexpr std::size_t most_recent_files = 10;

/// `files` with `opened` in front.
[[nodiscard]] RecentFiles with_recent(RecentFiles files, const std::filesystem::path& opened);

/// Empty if there is no such file. Throws Error with its place if it is broken.
[[nodiscard]] RecentFiles read_recent(const std::filesystem::path& file);

/// Makes its folder where missing. Throws Error if it cannot be written.
void write_recent(const RecentFiles& files, const std::filesystem::path& file);

/// $XDG_STATE_HOME/millwright/recent.json, by default in ~/.local/state; empty if there is no home.
[[nodiscard]] std::filesystem::path recent_files_place();

/// The folder jobs beside it: what machines did, whoever told them to and from where. `jobs` in the working
/// folder if there is no home.
[[nodiscard]] std::filesystem::path job_logs_place();

} // namespace millwright::project
