#include "core/cordic/internal/move_check.h"

namespace millwright::cordic::internal {

std::string_view MoveCheck::idle(const Instruction& next) {
    switch (next.opcode) {
    case Opcode::mov:
        at(next.target) = next.immediate;
        break;
    case Opcode::ld:
        at(next.target).reset();
        break;
    case Opcode::g00:
    case Opcode::g01:
        return with_speed(line(false));
    case Opcode::g00z:
    case Opcode::g01z:
        return with_speed(line(true));
    case Opcode::g02:
    case Opcode::g03:
        return with_speed(arc(false));
    case Opcode::g02z:
    case Opcode::g03z:
        return with_speed(arc(true));
    default:
        return {};
    }
    if (next.target == Register::PC) {
        forget(); // a jump
    }
    return {};
}

std::string_view MoveCheck::with_speed(std::string_view found) {
    const bool missing = is_zero(Register::Vmax) || is_zero(Register::Amax);
    return found.empty() && missing ? "a motion has no Vmax or Amax: the processor will stop" : found;
}

std::string_view MoveCheck::line(bool in_space) {
    const bool stands = are_equal(Register::XI, Register::X0) && are_equal(Register::YJ, Register::Y0) &&
                        (!in_space || are_equal(Register::Z, Register::Z0));
    at(Register::X0) = at(Register::XI);
    at(Register::Y0) = at(Register::YJ);
    if (in_space) {
        at(Register::Z0) = at(Register::Z);
    }
    return stands ? "a move has zero length: its end is where the axes are" : "";
}

std::string_view MoveCheck::arc(bool rises) {
    const bool lies_in_centre =
        are_equal(Register::XI, Register::X0) && are_equal(Register::YJ, Register::Y0);
    const bool climbs = rises && !is_zero(Register::Z);
    std::string_view found;
    if (is_zero(Register::N)) {
        found = "an arc has no chords (N is 0): the processor will stop";
    } else if (is_zero(Register::Dz) && !climbs) {
        found = "an arc does not turn: Dz is 0";
    } else if (lies_in_centre && !climbs) {
        found = "an arc has zero radius: its centre is where the axes are";
    }
    at(Register::X0).reset();
    at(Register::Y0).reset();
    if (rises) {
        at(Register::Z0).reset();
    }
    at(Register::N) = 0; // counted down
    return found;
}

} // namespace millwright::cordic::internal
