// Whether motors go where the card sends them. Amplifiers without supply, a brake that is on or something in
// the way tell the card nothing, and a held jog never lets the error grow to the card's own limit (Ix11),
// since it is renewed from where the motor is.
#pragma once

#include <cstddef>
#include <optional>
#include <vector>

namespace millwright::pmac::internal {

class FollowingWatch {
public:
    explicit FollowingWatch(std::size_t motors) : watched_(motors) {}

    /// `lags`: where each motor was sent minus where it is; `places`: where it is; degrees, in its order.
    /// `now`: s. Which one is sent on and has not gone there for half a second.
    [[nodiscard]] std::optional<std::size_t>
    left_behind(const std::vector<double>& lags, const std::vector<double>& places, double now);
    void forget() { watched_.assign(watched_.size(), std::nullopt); }

private:
    struct Since {
        double place = 0.0; ///< degrees
        double time = 0.0;  ///< s
        bool forwards = true;
        int looks = 0;
    };
    std::vector<std::optional<Since>> watched_; ///< none: it follows
};

} // namespace millwright::pmac::internal
