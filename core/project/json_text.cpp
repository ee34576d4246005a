#include "core/project/json_text.h"

#include "core/base/error.h"
#include "core/base/text.h"

#include <nlohmann/json.hpp>

#include <cmath>

namespace millwright::project {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::size_t longest_line = 100;

std::string scalar(const Json& value) {
    return value.is_number_float() ? shortest(value.get<double>()) : value.dump();
}

std::string key(const Json::const_iterator& entry) {
    return Json(entry.key()).dump() + ": ";
}

std::string on_one_line(const Json& value) {
    if (!value.is_structured()) {
        return scalar(value);
    }
    const char* const brackets = value.is_object() ? "{}" : "[]";
    std::string text;
    for (auto entry = value.begin(); entry != value.end(); ++entry) {
        text += text.empty() ? "" : ", ";
        text += (value.is_object() ? key(entry) : "") + on_one_line(*entry);
    }
    return brackets[0] + text + brackets[1];
}

void print(std::string& text, const Json& value, std::size_t indent, std::size_t column) {
    const std::string line = on_one_line(value);
    if (!value.is_structured() || (!value.is_object() && column + line.size() <= longest_line)) {
        text += line;
        return;
    }
    const char* const brackets = value.is_object() ? "{}" : "[]";
    constexpr std::size_t step = 4;
    const std::string margin(indent + step, ' ');
    text += brackets[0];
    for (auto entry = value.begin(); entry != value.end(); ++entry) {
        text += (entry == value.begin() ? "\n" : ",\n") + margin;
        const std::string name = value.is_object() ? key(entry) : std::string();
        text += name;
        print(text, *entry, indent + step, margin.size() + name.size());
    }
    text += "\n" + std::string(indent, ' ') + brackets[1];
}

} // namespace

std::string json_text(const Json& value) {
    try {
        std::string text;
        print(text, value, 0, 0);
        return text + "\n";
    } catch (const Json::type_error&) {
        throw Error("the text is not valid UTF-8");
    }
}

double rounded(double value) {
    constexpr double steps = 1e6;
    return std::round(value * steps) / steps;
}

nlohmann::ordered_json vector(const Vec3& p) {
    return nlohmann::ordered_json::array({rounded(p.x()), rounded(p.y()), rounded(p.z())});
}

} // namespace millwright::project
