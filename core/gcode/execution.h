// In which order the lines of a program are executed, and what is in force after each of them. Executed lines
// count as steps from 0; a line of a loop or of a subroutine is several steps. What is in force is kept as
// its changes alone, so that any moment is found at once in little memory.
#pragma once

#include "core/gcode/modal_state.h"

#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <vector>

namespace millwright::gcode {

using Step = std::uint32_t;

/// What of the modal state people look at. Lengths mm, feeds as programmed, angles deg.
struct ModalView {
    int motion = 800; ///< in tenths; 800, G80: none
    Plane plane = Plane::xy;
    LengthUnit unit = LengthUnit::mm;
    bool incremental = false;
    FeedMode feed_mode = FeedMode::per_minute;
    program::PathMode path_mode = program::PathMode::continuous;
    CutterSide cutter = CutterSide::off;
    bool retract_to_r = true;
    int coordinate_system = 1; ///< 1: G54 to 9: G59.3
    int selected_tool = 0;
    int tool = 0; ///< in the spindle
    SpindleTurning spindle = SpindleTurning::stopped;
    bool mist = false, flood = false;
    float feed = 0.0F;
    float spindle_speed = 0.0F; ///< rpm, or as G96 has it
    float rotation_deg = 0.0F;
    AxisValues g5x_offset, g92_offset, tool_offset; ///< mm and deg
};

class Execution {
public:
    /// Line `line` (from 1; 0 keeps the line before, for lines of other files) was executed with this result.
    void add(std::int32_t line, const ModalState& state);

    /// Nothing more is coming: gives back what was set aside for it.
    void shrink();

    [[nodiscard]] Step count() const { return count_; }
    /// From 1. Throws Defect if there is no such step.
    [[nodiscard]] std::int32_t line_of(Step step) const;
    /// The first step that executes a line between `first` and `last`; nothing if none does.
    [[nodiscard]] std::optional<Step> step_of(std::int32_t first, std::int32_t last) const;
    /// The first step at `line` or later in the text; the last step where there is none.
    [[nodiscard]] Step step_at_or_after(std::int32_t line) const;
    /// After that step. Throws Defect if there is none.
    [[nodiscard]] ModalView state_after(Step step) const;

    [[nodiscard]] std::size_t bytes() const;

private:
    struct Jump {
        Step step;
        std::int32_t line;
    };
    struct Change {
        Step step;
        float value;
    };
    struct Modes {
        Step step;
        std::uint32_t index; ///< into modes_
    };
    struct Offsets {
        Step step;
        AxisValues g5x, g92, tool;
        float rotation_deg;
    };

    [[nodiscard]] std::uint32_t index_of(const ModalView& modes);

    Step count_ = 0;
    std::int32_t line_ = 0;
    ModalView last_;
    std::vector<Jump> jumps_; ///< where the next line is not the one below
    std::vector<ModalView> modes_;
    std::vector<Modes> mode_changes_;
    std::vector<Change> feeds_, speeds_;
    std::vector<Offsets> offsets_;
};

} // namespace millwright::gcode
