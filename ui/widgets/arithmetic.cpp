#include "ui/widgets/arithmetic.h"

#include "core/base/quiet_floats.h"
#include "core/base/text.h"

#include <fmt/format.h>
#include <muParser.h>

#include <cmath>

namespace millwright::widgets {

namespace {

constexpr std::size_t longest_text = 256; // keeps muParser's recursion on nested brackets shallow
constexpr double whole_within = 1e-9;     // 3*(1/3) is meant as 1

std::string_view trimmed(std::string_view text) {
    constexpr std::string_view blank = " \t\r\n";
    const auto first = text.find_first_not_of(blank);
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(blank) - first + 1);
}

std::string_view without_unit(std::string_view text, std::string_view unit) {
    return !unit.empty() && text.ends_with(unit) ? trimmed(text.substr(0, text.size() - unit.size())) : text;
}

Evaluated refused(std::string reason) {
    return {std::nullopt, std::move(reason)};
}

Evaluated finite(std::string_view text, double value) {
    if (!std::isfinite(value)) {
        return refused(fmt::format("The value of \"{}\" is not finite.", text));
    }
    return {value, {}};
}

/// A field that counts shows "of 12" in place of a unit.
std::string with_unit(double value, std::string_view unit) {
    return unit.empty() || unit.starts_with("of ") ? shortest(value)
                                                   : fmt::format("{} {}", shortest(value), unit);
}

std::string range_sentence(const FieldInfo& info) {
    if (!std::isfinite(info.max)) {
        return fmt::format("Must be at least {}.", with_unit(info.min, info.unit));
    }
    if (!std::isfinite(info.min)) {
        return fmt::format("Must be at most {}.", with_unit(info.max, info.unit));
    }
    return fmt::format("Must be from {} to {}.", shortest(info.min), with_unit(info.max, info.unit));
}

Evaluated in_range(Evaluated found, const FieldInfo& info) {
    const bool outside = found.value && (*found.value < info.min || *found.value > info.max);
    return outside ? refused(range_sentence(info)) : found;
}

} // namespace

Evaluated evaluate(std::string_view text, std::string_view unit) {
    const std::string_view formula = without_unit(trimmed(text), unit);
    if (formula.empty()) {
        return refused("Enter a number.");
    }
    if (formula.size() > longest_text) {
        return refused("The expression is too long.");
    }
    const QuietFloats quiet;
    try {
        mu::Parser parser;
        parser.SetExpr(std::string(formula));
        int values = 0;
        const mu::value_type* results = parser.Eval(values);
        if (values != 1) {
            return refused("Use a decimal point, not a comma.");
        }
        return finite(formula, results[0]);
    } catch (const mu::Parser::exception_type&) {
        return refused(fmt::format("\"{}\" is not a number.", formula));
    }
}

Evaluated evaluate_number(std::string_view text, const FieldInfo& info) {
    return in_range(evaluate(text, info.unit), info);
}

Evaluated evaluate_integer(std::string_view text, const FieldInfo& info) {
    const Evaluated found = evaluate(text, info.unit);
    if (found.value && std::abs(*found.value - std::round(*found.value)) > whole_within) {
        return refused("Must be a whole number.");
    }
    return in_range(found.value ? Evaluated{std::round(*found.value), {}} : found, info);
}

} // namespace millwright::widgets
