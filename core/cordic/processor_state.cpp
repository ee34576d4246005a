#include "core/cordic/processor_state.h"

namespace millwright::cordic {

std::string_view to_text(Stop stop) {
    switch (stop) {
    case Stop::none:
        return "running";
    case Stop::halted:
        return "halted at the end";
    case Stop::overflow:
        return "a number did not fit the word";
    case Stop::no_number:
        return "bits that are no number: NaN or infinity";
    case Stop::no_speed:
        return "Vmax and Amax of a motion must be above 0";
    case Stop::across_memories:
        return "an LD or ST across the border between two memories";
    case Stop::illegal_instruction:
        return "an opcode that the processor does not know";
    case Stop::stack_overflow:
        return "a microprogram called more than 4 deep";
    case Stop::stack_underflow:
        return "a microprogram returned where nothing had called";
    case Stop::microprogram_end:
        return "the microprogram ran behind its last word";
    case Stop::too_many_bytes:
        return "the microprogram moved more bytes than a word or a record has";
    case Stop::too_many_steps:
        return "the microprogram made more steps or corrections than the sequence has";
    case Stop::beyond_bus:
        return "an address behind the last one of the bus";
    case Stop::rom_write:
        return "a write into the program ROM";
    case Stop::no_page:
        return "a page behind the last one of the program ROM";
    case Stop::arc_too_coarse:
        return "an arc with a step angle beyond the convergence range, or with no chord";
    case Stop::out_of_reach:
        return "a move in a direction beyond the convergence range: too few iterations";
    }
    return {};
}

} // namespace millwright::cordic
