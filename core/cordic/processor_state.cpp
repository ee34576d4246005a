#include "core/cordic/processor_state.h"

namespace millwright::cordic {

std::string_view to_text(Stop stop) {
    switch (stop) {
    case Stop::none:
        return "running";
    case Stop::halted:
        return "halted at the end";
    case Stop::overflow:
        return "a number did not fit into the word";
    case Stop::no_number:
        return "a value is not a number (NaN or infinity)";
    case Stop::no_speed:
        return "Vmax and Amax of a motion must be above 0";
    case Stop::across_memories:
        return "an LD or ST crosses the border between two memories";
    case Stop::illegal_instruction:
        return "an opcode is not supported by the processor";
    case Stop::stack_overflow:
        return "a microprogram nested calls more than 4 deep";
    case Stop::stack_underflow:
        return "a microprogram returned without a call";
    case Stop::microprogram_end:
        return "the microprogram ran past its last word";
    case Stop::too_many_bytes:
        return "the microprogram moved more bytes than a word or a record has";
    case Stop::too_many_steps:
        return "the microprogram made more steps or corrections than the sequence has";
    case Stop::beyond_bus:
        return "an address is beyond the end of the bus";
    case Stop::rom_write:
        return "the program wrote to the program ROM";
    case Stop::no_page:
        return "a page is beyond the end of the program ROM";
    case Stop::arc_too_coarse:
        return "the step angle of an arc is outside the convergence range, or the arc has no chord";
    case Stop::out_of_reach:
        return "the direction of a move is outside the convergence range: too few iterations";
    }
    return {};
}

} // namespace millwright::cordic
