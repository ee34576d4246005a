#include "core/gcode/internal/variables.h"

#include "core/base/numbers.h"
#include "core/gcode/internal/refusal.h"

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

/// What the control keeps from before: where its probe last tripped, G28, G30, G92, offsets and rotations of
/// nine systems.
bool is_stored_by_control(int number) {
    constexpr int members = 10;
    const auto is_among = [number](int first, int count) {
        return number >= first && number < first + count;
    };
    if (is_among(parameter_probe, static_cast<int>(axis_count)) || number == parameter_probe_result ||
        is_among(parameter_g28, static_cast<int>(axis_count)) ||
        is_among(parameter_g30, static_cast<int>(axis_count)) || is_among(parameter_g92_active, members)) {
        return true;
    }
    for (int system = 1; system <= 9; ++system) {
        if (is_among(parameter_g5x(system), members)) {
            return true;
        }
    }
    return false;
}

/// Of #<_x> to #<_w> and #<_abs_x> to #<_abs_c>; axes 0: of no position.
ParameterRead position_named(std::string_view name, int column) {
    for (const std::string_view front : {"_abs_", "_"}) {
        if (name.size() == front.size() + 1 && name.starts_with(front)) {
            const auto axis = std::string_view("xyzabcuvw").find(name.back()); // as axis_letters
            return {.column = column,
                    .axes = axis == std::string_view::npos ? AxisBits{} : static_cast<AxisBits>(1U << axis),
                    .on_machine = front.size() > 1};
        }
    }
    return {};
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
        refuse(column,
               fmt::format("#{} is not a parameter: numbers are 1 to {}", number, parameter_count - 1));
    }
    if (number >= first_position && number <= last_position) {
        if (state_->cutter.on()) {
            refuse(column, "the position cannot be read while cutter compensation is on");
        }
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
            return known;
        }
    }
    const NamedValues& values = is_global ? global_ : local_;
    const auto found = values.find(name);
    return found == values.end() ? std::nullopt : std::optional<double>(found->second);
}

void Variables::note_read(int number, int column) const {
    if (number >= first_position && number <= last_position) {
        reads_.push_back({.column = column, .axes = static_cast<AxisBits>(1U << (number - first_position))});
        return;
    }
    const bool of_tool = number >= first_of_tool && number <= last_of_tool;
    const bool unknown = of_tool ? ((state_->spindle_tool.unknown >> (number - first_of_tool)) & 1) != 0
                                 : is_stored_by_control(number) && !told_[static_cast<std::size_t>(number)];
    if (unknown) {
        reads_.push_back({.column = column, .unknown = number});
    }
}

void Variables::note_read(std::string_view name, int column) const {
    if (name == "_current_tool" || name == "_current_pocket") {
        return note_read(first_of_tool, column);
    }
    if (const ParameterRead read = position_named(name, column); read.axes != 0) {
        reads_.push_back(read);
    }
}

void Variables::check_settable(int number, int column) const {
    if (!is_number(number)) {
        refuse(column,
               fmt::format("#{} is not a parameter: numbers are 1 to {}", number, parameter_count - 1));
    }
    if (is_read_only(number)) {
        refuse(column, fmt::format("#{} is read-only", number));
    }
}

void Variables::check_settable(std::string_view name, int column) const {
    if (name.empty()) {
        refuse(column, "the parameter name is empty");
    }
    if (predefined_value(name, *state_, program)) {
        refuse(column, fmt::format("#<{}> is read-only", name));
    }
    if (global_.size() + local_.size() >= most_names) {
        refuse(column, fmt::format("a program may have at most {} named parameters", most_names));
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

AxisBits Variables::axes_set(int first) const {
    AxisBits axes = 0;
    for (std::size_t n = 0; n < axis_count; ++n) {
        axes |= told_[static_cast<std::size_t>(first) + n] ? static_cast<AxisBits>(1U << n) : AxisBits{};
    }
    return axes;
}

AxisBits Variables::known_in_system(int system) const {
    constexpr AxisBits in_turned_plane = 0b11;
    const int first = parameter_g5x(system);
    const int rotation = first + static_cast<int>(axis_count);
    const AxisBits axes = axes_set(first);
    const bool both = (axes & in_turned_plane) == in_turned_plane;
    const bool in_plane = is_set(rotation) && (both || exactly_equal(stored(rotation), 0.0));
    return in_plane ? axes : static_cast<AxisBits>(axes & ~in_turned_plane);
}

void Variables::set_axes(int first, const AxisValues& values, AxisBits changed, AxisBits known) {
    for (std::size_t n = 0; n < axis_count; ++n) {
        const std::size_t number = static_cast<std::size_t>(first) + n;
        values_[number] = values[n];
        told_[number] = ((changed >> n) & 1U) != 0 ? ((known >> n) & 1U) != 0 : told_[number];
    }
}

} // namespace millwright::gcode::internal
