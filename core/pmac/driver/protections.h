// Which of a PMAC's own protections are switched off, as its I-variables say.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace millwright::pmac {

/// Of one motor.
struct MotorProtections {
    int motor = 1;
    double fatal_following_error = 0.0;          ///< Ix11; 0: off
    double upper_limit = 0.0, lower_limit = 0.0; ///< Ix13, Ix14, counts; 0: off
    std::uint32_t flags = 0;                     ///< Ix25, whose bits 16, 17 and 20 switch off
    bool active = true;                          ///< Ix00; others do nothing
};

/// A sentence for each protection that some active motor lacks, without a full stop: whose, what that means,
/// by which variable. Empty: all are on.
[[nodiscard]] std::vector<std::string> protections_off(const std::vector<MotorProtections>& motors);

/// The same in one, of a notice; "" where all are on.
[[nodiscard]] std::string protections_notice(const std::vector<std::string>& off);

} // namespace millwright::pmac
