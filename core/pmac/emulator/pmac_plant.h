// What hangs on a channel of an emulated PMAC: amplifier, motor, encoder and switches. Counts, s, and bits of
// the card's analog outputs (32768 are 10 V).
#pragma once

#include <limits>
#include <optional>
#include <vector>

namespace millwright::pmac {

struct PmacPlant {
    double speed_per_bit = 200.0; ///< where a constant output ends, counts/s
    double time_constant = 0.01;  ///< s
    double coast_time = 0.02;     ///< s: how it comes to rest without an amplifier
    double bias = 0.0;            ///< bits that the amplifier adds
    double friction = 0.0;        ///< bits below which it does not move
    /// Encoder decode (I900, ...) with which it counts as given here; nothing: with any.
    std::optional<int> decode;
    double home_edge = 5000.0; ///< where the home flag falls, going up
    double low_switch = -std::numeric_limits<double>::infinity();
    double high_switch = std::numeric_limits<double>::infinity();
};

/// The four driven axes of the Motoman L-3 as Saengsasri, Nittayachin 1996, KMITL, found them: encoders
/// counted once per line, three of them the other way round, and the offsets that held them still.
[[nodiscard]] inline std::vector<PmacPlant> arm_plants() {
    std::vector<PmacPlant> plants(4);
    plants[0].decode = 1;
    plants[1].decode = plants[2].decode = plants[3].decode = 5;
    plants[0].bias = 996.0;
    plants[1].bias = 995.0;
    plants[2].bias = -60.0;
    return plants;
}

} // namespace millwright::pmac
