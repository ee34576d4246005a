#include "core/drivers/grbl/internal/override_steps.h"

#include <algorithm>

namespace millwright::drivers::grbl {

namespace {

constexpr int standard = 100; // percent
constexpr int least = 10;
constexpr int most = 200;
constexpr int coarse = 10;

constexpr char feed_standard = '\x90';  // then: +10, -10, +1, -1
constexpr char rapid_standard = '\x95'; // then: 50, 25
constexpr char spindle_standard = '\x99';

int nearest_rapid(int percent) {
    constexpr int above_half = 75;
    constexpr int above_quarter = 37;
    return percent > above_half ? standard : percent > above_quarter ? 50 : 25;
}

/// One step from `now` towards `wanted`: a coarse and a fine one have flags of their own. Never beyond it.
int step_towards(int wanted, int now, char first, std::string& bytes) {
    if (wanted == now) {
        return now;
    }
    if (wanted == standard) {
        bytes += first;
        return standard;
    }
    const int tens = (wanted - now) / coarse;
    const int ones = (wanted - now) % coarse;
    const auto add = [&](int count, int size, int up) {
        if (count != 0) {
            bytes += static_cast<char>(first + (count > 0 ? up : up + 1));
            now += count > 0 ? size : -size;
        }
    };
    add(tens, coarse, 1);
    add(ones, 1, 3);
    return now;
}

} // namespace

void OverrideSteps::want(const Overrides& wanted) {
    wanted_ = Overrides{std::clamp(wanted.feed, least, most),
                        nearest_rapid(wanted.rapid),
                        std::clamp(wanted.spindle, least, most)};
}

void OverrideSteps::forget() {
    wanted_.reset();
    sent_ = -1.0;
}

void OverrideSteps::reported(const Overrides& now, double time) {
    const bool shows_the_step = now == expected_;
    if (sent_ >= 0.0 && !shows_the_step && time - sent_ < stale_time) {
        return;
    }
    now_ = now;
    sent_ = -1.0;
    if (wanted_ == now_) {
        wanted_.reset();
    }
}

std::string OverrideSteps::take_step(double time) {
    std::string bytes;
    if (sent_ >= 0.0 || !wanted_) {
        return bytes;
    }
    expected_.feed = step_towards(wanted_->feed, now_.feed, feed_standard, bytes);
    if (wanted_->rapid != now_.rapid) {
        const int level = wanted_->rapid == standard ? 0 : wanted_->rapid == 50 ? 1 : 2;
        bytes += static_cast<char>(rapid_standard + level);
    }
    expected_.rapid = wanted_->rapid;
    expected_.spindle = step_towards(wanted_->spindle, now_.spindle, spindle_standard, bytes);
    if (bytes.empty()) { // it is as wanted already
        wanted_.reset();
    } else {
        sent_ = time;
    }
    return bytes;
}

} // namespace millwright::drivers::grbl
