// Whose silence it is: while this program was kept from its work (a full disk cache, a computer that was put
// to sleep) it has asked nothing, so there could be no answer.
#pragma once

#include <utility>

namespace millwright::drivers {

class HostStall {
public:
    void begin(double now) { looked_ = now; }
    /// Asked in each tick: s that a controller's silence shall not count, else 0.
    [[nodiscard]] double taken(double now) {
        constexpr double pause = 0.25; // s, many times what lies between two ticks
        const double gap = now - std::exchange(looked_, now);
        return gap > pause ? gap : 0.0;
    }

private:
    double looked_ = 0.0; ///< clock time of the last look, s
};

} // namespace millwright::drivers
