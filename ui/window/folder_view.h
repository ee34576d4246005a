// What the dialog for files shows of a folder: the files of a kind with their size and date, and the places
// to begin from.
#pragma once

#include "ui/panels/panel.h"
#include "ui/window/file_prompt.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::panels {

struct FolderEntry {
    std::filesystem::path path;
    bool is_folder = false;
    std::uintmax_t bytes = 0;
    std::int64_t changed_s = -1; ///< since 1970-01-01 UTC; -1: not known
    std::string kind = {};       ///< of what is listed in a folder: "folder", or file_kind()
};

struct FolderListing {
    std::vector<FolderEntry> entries; ///< folders first, each by name
    std::string fault;                ///< why the folder cannot be read
};

/// Which files are listed. The first of each prompt: all that it can open.
struct FileFilter {
    std::string_view id;
    std::string_view label;
    bool (*lists)(const FilePromptRow& asked, const std::filesystem::path& file);
};
[[nodiscard]] std::span<const FileFilter> filters_of(actions::FilePrompt prompt);

/// Hidden files are left out.
[[nodiscard]] FolderListing
listed(const std::filesystem::path& folder, const FilePromptRow& asked, const FileFilter& filter);
/// Of a single file or folder; of one that is gone without size and date.
[[nodiscard]] FolderEntry entry_of(const std::filesystem::path& path);

/// "project", "G-code", "window settings" ...; empty for a file of no kind that is known. Looks into .json
/// files.
[[nodiscard]] std::string file_kind(const std::filesystem::path& file);
/// "812 bytes", "14 kB", "2.3 MB".
[[nodiscard]] std::string size_text(std::uintmax_t bytes);

/// A folder that people begin from.
struct FilePlace {
    std::string label;
    std::filesystem::path folder;
};
/// Those that are there, each folder once: home, the project's, the samples, where files were opened and
/// saved, drives that are plugged in.
[[nodiscard]] std::vector<FilePlace> places_of(const FrameState& now);

/// Where a prompt begins: where a file was last opened or saved for the same use, else the project's
/// folder.
[[nodiscard]] std::filesystem::path starting_folder(const FrameState& now, const FilePromptRow& asked);

} // namespace millwright::panels
