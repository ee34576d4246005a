// A large answer in JSON, printed member by member: text as of nlohmann's dump(2), and no more of it in
// memory than one member, or one element of an array.
#pragma once

#include <nlohmann/json_fwd.hpp>

#include <cstdio>
#include <string_view>

namespace millwright::app {

class JsonMembers {
public:
    explicit JsonMembers(std::FILE* out) : out_(out) {}

    void add(std::string_view name, const nlohmann::ordered_json& value);
    /// An array of what `element` makes of each of `range`.
    template <class Range, class Element>
    void add_each(std::string_view name, const Range& range, const Element& element) {
        begin_array(name);
        for (const auto& value : range) {
            add_element(element(value));
        }
        end_array();
    }
    /// Nothing comes behind it.
    void end();

private:
    void begin_member(std::string_view name);
    void begin_array(std::string_view name);
    void add_element(const nlohmann::ordered_json& value);
    void end_array();
    /// With the lines behind the first one as far in as its own.
    void print(const nlohmann::ordered_json& value, int indent);

    std::FILE* out_;
    bool has_members_ = false;
    bool has_elements_ = false;
};

} // namespace millwright::app
