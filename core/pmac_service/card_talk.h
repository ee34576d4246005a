// On-line commands of a PMAC, one question and answer at a time: what setting up a motor takes.
#pragma once

#include <cstddef>
#include <functional>
#include <string>
#include <vector>

namespace millwright::pmac {

constexpr int jog_speed_variable = 22; ///< of Ixxnn, counts/ms

struct CardTalk {
    /// The answer without its hand-shake, its lines with an LF between. Throws Error for a refusal or a lost
    /// link.
    std::function<std::string(const std::string&)> ask;
    std::function<void(double)> wait; ///< s, of the card's time
};

/// I-variable `number` of a motor, as 29 for Ix29. Throws Error where the answer is no number.
[[nodiscard]] double motor_variable(const CardTalk& card, int motor, int number);
void set_motor_variable(const CardTalk& card, int motor, int number, double value);
/// What a motor's status words tell.
struct MotorState {
    bool powered = false;
    bool standing = false; ///< its commanded velocity is zero
};
/// #n?. Throws Error where the answer is no two words.
[[nodiscard]] MotorState motor_state(const CardTalk& card, int motor);
/// #nP, counts.
[[nodiscard]] double motor_position(const CardTalk& card, int motor);
/// `line` has to be answered by so many numbers. Throws Error for anything else.
[[nodiscard]] std::vector<double>
numbers_for(const CardTalk& card, const std::string& line, std::size_t count);

} // namespace millwright::pmac
