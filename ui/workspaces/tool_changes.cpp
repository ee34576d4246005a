#include "ui/workspaces/tool_changes.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "ui/workspaces/machine_connection.h"
#include "ui/workspaces/manual_settings.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>

namespace millwright::actions {

namespace {

using drivers::ToolChangePlan;
using drivers::ToolChangeWay;

constexpr std::array<std::string_view, 3> way_names{"stop", "probe", "macro"};

constexpr std::array<double drivers::ToolSensor::*, 5> sensor_numbers{&drivers::ToolSensor::x,
                                                                      &drivers::ToolSensor::y,
                                                                      &drivers::ToolSensor::travel_z,
                                                                      &drivers::ToolSensor::deepest_z,
                                                                      &drivers::ToolSensor::feed};

/// Takes what stands before the next blank.
std::string_view take_word(std::string_view& text) {
    const std::string_view word = text.substr(0, text.find(' '));
    text.remove_prefix(std::min(word.size() + 1, text.size()));
    return word;
}

bool take_number(std::string_view& text, double& value) {
    const std::string_view word = take_word(text);
    const auto read = std::from_chars(word.data(), word.data() + word.size(), value);
    return read.ec == std::errc{} && read.ptr == word.data() + word.size() && std::isfinite(value);
}

} // namespace

ToolChangeSettings tool_change_settings(const ManualSettings& manual, const ConnectionView& machine) {
    const auto found = manual.tool_changes.find(machine.choice.address);
    return found == manual.tool_changes.end() ? ToolChangeSettings{} : found->second;
}

std::optional<ToolChangePlan> tool_change_plan(const ManualSettings& manual, const ConnectionView& machine) {
    if (!machine.connected() || !machine.can.program.tool_changes) {
        return std::nullopt;
    }
    const ToolChangeSettings settings = tool_change_settings(manual, machine);
    return settings.here ? std::optional(settings.plan) : std::nullopt;
}

void read_macro(jobs::Job& job) {
    if (job.tool_change && job.tool_change->way == ToolChangeWay::macro) {
        if (job.tool_change->macro_file.empty()) {
            throw Error("no file of lines for a tool change is selected", {}, "select it under Tool changes");
        }
        job.tool_change->macro = read_file(job.tool_change->macro_file);
    }
}

bool waits_for_tool(const drivers::DriverStatus& status) {
    return status.tool_change && status.tool_change->waits;
}

std::string to_text(const ToolChangeSettings& settings) {
    std::string text(settings.here ? "here" : "none");
    text += " " + std::string(way_names[static_cast<std::size_t>(settings.plan.way)]);
    text += " " + shortest(settings.plan.spin_up);
    for (const auto number : sensor_numbers) {
        text += " " + shortest(settings.plan.sensor.*number);
    }
    return text + " " + settings.plan.macro_file;
}

std::optional<ToolChangeSettings> tool_changes_of(std::string_view text) {
    ToolChangeSettings settings;
    const std::string_view where = take_word(text);
    const auto* const way = std::ranges::find(way_names, take_word(text));
    const bool known = where == "here" || where == "none";
    if (!known || way == way_names.end() || !take_number(text, settings.plan.spin_up) ||
        !(settings.plan.spin_up >= 0.0)) {
        return std::nullopt;
    }
    settings.here = where == "here";
    settings.plan.way = static_cast<ToolChangeWay>(way - way_names.begin());
    for (const auto number : sensor_numbers) {
        if (!take_number(text, settings.plan.sensor.*number)) {
            return std::nullopt;
        }
    }
    settings.plan.macro_file = std::string(text);
    return settings;
}

} // namespace millwright::actions
