#include "core/project/window_settings.h"

#include "core/base/files.h"
#include "core/base/json.h"
#include "core/project/internal/json_text.h"

#include <nlohmann/json.hpp>

#include <system_error>

namespace millwright::project {

namespace fs = std::filesystem;

WindowSettings read_window_settings(const fs::path& file) {
    std::error_code failure;
    if (file.empty() || !fs::exists(file, failure)) {
        return {};
    }
    WindowSettings settings;
    for (const JsonValue& entry : JsonValue::read(file).items()) {
        entry.expect_only({"name", "value"});
        settings[entry.at("name").text()] = entry.at("value").text();
    }
    return settings;
}

void write_window_settings(const WindowSettings& settings, const fs::path& file) {
    auto json = nlohmann::ordered_json::array();
    for (const auto& [name, value] : settings) {
        json.push_back({{"name", name}, {"value", value}});
    }
    make_folder(file.parent_path());
    write_file(file, json_text(json));
}

fs::path window_settings_place(const fs::path& recent_files) {
    return recent_files.empty() ? fs::path() : recent_files.parent_path() / "window.json";
}

} // namespace millwright::project
