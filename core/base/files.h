// Whole files in and out. A write either replaces the file completely or leaves the old one untouched.
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace millwright {

/// The bytes of `file`. Throws Error with the file and the system's reason.
[[nodiscard]] std::string read_file(const std::filesystem::path& file);

/// Writes beside `file` and renames over it, so that a failed write leaves the old file as it was. A symbolic
/// link keeps pointing: its target is replaced. Throws Error with the file and the system's reason.
void write_file(const std::filesystem::path& file, std::string_view bytes);

/// Makes `folder` and its parents where missing. Throws Error if it cannot be made or is not a folder.
void make_folder(const std::filesystem::path& folder);

} // namespace millwright
