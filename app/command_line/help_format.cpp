#include "app/command_line/help_format.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <optional>
#include <regex>
#include <set>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::app {

namespace {

std::string plain_name(const std::string& type) {
    constexpr std::string_view of_checked_text = "TEXT:"; // what the check asks for comes behind it
    if (type.starts_with(of_checked_text)) {
        return type.substr(of_checked_text.size());
    }
    return type == "FLOAT" ? "NUMBER" : type == "INT" || type == "UINT" ? "N" : type;
}

std::optional<double> number_in(const std::string& text) {
    double value = 0.0;
    const auto read = std::from_chars(text.data(), text.data() + text.size(), value);
    return read.ec == std::errc{} ? std::optional(value) : std::nullopt;
}

/// Of text that is no number it is not known.
bool is_between(const std::string& text, double least, double most) {
    const auto value = number_in(text);
    return !value || (*value >= least && *value <= most);
}

/// "1,2" of "[1,2]".
std::string plain_default(const std::string& value) {
    return value.starts_with('[') && value.ends_with(']') ? value.substr(1, value.size() - 2) : value;
}

/// A default that says something: no empty text, no empty list, no number in place of a name, and none beyond
/// the range, as the value for "not given" is.
bool is_told(const std::string& value, const ValueText& of) {
    if (value.empty() || value == "[]" || value == "\"\"") {
        return false;
    }
    if (of.name.find('|') != std::string::npos && number_in(value)) {
        return ("|" + of.name + "|").find("|" + value + "|") != std::string::npos;
    }
    return !of.least || !of.most || is_between(value, *of.least, *of.most);
}

std::string names_of(const std::set<CLI::Option*>& options) {
    std::vector<std::string> names;
    for (const CLI::Option* const option : options) {
        names.push_back(option->get_name());
    }
    std::sort(names.begin(), names.end());
    std::string text;
    for (const std::string& name : names) {
        text += (text.empty() ? "" : ", ") + name;
    }
    return text;
}

/// What a text of an option is, where that is not said with it.
std::string named_text(const CLI::Option& option) {
    const std::string name = option.get_lnames().empty() ? std::string() : option.get_lnames().front();
    if (name == "machine") {
        return option.get_description().find("file") == std::string::npos ? "NAME" : "NAME|FILE";
    }
    static const std::map<std::string, std::string> kinds{
        {"out", "FILE"}, {"surface", "NAME"}, {"tool", "TOOL"}, {"format", "FORMAT"}, {"unit", "UNIT"}};
    const auto kind = kinds.find(name);
    return kind == kinds.end() ? "TEXT" : kind->second;
}

} // namespace

ValueText value_text(const std::string& type) {
    static const std::regex ranged(R"(([^:]*):\w+ in \[(\S+) - ([^\]]+)\])");
    static const std::regex listed(R"([^:]*:\{(.*)\})");
    std::smatch found;
    if (std::regex_match(type, found, ranged)) {
        return {plain_name(found[1]),
                fmt::format("{} to {}", found[2].str(), found[3].str()),
                number_in(found[2].str()),
                number_in(found[3].str())};
    }
    if (std::regex_match(type, found, listed)) {
        std::string names = found[1];
        std::replace(names.begin(), names.end(), ',', '|');
        return {names, {}};
    }
    return {plain_name(type), {}};
}

std::string HelpFormat::make_option_opts(const CLI::Option* option) const {
    if (option->get_type_size() == 0) { // a flag
        return {};
    }
    ValueText value = value_text(option->get_type_name());
    const bool is_named = option->get_positional() && value.name == "TEXT"; // by its own name
    value.name = value.name == "TEXT" ? named_text(*option) : value.name;
    std::string text = value.name.empty() || is_named ? std::string() : " " + value.name;
    const bool names_all = value.name.find(',') != std::string::npos; // of a list: X,Y,Z
    if (option->get_expected_max() == CLI::detail::expected_max_vector_size && !names_all) {
        text += " ...";
    }
    std::vector<std::string> remarks;
    if (!value.range.empty()) {
        remarks.push_back(value.range);
    }
    if (option->get_required()) {
        remarks.emplace_back("required");
    } else if (is_told(option->get_default_str(), value)) {
        remarks.push_back("default " + plain_default(option->get_default_str()));
    }
    if (!option->get_envname().empty()) {
        remarks.push_back("else $" + option->get_envname());
    }
    if (!option->get_needs().empty()) {
        remarks.push_back("with " + names_of(option->get_needs()));
    }
    if (!option->get_excludes().empty()) {
        remarks.push_back("not with " + names_of(option->get_excludes()));
    }
    std::string all;
    for (const std::string& remark : remarks) {
        all += (all.empty() ? "" : "; ") + remark;
    }
    return all.empty() ? text : fmt::format("{} ({})", text, all);
}

std::string HelpFormat::make_option_usage(const CLI::Option* option) const {
    const bool many = option->get_expected_max() >= CLI::detail::expected_max_vector_size;
    const bool several = !many && option->get_items_expected_max() > 1;
    const std::string name = several && option->get_type_name().find(' ') != std::string::npos
                                 ? option->get_type_name()
                                 : make_option_name(option, true) + (many ? "..." : "");
    return option->get_required() ? name : "[" + name + "]";
}

} // namespace millwright::app
