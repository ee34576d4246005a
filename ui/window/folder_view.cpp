#include "ui/window/folder_view.h"

#include "core/project/imported_surface.h"
#include "core/project/json_kind.h"
#include "core/project/plot_input.h"
#include "ui/workspaces/processor_texts.h"

#include <fmt/format.h>
#include <sys/stat.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <system_error>
#include <utility>

namespace millwright::panels {

namespace fs = std::filesystem;

namespace {

using actions::FilePrompt;

bool of_prompt(const FilePromptRow& asked, const fs::path& file) {
    return is_listed(asked, file);
}

bool any_file(const FilePromptRow& /*asked*/, const fs::path& /*file*/) {
    return true;
}

template <bool (*is_kind)(const fs::path&)>
bool of_kind(const FilePromptRow& /*asked*/, const fs::path& file) {
    return is_kind(file);
}

bool is_drawing(const fs::path& file) {
    return project::is_plot_file(file) && !project::is_picture_file(file) && !is_gcode(file);
}

constexpr FileFilter all_files{"all", "All files", any_file};
constexpr std::array<FileFilter, 8> open_filters{
    {{"known", "All supported files", of_prompt},
     {"projects", "Projects (.json)", of_kind<project::is_project_json>},
     {"gcode", "G-code programs", of_kind<is_gcode>},
     {"surfaces", "Surfaces (STEP, IGES, STL, OBJ, PLY)", of_kind<project::opens_as_surface>},
     {"drawings", "Plots, paths and points", of_kind<is_drawing>},
     {"pictures", "Pictures", of_kind<project::is_picture_file>},
     {"processor", "Processor files", of_kind<actions::is_processor_file>},
     all_files}};
constexpr std::array<FileFilter, 2> other_filters{{{"known", "Files of this type", of_prompt}, all_files}};

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value == nullptr ? std::string() : std::string(value);
}

bool is_folder(const fs::path& path) {
    std::error_code missing;
    return !path.empty() && fs::is_directory(path, missing);
}

/// Folders that were made for drives: /media/USER/NAME, /run/media/USER/NAME.
std::vector<fs::path> plugged_drives() {
    std::vector<fs::path> found;
    const std::string user = environment("USER");
    for (const char* const root : {"/media", "/run/media"}) {
        std::error_code none;
        for (const auto& entry :
             fs::directory_iterator(user.empty() ? fs::path(root) : fs::path(root) / user, none)) {
            if (is_folder(entry.path())) {
                found.push_back(entry.path());
            }
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

} // namespace

std::span<const FileFilter> filters_of(FilePrompt prompt) {
    return prompt == FilePrompt::open ? std::span<const FileFilter>(open_filters)
                                      : std::span<const FileFilter>(other_filters);
}

FolderEntry entry_of(const fs::path& path) {
    FolderEntry entry{path, false, 0, -1};
    struct stat found {};
    if (::stat(path.c_str(), &found) == 0) {
        entry.is_folder = S_ISDIR(found.st_mode);
        entry.bytes = static_cast<std::uintmax_t>(std::max<off_t>(found.st_size, 0));
        entry.changed_s = found.st_mtime;
    }
    return entry;
}

FolderListing listed(const fs::path& folder, const FilePromptRow& asked, const FileFilter& filter) {
    FolderListing result;
    std::error_code failure;
    for (const auto& found : fs::directory_iterator(folder, failure)) {
        if (found.path().filename().string().starts_with('.')) {
            continue;
        }
        FolderEntry entry = entry_of(found.path());
        if (entry.is_folder || filter.lists(asked, entry.path)) {
            entry.kind = entry.is_folder ? "folder" : file_kind(entry.path);
            result.entries.push_back(std::move(entry));
        }
    }
    result.fault = failure ? "This folder cannot be read: " + failure.message() : std::string();
    std::sort(result.entries.begin(), result.entries.end(), [](const FolderEntry& a, const FolderEntry& b) {
        return std::pair(!a.is_folder, a.path) < std::pair(!b.is_folder, b.path);
    });
    return result;
}

std::string file_kind(const fs::path& file) {
    return is_gcode(file)                     ? "G-code"
           : project::opens_as_surface(file)  ? "surface"
           : project::is_picture_file(file)   ? "picture"
           : project::is_path_file(file)      ? "path file"
           : project::is_point_file(file)     ? "point file"
           : project::is_plot_file(file)      ? "plot"
           : actions::is_processor_file(file) ? "processor file"
                                              : std::string(project::json_kind(file));
}

std::string size_text(std::uintmax_t bytes) {
    constexpr double thousand = 1000.0;
    const auto size = static_cast<double>(bytes);
    if (size < thousand) {
        return fmt::format("{} bytes", bytes);
    }
    const std::array<std::pair<double, std::string_view>, 3> units{
        {{thousand, "kB"}, {thousand * thousand, "MB"}, {thousand * thousand * thousand, "GB"}}};
    for (const auto& [unit, name] : units) {
        if (size < 999.5 * unit || unit >= units.back().first) {
            return size < 9.95 * unit ? fmt::format("{:.1f} {}", size / unit, name)
                                      : fmt::format("{:.0f} {}", size / unit, name);
        }
    }
    return {};
}

std::vector<FilePlace> places_of(const FrameState& now) {
    std::vector<FilePlace> places;
    const auto add = [&](std::string label, const fs::path& folder) {
        std::error_code none;
        const auto same = [&](const FilePlace& place) { return fs::equivalent(place.folder, folder, none); };
        if (is_folder(folder) && std::ranges::none_of(places, same)) {
            places.push_back({std::move(label), fs::absolute(folder).lexically_normal()});
        }
    };
    add("Home", environment("HOME"));
    if (!now.document.file.empty()) {
        add("Project folder", fs::absolute(now.document.file).parent_path());
    }
    for (const auto& [use, folder] : now.view_state.folders) {
        add(folder.string(), folder);
    }
    std::error_code gone;
    add("Start folder of Millwright", fs::current_path(gone));
    add("Samples: projects", now.assets / "projects");
    add("Samples: programs, plots, pictures", now.assets / "samples");
    for (const fs::path& drive : plugged_drives()) {
        add("Drive " + drive.filename().string(), drive);
    }
    return places;
}

fs::path starting_folder(const FrameState& now, const FilePromptRow& asked) {
    const auto last = now.view_state.folders.find(std::string(use_of(asked.prompt)));
    if (asked.prompt == FilePrompt::save_as && !now.document.file.empty()) {
        return fs::absolute(now.document.file).parent_path();
    }
    if (last != now.view_state.folders.end() && is_folder(last->second)) {
        return last->second;
    }
    if (asked.prompt == FilePrompt::import_surface) { // which mostly comes from elsewhere
        const auto recent = std::ranges::find_if(now.recent, project::opens_as_surface);
        if (recent != now.recent.end() && is_folder(recent->parent_path())) {
            return recent->parent_path();
        }
    }
    std::error_code gone;
    return now.document.file.empty() ? fs::current_path(gone) : fs::absolute(now.document.file).parent_path();
}

} // namespace millwright::panels
