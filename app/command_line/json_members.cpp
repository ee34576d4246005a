#include "app/command_line/json_members.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <string>

namespace millwright::app {

void JsonMembers::add(std::string_view name, const nlohmann::ordered_json& value) {
    begin_member(name);
    print(value, 2);
}

void JsonMembers::end() {
    fmt::print(out_, "{}", has_members_ ? "\n}\n" : "{}\n");
}

void JsonMembers::begin_member(std::string_view name) {
    fmt::print(out_, "{}\n  {}: ", has_members_ ? "," : "{", nlohmann::json(name).dump());
    has_members_ = true;
}

void JsonMembers::begin_array(std::string_view name) {
    begin_member(name);
    fmt::print(out_, "[");
    has_elements_ = false;
}

void JsonMembers::add_element(const nlohmann::ordered_json& value) {
    fmt::print(out_, "{}\n    ", has_elements_ ? "," : "");
    print(value, 4);
    has_elements_ = true;
}

void JsonMembers::end_array() {
    fmt::print(out_, "{}]", has_elements_ ? "\n  " : "");
}

void JsonMembers::print(const nlohmann::ordered_json& value, int indent) {
    for (const char c : value.dump(2)) {
        std::fputc(c, out_);
        for (int n = 0; c == '\n' && n < indent; ++n) {
            std::fputc(' ', out_);
        }
    }
}

} // namespace millwright::app
