#include "app/command_line/given_options.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cctype>

namespace millwright::app {

std::string shell_word(std::string_view text) {
    const auto plain = [](unsigned char c) {
        return std::isalnum(c) != 0 ||
               std::string_view("-_./:,=@%+").find(static_cast<char>(c)) != std::string_view::npos;
    };
    if (!text.empty() && std::ranges::all_of(text, plain)) {
        return std::string(text);
    }
    const auto controls = [](unsigned char c) { return std::iscntrl(c) != 0; };
    if (std::ranges::any_of(text, controls)) { // which a terminal would obey
        std::string escaped = "$'";
        for (const char c : text) {
            escaped += controls(static_cast<unsigned char>(c))
                           ? fmt::format("\\x{:02x}", static_cast<unsigned char>(c))
                       : c == '\'' || c == '\\' ? std::string("\\") + c
                                                : std::string(1, c);
        }
        return escaped + "'";
    }
    std::string quoted = "'";
    for (const char c : text) {
        quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
    }
    return quoted + "'";
}

std::string given_options(const CLI::App& command, std::span<const std::string_view> left_out) {
    std::string words;
    for (const CLI::Option* option : command.get_options()) {
        const std::string name = option->get_name();
        if (option->count() == 0 || !name.starts_with("--") ||
            std::ranges::find(left_out, name) != left_out.end()) {
            continue;
        }
        words += words.empty() ? name : " " + name;
        if (option->get_expected_max() == 0) {
            continue; // a flag
        }
        std::string value;
        for (const std::string& part : option->results()) {
            value += (value.empty() ? "" : ",") + part;
        }
        words += " " + shell_word(value);
    }
    return words;
}

} // namespace millwright::app
