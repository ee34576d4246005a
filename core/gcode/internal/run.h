// Everything that lives while a program is read.
#pragma once

#include "core/gcode/internal/block.h"
#include "core/gcode/internal/canon_queue.h"
#include "core/gcode/internal/source_files.h"
#include "core/gcode/internal/variables.h"
#include "core/gcode/modal_state.h"
#include "core/gcode/reader_settings.h"

#include <optional>
#include <vector>

namespace millwright::gcode::internal {

/// Control points gathered by G5.2.
struct NurbsBeingDefined {
    std::vector<ControlPoint> points;
    int order = 3;
};

/// M70 and M73.
struct SavedModes {
    ModalState state;
    bool g92_active = false;
    bool restore_on_return = false;
};

struct Run {
    Run(const ReaderSettings& with, CanonSink& sink)
        : settings(with), variables(state), tools(with.tools), out(sink, with.most_moves_of_a_line) {}
    Run(const Run&) = delete;
    Run& operator=(const Run&) = delete;
    ~Run() = default;

    const ReaderSettings& settings;
    ModalState state;
    Variables variables;
    ToolTable tools;
    CanonQueue out;
    NurbsBeingDefined nurbs;
    bool feed_override_enabled = true; ///< G76 enables it and says nothing of that to `state`, as in LinuxCNC
    bool after_spline = false;         ///< the last motion was G5
    std::optional<SavedModes> saved;   ///< of the subroutine being executed
    Vec2 compensated_begin = Vec2::Zero(); ///< where the waiting moves begin, in the plane
    bool compensated_begin_known = false;
    Vec2 flushed_to = Vec2::Zero(); ///< where the last compensated move that was sent ended, in the plane
    Bookmark line_begin;            ///< of the line being executed
    bool ended = false;             ///< by M2, M30, or M99 of the main program
    bool in_percents = false;       ///< the program began with %
    AxisBits g92_known = 0;         ///< axes whose G92 offset in force is known

    /// Axes of which it is known how the active system lies on the machine.
    [[nodiscard]] AxisBits placed_axes() const {
        return static_cast<AxisBits>(variables.known_in_system(state.coordinate_system) & g92_known);
    }

    /// The row of tool `number` in the table, which may grow by it; 0 of tool 0, the spindle; -1: there is
    /// none.
    [[nodiscard]] int row_of_tool(int number);

    /// A length in the machine's unit, in the program's.
    [[nodiscard]] double machine_to_program() const {
        if (state.unit == settings.machine_unit) {
            return 1.0;
        }
        return state.unit == LengthUnit::mm ? mm_per_inch : 1.0 / mm_per_inch;
    }
    [[nodiscard]] AxisValues to_program(const AxisValues& machine) const {
        return machine.lengths_scaled(machine_to_program());
    }
    [[nodiscard]] AxisValues to_machine(const AxisValues& program) const {
        return program.lengths_scaled(1.0 / machine_to_program());
    }
};

/// The axes of a plane as an arc sees them, and the one across.
struct PlaneAxes {
    Axis first, second, third;
};

[[nodiscard]] constexpr PlaneAxes axes_of(Plane plane) {
    switch (plane) {
    case Plane::xz:
        return {Axis::z, Axis::x, Axis::y};
    case Plane::yz:
        return {Axis::y, Axis::z, Axis::x};
    case Plane::uv:
        return {Axis::u, Axis::v, Axis::w};
    case Plane::uw:
        return {Axis::w, Axis::u, Axis::v};
    case Plane::vw:
        return {Axis::v, Axis::w, Axis::u};
    case Plane::xy:
        break;
    }
    return {Axis::x, Axis::y, Axis::z};
}

} // namespace millwright::gcode::internal
