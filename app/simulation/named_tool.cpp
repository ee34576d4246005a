#include "app/simulation/named_tool.h"

#include "app/command_line/option_values.h"
#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <map>
#include <string_view>
#include <system_error>

namespace millwright::app {

namespace {

template <class Number> std::optional<Number> number_in(std::string_view text) {
    Number value{};
    const auto [end, failure] = std::from_chars(text.data(), text.data() + text.size(), value);
    const bool whole = !text.empty() && failure == std::errc{} && end == text.data() + text.size();
    return whole ? std::optional(value) : std::nullopt;
}

struct FluteLength {
    std::optional<int> number; ///< of the tool; nullopt: of all
    double length = 0.0;
};

FluteLength flute_length(const std::string& text) {
    const std::size_t equals = text.find('=');
    const bool numbered = equals != std::string::npos;
    const auto length = number_in<double>(std::string_view(text).substr(numbered ? equals + 1 : 0));
    const auto number = numbered ? number_in<int>(std::string_view(text).substr(0, equals)) : std::nullopt;
    if (!length || !(*length > 0.0 && *length < 1e6) || (numbered && !number)) {
        throw UsageError(fmt::format("\"{}\" is no flute length", printable(text)),
                         {},
                         "write --flutes 20, or --flutes 3=20 for tool 3, in mm");
    }
    return {number, *length};
}

/// By the number of the tool.
std::map<std::optional<int>, double> flute_lengths(const std::vector<std::string>& texts) {
    std::map<std::optional<int>, double> lengths;
    for (const std::string& text : texts) {
        const FluteLength flutes = flute_length(text);
        const auto [known, is_new] = lengths.emplace(flutes.number, flutes.length);
        if (!is_new) {
            const std::string whose =
                flutes.number ? fmt::format("tool {} has", *flutes.number) : "all tools have";
            throw UsageError(
                fmt::format("{} two flute lengths, {:g} mm and {:g} mm", whose, known->second, flutes.length),
                {},
                "give one --flutes for all tools, or one for each tool, such as --flutes 3=20");
        }
    }
    return lengths;
}

void divide(NamedTool& tool, double flutes) {
    toolpath::ProfileShape cutting = tool.body.shape();
    if (flutes >= cutting.top) {
        return;
    }
    if (flutes < tool.body.flank_end() || flutes <= cutting.bottom) {
        throw UsageError(
            fmt::format("flutes of {:g} mm end below the flank of the cutter, which ends at {:g} mm",
                        flutes,
                        tool.body.flank_end()));
    }
    tool.shank = toolpath::Profile(
        {.flat = cutting.radius, .radius = cutting.radius, .bottom = flutes, .top = cutting.top});
    cutting.top = flutes;
    tool.body = toolpath::Profile(cutting);
}

} // namespace

void expect_different_numbers(const std::vector<NamedTool>& tools) {
    for (std::size_t n = 1; n < tools.size(); ++n) {
        const auto end = tools.begin() + static_cast<std::ptrdiff_t>(n);
        if (tools[n].number && std::any_of(tools.begin(), end, [&](const NamedTool& earlier) {
                return earlier.number == tools[n].number;
            })) {
            throw UsageError(
                fmt::format("tool {} is named twice", *tools[n].number), {}, "name each tool once");
        }
    }
}

void take_flutes(const std::vector<std::string>& texts, std::vector<NamedTool>& tools) {
    const auto lengths = flute_lengths(texts);
    for (const auto& [number, length] : lengths) {
        if (number && std::ranges::find(tools, number, &NamedTool::number) == tools.end()) {
            throw UsageError(
                fmt::format("--flutes {}={:g}: no tool of that number is named", *number, length));
        }
    }
    for (NamedTool& tool : tools) {
        const auto own = tool.number ? lengths.find(tool.number) : lengths.end();
        const auto flutes = own != lengths.end() ? own : lengths.find(std::nullopt);
        if (flutes != lengths.end()) {
            divide(tool, flutes->second);
        }
    }
}

} // namespace millwright::app
