#include "core/gcode/internal/grbl_rules.h"

#include "core/base/numbers.h"
#include "core/gcode/internal/codes.h"
#include "core/gcode/internal/refusal.h"

#include <fmt/format.h>

#include <cstddef>

namespace millwright::gcode::internal {

namespace {

constexpr int dynamic_length = 431;

void check_tool_length(const Block& block) {
    const int code = block.code(GGroup::tool_length);
    if (code == no_code) {
        return;
    }
    const int column = block.column_of(GGroup::tool_length);
    if (code != dynamic_length && block.has_any(axis_words)) {
        refuse(column, "Grbl ignores axis words in a line with G49");
    }
    const bool only_z = block.has('Z') && !block.has_any(words_of("XYABCUVW"));
    if (code == dynamic_length && !only_z) {
        refuse(column, "G43.1 in Grbl needs Z and no other axis word (error 37)");
    }
}

/// The target counts from the offset that the same line takes away.
void check_g92(const Block& block, const ModalState& state) {
    constexpr int g92_1 = 921;
    bool shifted = false;
    for (std::size_t axis = 0; axis < axis_count; ++axis) {
        shifted = shifted || !exactly_equal(state.g92_offset[axis], 0.0);
    }
    if (block.code(GGroup::non_modal) == g92_1 && block.has_any(axis_words) && shifted) {
        refuse(block.column_of(GGroup::non_modal),
               "in a line with G92.1, Grbl still moves by the old G92 offset",
               "split it into two lines");
    }
}

/// Axis words that are for G10, G92 or a tool's length are refused, too.
void check_cancelled_motion(const Block& block, const ModalState& state) {
    constexpr int g80 = 800;
    const int given = block.code(GGroup::motion);
    if ((given == no_code ? state.motion : given) == g80 && block.has_any(axis_words)) {
        refuse(given == no_code ? 1 : block.column_of(GGroup::motion),
               "Grbl does not accept axis words while G80 is active (error 31)",
               "activate G0 or G1 first");
    }
}

/// Whether the motion of this line, its own or the one in force, is an arc.
bool makes_arc(const Block& block, const ModalState& state) {
    const int motion = block.code(GGroup::motion);
    if (motion != no_code) {
        return is_arc(motion);
    }
    const bool axes_are_taken =
        block.code(GGroup::non_modal) != no_code || block.code(GGroup::tool_length) == dynamic_length;
    return is_arc(state.motion) && block.has_any(axis_words) && !axes_are_taken;
}

struct PlaneWords {
    std::uint32_t axes, offsets;
};

PlaneWords words_of_plane(const Block& block, const ModalState& state) {
    const int chosen = block.code(GGroup::plane);
    const bool xz = chosen == no_code ? state.plane == Plane::xz : chosen == 180;
    const bool yz = chosen == no_code ? state.plane == Plane::yz : chosen == 190;
    return xz   ? PlaneWords{words_of("XZ"), words_of("IK")}
           : yz ? PlaneWords{words_of("YZ"), words_of("JK")}
                : PlaneWords{words_of("XY"), words_of("IJ")};
}

void check_arc(const Block& block, const ModalState& state) {
    if (!makes_arc(block, state)) {
        return;
    }
    const int column = block.code(GGroup::motion) == no_code ? 1 : block.column_of(GGroup::motion);
    const PlaneWords plane = words_of_plane(block, state);
    if (!block.has_any(axis_words)) {
        refuse(column, "an arc in Grbl needs axis words (error 26)");
    }
    if (!block.has_any(plane.axes)) {
        refuse(column, "an arc in Grbl needs an axis word of its plane (error 32)");
    }
    if (!block.has('R') && !block.has_any(plane.offsets)) {
        refuse(column, "an arc needs its radius R, or its centre in the plane (error 35)");
    }
    const std::uint32_t used = block.has('R') ? 0U : words_of("IJK"); // K of an arc in XY is read over
    for (const char letter : {'I', 'J', 'K', 'P'}) {
        if (block.has(letter) && (word_bit(letter) & used) == 0) {
            refuse(block.column_of(letter), fmt::format("{} is not used by this arc (error 36)", letter));
        }
    }
}

void check_grbl_g10(const Block& block) {
    constexpr int set_data = 100;
    if (block.code(GGroup::non_modal) != set_data) {
        return;
    }
    const int column = block.column_of(GGroup::non_modal);
    if (!block.has_any(axis_words)) {
        refuse(column, "G10 in Grbl needs axis words (error 26)");
    }
    if (!block.has('L') && !block.has('P')) {
        refuse(column, "G10 in Grbl needs L and P (error 28)");
    }
    if (block.value_or('P', 0.0) >= 7.0) {
        refuse(block.column_of('P'), "Grbl has coordinate systems 1 to 6, G54 to G59 (error 29)");
    }
    const int kind = static_cast<int>(block.value_or('L', 0.0));
    if (kind != 2 && kind != 20) {
        refuse(column, "G10 in Grbl needs L2 or L20 (error 20)");
    }
    if (block.has('R')) {
        refuse(block.column_of('R'),
               kind == 2 ? "G10 L2 in Grbl does not support rotation (error 20)"
                         : "R is not used by G10 L20 (error 36)");
    }
}

} // namespace

void apply_grbl_rules(const Block& block, const ModalState& state) {
    check_cancelled_motion(block, state);
    check_arc(block, state);
    check_tool_length(block);
    check_g92(block, state);
    check_grbl_g10(block);
}

} // namespace millwright::gcode::internal
