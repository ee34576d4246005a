#include "core/project/window_settings.h"

#include "core/project/internal/pair_file.h"

namespace millwright::project {

namespace fs = std::filesystem;

namespace {

constexpr PairNames names_of_settings{"name", "value"};

} // namespace

WindowSettings read_window_settings(const fs::path& file) {
    return read_pairs(file, names_of_settings);
}

void write_window_settings(const WindowSettings& settings, const fs::path& file) {
    write_pairs(settings, file, names_of_settings);
}

fs::path window_settings_place(const fs::path& recent_files) {
    return recent_files.empty() ? fs::path() : recent_files.parent_path() / "window.json";
}

} // namespace millwright::project
