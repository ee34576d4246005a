// Parameters: #1 to #5601, #<named>, #<_global>, and those that tell what is in force.
#pragma once

#include "core/gcode/canon.h"
#include "core/gcode/modal_state.h"

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::gcode::internal {

using NamedValues = std::map<std::string, double, std::less<>>;

inline constexpr int parameter_count = 5602; ///< numbers are below it

/// The parameters of subroutine calls, #1 to #30.
inline constexpr int argument_count = 30;

inline constexpr AxisBits every_axis = (1U << axis_count) - 1;

// Numbers of parameters that the interpreter itself reads and writes (LinuxCNC's).
inline constexpr int parameter_probe = 5061;        ///< to 5069: where the probe tripped
inline constexpr int parameter_probe_result = 5070; ///< 1: it tripped
inline constexpr int parameter_g28 = 5161;          ///< to 5169
inline constexpr int parameter_g30 = 5181;          ///< to 5189
inline constexpr int parameter_g92_active = 5210;
inline constexpr int parameter_g92 = 5211; ///< to 5219
inline constexpr int parameter_system = 5220;
inline constexpr int parameter_input = 5399;
inline constexpr int parameter_debug = 5599;

/// The first of the nine offsets of coordinate system `system` (1 to 9); the tenth is its rotation.
[[nodiscard]] constexpr int parameter_g5x(int system) {
    return 5201 + 20 * system;
}

/// What named parameters tell about the program itself.
struct ProgramView {
    int line = 0;
    int call_level = 0;
    double return_value = 0.0;
    bool value_returned = false;
};

/// A parameter whose value depends on where the axes are, or on what the control has stored and the caller
/// has not given.
struct ParameterRead {
    int column = 1;
    int unknown = 0;         ///< the number of a stored one; 0: a position
    AxisBits axes = 0;       ///< of the position
    bool on_machine = false; ///< in machine coordinates
};

class Variables {
public:
    explicit Variables(const ModalState& state);

    [[nodiscard]] static bool is_number(int number) { return number >= 1 && number < parameter_count; }
    [[nodiscard]] static bool is_read_only(int number);

    /// Throws Refusal at `column` if there is no such parameter, or if it may not be read now.
    [[nodiscard]] double numbered(int number, int column) const;
    [[nodiscard]] std::optional<double> named(std::string_view name) const;
    /// What the program makes of the parameter at `column` depends on its value: remembers it for
    /// take_reads().
    void note_read(int number, int column) const;
    void note_read(std::string_view name, int column) const;

    /// Throws Refusal for a number or a name that cannot be set.
    void check_settable(int number, int column) const;
    void check_settable(std::string_view name, int column) const;
    /// Without any check.
    void set(int number, double value) {
        values_[static_cast<std::size_t>(number)] = value;
        told_[static_cast<std::size_t>(number)] = true;
    }
    void set(std::string_view name, double value);
    [[nodiscard]] double stored(int number) const { return values_[static_cast<std::size_t>(number)]; }

    /// The names of the subroutine being executed.
    [[nodiscard]] NamedValues& local_names() { return local_; }

    /// Nine values from `first` on.
    [[nodiscard]] AxisValues axes_from(int first) const;
    /// Sets nine; of the axes in `changed` the values count as known if they are in `known`.
    void set_axes(int first, const AxisValues& values, AxisBits changed, AxisBits known);
    /// Axes of the nine parameters from `first` on that were ever set, be it to 0.
    [[nodiscard]] AxisBits axes_set(int first) const;
    /// Whether it was ever set, be it to 0.
    [[nodiscard]] bool is_set(int number) const { return told_[static_cast<std::size_t>(number)]; }
    /// Axes whose position in coordinate system `system` (1 to 9) says where they are on the machine, but for
    /// G92: X and Y need its rotation, and of a turned one each other's offset.
    [[nodiscard]] AxisBits known_in_system(int system) const;

    /// Those noted since the last call.
    [[nodiscard]] std::vector<ParameterRead> take_reads() { return std::exchange(reads_, {}); }

    ProgramView program;

private:
    mutable std::vector<ParameterRead> reads_;
    const ModalState* state_;
    std::vector<double> values_;
    std::vector<bool> told_; ///< numbers that were set
    NamedValues global_;
    NamedValues local_;
};

/// The value of one of LinuxCNC's predefined names (without the signs < and >, in lower case).
[[nodiscard]] std::optional<double>
predefined_value(std::string_view name, const ModalState& state, const ProgramView& program);

} // namespace millwright::gcode::internal
