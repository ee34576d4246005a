// A motor's answer to a step: what its position loop does, in numbers, and what of Ix30, Ix31, Ix33 to
// change. The step is a jog with as much acceleration and speed as the card takes, there and back.
#pragma once

#include "core/pmac_service/card_talk.h"

#include <map>
#include <string>
#include <vector>

namespace millwright::pmac {

struct StepTest {
    double size = 200.0;   ///< counts, not 0
    double duration = 0.5; ///< s that are watched, > 0
    double glance = 0.005; ///< s between two readings at least, > 0
    double settled = 0.05; ///< of the size: nearer than that it has settled
};

struct StepReading {
    double time = 0.0;     ///< s since the step, by the card's servo cycles
    double position = 0.0; ///< counts from where it began
};

struct StepResponse {
    double size = 0.0; ///< counts
    std::vector<StepReading> readings;
    double rise_time = 0.0;          ///< from 10 to 90 %, s; negative: it does not get there
    double overshoot = 0.0;          ///< of the size; 0: none
    double settling_time = 0.0;      ///< s; negative: it does not settle
    double error = 0.0;              ///< counts at the end
    std::map<int, double> variables; ///< Ixnn of the motor as they were and are again
    std::string advice;              ///< a sentence
};

/// Without a card: the numbers and the advice of readings that are there.
[[nodiscard]] StepResponse judge(double size, std::vector<StepReading> readings, double settled);

/// The motor has to be closed and at rest. All variables are as they were afterwards. Throws Error where
/// the card refuses and for a motor that runs away; the motor then has no power.
[[nodiscard]] StepResponse step_test(const CardTalk& card, int motor, const StepTest& test = {});

} // namespace millwright::pmac
