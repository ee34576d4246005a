// Whether a jog and a motion program take a motor the same way. Where the scale of its axis has the wrong
// sign they do not, and an arm that was jogged clear of something runs into it under program.
// Source: Saengsasri, Nittayachin 1996 (KMITL), who define axes and jog motors by separate numbers.
#pragma once

#include "core/pmac_service/card_talk.h"

#include <string>

namespace millwright::pmac {

struct DirectionCheck {
    double way = 1.0;      ///< units of the axis, for the arm degrees; > 0
    double duration = 0.5; ///< of each move, s, > 0
};

struct DirectionFound {
    char axis = 'X';      ///< of coordinate system 1
    double scale = 0.0;   ///< counts a unit, as the axis is defined
    double jog = 0.0;     ///< counts that a positive jog gave
    double program = 0.0; ///< and a positive move of a program
    bool agree = false;   ///< both went, and the same way
};

/// The motor goes there and back twice, and is where it was. Uses the card's PROG 999, and Ix22 for the time.
/// Throws Error where the motor has no power, is no axis, does not come to rest, or the card refuses: a
/// program needs power on every motor of coordinate system 1.
[[nodiscard]] DirectionFound
direction_check(const CardTalk& card, int motor, const DirectionCheck& check = {});

} // namespace millwright::pmac
