// The homing cycle of an emulated Grbl: first Z, then X and Y together; search, pull off, locate, pull off.
#pragma once

#include "core/emulators/grbl/internal/eeprom.h"

#include <vector>

namespace millwright::emulators::internal {

class Homing {
public:
    /// From `begin`, in the true coordinates of the machine: 0 and minus the travel are where its switches
    /// are.
    Homing(const Eeprom& eeprom, const Axes& begin, bool switches_broken);

    /// Moves on; more than is left is left out.
    void advance(double seconds);
    [[nodiscard]] double rest() const;
    [[nodiscard]] const Axes& position() const { return position_; }
    [[nodiscard]] bool failed() const { return failed_; }

private:
    struct Leg {
        Axes to{};
        double seconds = 0.0;
    };
    void add_leg(const Axes& to, double rate_mm_per_min);

    Axes position_{}, planned_{};
    std::vector<Leg> legs_; ///< the last comes first
    bool failed_ = false;
};

} // namespace millwright::emulators::internal
