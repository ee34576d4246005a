#include "core/gcode/parameter_file.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/gcode/internal/variables.h"
#include "core/gcode/program_text.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <set>
#include <string>

namespace millwright::gcode {

namespace {

constexpr double largest_parameter = 1e9; // as the words of a program

void skip_blanks_of(std::string_view& text) {
    text.remove_prefix(std::min(text.find_first_not_of(" \t"), text.size()));
}

template <class Number> bool parse_next(std::string_view& text, Number& number) {
    const auto read = std::from_chars(text.data(), text.data() + text.size(), number);
    text.remove_prefix(static_cast<std::size_t>(read.ptr - text.data()));
    return read.ec == std::errc{};
}

} // namespace

Parameters parse_parameter_file(std::string_view text, const std::filesystem::path& file) {
    Parameters parameters;
    std::set<int> seen;
    refuse_wide_text(text, file);
    text = program_text(text);
    for (int line = 1; !text.empty(); ++line) {
        std::string_view rest = text.substr(0, end_of_line(text));
        text.remove_prefix(next_line(text, 0));
        skip_blanks_of(rest);
        if (rest.empty()) {
            continue;
        }
        const auto refuse = [&](std::string message) {
            throw Error(Diagnostic{{file, line, 0, -1}, std::move(message), {}});
        };
        int number = 0;
        double value = 0.0;
        const bool has_number = parse_next(rest, number);
        skip_blanks_of(rest);
        const bool has_value = has_number && parse_next(rest, value);
        skip_blanks_of(rest);
        if (!has_value || !rest.empty() || !(std::abs(value) <= largest_parameter)) {
            refuse("a line must have a parameter number and a value");
        }
        if (!internal::Variables::is_number(number)) {
            refuse(fmt::format(
                "#{} is not a parameter: numbers are 1 to {}", number, internal::parameter_count - 1));
        }
        if (!seen.insert(number).second) {
            refuse(fmt::format("#{} is given twice", number));
        }
        if (!internal::Variables::is_read_only(number)) {
            parameters.emplace_back(number, value);
        }
    }
    return parameters;
}

Parameters read_parameter_file(const std::filesystem::path& file) {
    return parse_parameter_file(read_file(file, largest_parameter_file), file);
}

} // namespace millwright::gcode
