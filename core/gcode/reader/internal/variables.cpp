#include "core/gcode/reader/internal/variables.h"

#include "core/gcode/reader/internal/refusal.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::gcode::internal {

namespace {

constexpr int first_position = 5420;
constexpr int last_position = 5428;
constexpr int first_of_tool = 5400;
constexpr int last_of_tool = 5413;

/// Names and values are kept for a program, and a program may be hostile.
constexpr std::size_t most_names = 100'000;

double of_tool(int number, const Tool& tool) {
    switch (number) {
    case first_of_tool:
        return tool.number;
    case 5410:
        return tool.diameter;
    case 5411:
        return tool.front_angle;
    case 5412:
        return tool.back_angle;
    case last_of_tool:
        return tool.orientation;
    default:
        return tool.offset[static_cast<std::size_t>(number - first_of_tool - 1)];
    }
}

} // namespace

namespace {

/// Of #<_x> to #<_w> and #<_abs_x> to #<_abs_c>.
AxisBits axis_of_position(std::string_view name) {
    for (const std::string_view front : {"_abs_", "_"}) {
        if (name.size() == front.size() + 1 && name.starts_with(front)) {
            const auto axis = std::string_view("xyzabcuvw").find(name.back()); // as axis_letters
            return axis == std::string_view::npos ? AxisBits{} : static_cast<AxisBits>(1U << axis);
        }
    }
    return 0;
}

} // namespace

Variables::Variables(const ModalState& state)
    : state_(&state), values_(parameter_count, 0.0), told_(parameter_count, false) {
    set(parameter_system, 1.0);
    set(parameter_debug, 1.0);
}

bool Variables::is_read_only(int number) {
    return (number >= first_of_tool && number <= last_of_tool) ||
           (number >= first_position && number <= last_position);
}

double Variables::numbered(int number, int column) const {
    if (!is_number(number)) {
        refuse(column, fmt::format("#{} is no parameter: numbers are 1 to {}", number, parameter_count - 1));
    }
    if (number >= first_position && number <= last_position) {
        if (state_->cutter.on()) {
            refuse(column, "the position cannot be read while cutter compensation is on");
        }
        positions_read_ |= static_cast<AxisBits>(1U << static_cast<unsigned>(number - first_position));
        return state_->position[static_cast<std::size_t>(number - first_position)];
    }
    if (number >= first_of_tool && number <= last_of_tool) {
        return of_tool(number, state_->spindle_tool);
    }
    return stored(number);
}

std::optional<double> Variables::named(std::string_view name) const {
    const bool is_global = !name.empty() && name.front() == '_';
    if (is_global) {
        if (const auto known = predefined_value(name, *state_, program)) {
            positions_read_ |= axis_of_position(name);
            return known;
        }
    }
    const NamedValues& values = is_global ? global_ : local_;
    const auto found = values.find(name);
    return found == values.end() ? std::nullopt : std::optional<double>(found->second);
}

void Variables::check_settable(int number, int column) const {
    if (!is_number(number)) {
        refuse(column, fmt::format("#{} is no parameter: numbers are 1 to {}", number, parameter_count - 1));
    }
    if (is_read_only(number)) {
        refuse(column, fmt::format("#{} can only be read", number));
    }
}

void Variables::check_settable(std::string_view name, int column) const {
    if (name.empty()) {
        refuse(column, "a parameter's name is empty");
    }
    if (predefined_value(name, *state_, program)) {
        refuse(column, fmt::format("#<{}> can only be read", name));
    }
    if (global_.size() + local_.size() >= most_names) {
        refuse(column, fmt::format("a program has at most {} named parameters", most_names));
    }
}

void Variables::set(std::string_view name, double value) {
    NamedValues& values = !name.empty() && name.front() == '_' ? global_ : local_;
    values.insert_or_assign(std::string(name), value);
}

AxisValues Variables::axes_from(int first) const {
    AxisValues values;
    for (std::size_t n = 0; n < axis_count; ++n) {
        values[n] = stored(first + static_cast<int>(n));
    }
    return values;
}

bool Variables::was_set(int first, int count) const {
    const auto begin = told_.begin() + first;
    return std::find(begin, begin + count, true) != begin + count;
}

bool Variables::knows_system(int system) const {
    constexpr int members = 10; // nine offsets and the rotation
    return was_set(parameter_g5x(system), members);
}

void Variables::set_axes(int first, const AxisValues& values) {
    for (std::size_t n = 0; n < axis_count; ++n) {
        set(first + static_cast<int>(n), values[n]);
    }
}

} // namespace millwright::gcode::internal
