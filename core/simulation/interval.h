// A part of a line. Coordinates along it, mm.
#pragma once

namespace millwright::simulation {

struct Interval {
    double from = 0.0, to = 0.0;

    friend bool operator==(const Interval&, const Interval&) = default;
};

} // namespace millwright::simulation
