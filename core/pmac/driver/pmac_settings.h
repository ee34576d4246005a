// Which motors of a PMAC move which axes, and how far and fast a person may jog them. Degrees, counts, s: the
// words of the card's files.
#pragma once

#include <memory>
#include <optional>
#include <vector>

namespace millwright::arm {
class ArmModel;
} // namespace millwright::arm

namespace millwright::pmac {

/// A typed way up to this goes at the card's own speed, as a test of a loop needs it; degrees.
inline constexpr double pmac_step_deg = 2.0;

struct PmacAxis {
    char letter = 'X';
    int motor = 1;
    double counts_per_degree = 100.0;
    std::optional<double> min_deg{}, max_deg{}; ///< checked before a jog and while anything moves
    double jog_deg_per_s = 5.0;                 ///< no jog is faster, whatever Ix22 says
};

/// What becomes of the motors' power when the link is dropped: from then on they are not monitored.
enum class Parting {
    takes_power, ///< nothing keeps any
    as_found,    ///< taken away unless it was there when the link was made
    keeps_power  ///< a person said so
};

struct PmacSettings {
    std::vector<PmacAxis> axes;
    /// Whose joints the axes are: its zone is kept, too. None: there is no zone.
    std::shared_ptr<const arm::ArmModel> arm{};
    int system = 1;            ///< coordinate system
    int program = 1;           ///< motion program that start() writes
    double abort_after = 0.05; ///< without a sign of life the card stops its motors, s
    double kill_after = 0.08;  ///< and takes their power away
    Parting parting = Parting::takes_power;
    double patience = 0.5; ///< s without an answer after which the card counts as silent
};

/// The four driven axes of the Motoman L-3 (Saengsasri, Nittayachin 1996, KMITL).
[[nodiscard]] inline PmacSettings arm_settings() {
    PmacSettings settings;
    settings.axes = {{.letter = 'X', .motor = 1, .counts_per_degree = 120.0},
                     {.letter = 'Y', .motor = 2, .counts_per_degree = 222.0},
                     {.letter = 'Z', .motor = 3, .counts_per_degree = 150.0},
                     {.letter = 'A', .motor = 4, .counts_per_degree = 150.0}};
    return settings;
}

} // namespace millwright::pmac
