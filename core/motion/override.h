// What a person turns at the machine while it runs.
#pragma once

namespace millwright::motion {

/// Factors of programmed feeds and of the speed of rapids.
struct Override {
    double feed = 1.0;  ///< > 0, at most highest_override
    double rapid = 1.0; ///< > 0, at most 1

    friend bool operator==(const Override&, const Override&) = default;
};

/// A feed override of more is refused: the limits of a path hold for any override up to here.
inline constexpr double highest_override = 2.0;

} // namespace millwright::motion
