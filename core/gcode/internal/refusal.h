// How a line is refused from anywhere inside the reader.
#pragma once

#include <string>
#include <utility>

namespace millwright::gcode::internal {

/// The line being executed breaks a rule. Thrown, and caught where lines are executed.
struct Refusal {
    int column = 1; ///< from 1
    std::string rule;
    std::string hint;
};

[[noreturn]] inline void refuse(int column, std::string rule, std::string hint = {}) {
    throw Refusal{column, std::move(rule), std::move(hint)};
}

} // namespace millwright::gcode::internal
