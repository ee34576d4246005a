#include "core/project/internal/pair_file.h"

#include "core/base/files.h"
#include "core/base/json.h"
#include "core/project/json_text.h"

#include <nlohmann/json.hpp>

#include <system_error>

namespace millwright::project {

std::map<std::string, std::string> read_pairs(const std::filesystem::path& file, const PairNames& names) {
    std::error_code failure;
    if (file.empty() || !std::filesystem::exists(file, failure)) {
        return {};
    }
    std::map<std::string, std::string> pairs;
    for (const JsonValue& entry : JsonValue::read(file).items()) {
        entry.expect_only({names.name, names.value});
        pairs[entry.at(names.name).text()] = entry.at(names.value).text();
    }
    return pairs;
}

void write_pairs(const std::map<std::string, std::string>& pairs,
                 const std::filesystem::path& file,
                 const PairNames& names) {
    auto json = nlohmann::ordered_json::array();
    for (const auto& [name, value] : pairs) {
        json.push_back({{std::string(names.name), name}, {std::string(names.value), value}});
    }
    make_folder(file.parent_path());
    write_file(file, json_text(json));
}

} // namespace millwright::project
