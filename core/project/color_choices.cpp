#include "core/project/color_choices.h"

#include "core/base/files.h"
#include "core/base/json.h"
#include "core/project/internal/json_text.h"

#include <nlohmann/json.hpp>

#include <system_error>

namespace millwright::project {

ColorChoices read_colors(const std::filesystem::path& file) {
    std::error_code failure;
    if (!std::filesystem::exists(file, failure)) {
        return {};
    }
    ColorChoices colors;
    for (const JsonValue& entry : JsonValue::read(file).items()) {
        entry.expect_only({"layer", "color"});
        colors[entry.at("layer").text()] = entry.at("color").text();
    }
    return colors;
}

void write_colors(const ColorChoices& colors, const std::filesystem::path& file) {
    auto json = nlohmann::ordered_json::array();
    for (const auto& [layer, color] : colors) {
        json.push_back({{"layer", layer}, {"color", color}});
    }
    make_folder(file.parent_path());
    write_file(file, json_text(json));
}

} // namespace millwright::project
