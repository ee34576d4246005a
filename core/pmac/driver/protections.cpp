#include "core/pmac/driver/protections.h"

#include <fmt/format.h>

#include <functional>

namespace millwright::pmac {

namespace {

/// "motor 1", "motors 1, 2 and 4"
std::string named(const std::vector<int>& motors) {
    std::string text = motors.size() == 1 ? "motor " : "motors ";
    for (std::size_t n = 0; n < motors.size(); ++n) {
        text += n == 0 ? "" : n + 1 == motors.size() ? " and " : ", ";
        text += std::to_string(motors[n]);
    }
    return text;
}

/// "I113, I213"
std::string variables(const std::vector<int>& motors, int variable) {
    std::string text;
    for (const int motor : motors) {
        text += fmt::format("{}I{}{:02}", text.empty() ? "" : ", ", motor, variable);
    }
    return text;
}

struct Protection {
    std::function<bool(const MotorProtections&)> off;
    int variable;
    const char* one;     ///< behind "motor 1"
    const char* several; ///< behind "motors 1 and 2"
    const char* value;   ///< by which it is off
};

bool has_bit(const MotorProtections& motor, int bit) {
    return (motor.flags >> bit & 1U) != 0;
}

bool is_off(double value) {
    return !(value > 0.0 || value < 0.0);
}

} // namespace

std::vector<std::string> protections_off(const std::vector<MotorProtections>& motors) {
    constexpr int amplifier_bit = 16, switches_bit = 17, fault_bit = 20;
    const std::vector<Protection> all{
        {[](const MotorProtections& m) { return !(m.fatal_following_error > 0.0); },
         11,
         "has no following-error limit and is not stopped by it",
         "have no following-error limit and are not stopped by it",
         "= 0"},
        {[](const MotorProtections& m) { return is_off(m.upper_limit); },
         13,
         "has no upper position limit in the card",
         "have no upper position limit in the card",
         "= 0"},
        {[](const MotorProtections& m) { return is_off(m.lower_limit); },
         14,
         "has no lower position limit in the card",
         "have no lower position limit in the card",
         "= 0"},
        {[](const MotorProtections& m) { return has_bit(m, amplifier_bit); },
         25,
         "keeps its amplifier enabled even if it is killed",
         "keep their amplifiers enabled even if they are killed",
         "bit 16"},
        {[](const MotorProtections& m) { return has_bit(m, switches_bit); },
         25,
         "runs through its limit switches, which are ignored",
         "run through their limit switches, which are ignored",
         "bit 17"},
        {[](const MotorProtections& m) { return has_bit(m, fault_bit); },
         25,
         "continues if its amplifier reports a fault",
         "continue if their amplifiers report a fault",
         "bit 20"}};
    std::vector<std::string> sentences;
    for (const Protection& protection : all) {
        std::vector<int> without;
        for (const MotorProtections& motor : motors) {
            if (motor.active && protection.off(motor)) {
                without.push_back(motor.motor);
            }
        }
        if (!without.empty()) {
            sentences.push_back(fmt::format("{} {} ({} {})",
                                            named(without),
                                            without.size() == 1 ? protection.one : protection.several,
                                            variables(without, protection.variable),
                                            protection.value));
        }
    }
    return sentences;
}

std::string protections_notice(const std::vector<std::string>& off) {
    std::string text = off.empty() ? "" : "Protections disabled in the card:";
    for (const std::string& sentence : off) {
        text += "\n" + sentence;
    }
    return text;
}

} // namespace millwright::pmac
