#include "core/pmac_service/offset_finder.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <functional>
#include <utility>
#include <vector>

namespace millwright::pmac {

namespace {

constexpr int fatal_following_error = 11, output_bias = 29, gain = 30, output_limit = 69; // of Ixnn

/// Variables that are others while it lives: given back by end(), or as well as the link allows.
class Borrowed {
public:
    Borrowed(const CardTalk& card, int motor)
        : card_(card), motor_(motor), error_limit_(motor_variable(card, motor, fatal_following_error)),
          bias_(motor_variable(card, motor, output_bias)), gain_(motor_variable(card, motor, gain)) {}
    Borrowed(const Borrowed&) = delete;
    Borrowed& operator=(const Borrowed&) = delete;
    ~Borrowed() {
        // One at a time: in an alarm the kill is refused, and the variables are not. Without a link none
        // goes; the card kills its motors itself then.
        for (const auto& step : give_back_) {
            try {
                step();
            } catch (const Error&) {
            }
        }
    }

    [[nodiscard]] double bias() const { return bias_; }
    void kill() const { card_.ask(fmt::format("#{}K", motor_)); }
    /// From here on they are given back however this ends.
    /// However busy this computer is, the card itself ends a try that goes farther than `most_of_try` counts.
    void begin(double most_of_try) {
        kill();
        give_back_ = {[this] { kill(); },
                      [this] { set_motor_variable(card_, motor_, output_bias, bias_); },
                      [this] { set_motor_variable(card_, motor_, gain, gain_); },
                      [this] { set_motor_variable(card_, motor_, fatal_following_error, error_limit_); }};
        set_motor_variable(card_, motor_, gain, 0.0);
        constexpr double of_count = 16.0, greatest = 8'388'607.0; // Ix11 counts in sixteenths; 0: no limit
        set_motor_variable(card_,
                           motor_,
                           fatal_following_error,
                           std::clamp(std::floor(of_count * most_of_try), 1.0, greatest));
    }
    void end() {
        while (!give_back_.empty()) {
            const std::function<void()> step = give_back_.front();
            give_back_.erase(give_back_.begin());
            step();
        }
    }

private:
    const CardTalk& card_;
    int motor_;
    double error_limit_, bias_, gain_;
    std::vector<std::function<void()>> give_back_;
};

class Finder {
public:
    Finder(const CardTalk& card, int motor, const OffsetSearch& search)
        : card_(card), motor_(motor), search_(search), borrowed_(card, motor),
          limit_(static_cast<int>(motor_variable(card, motor, output_limit))),
          begin_(motor_position(card, motor)) {}

    [[nodiscard]] OffsetFound find() {
        constexpr double share_of_try = 0.25; // of the way of all of them
        borrowed_.begin(share_of_try * search_.most_way);
        OffsetFound found;
        found.before = static_cast<int>(std::lround(borrowed_.bias()));
        const int from = search_.from.value_or(found.before);
        const int backward = moving(from, -1);
        const int forward = moving(from, 1);
        found.backward = last_moving(backward, forward, -1);
        found.forward = last_moving(forward, backward, 1);
        found.middle = static_cast<int>(std::lround(0.5 * (found.backward + found.forward)));
        found.farthest = farthest_;
        borrowed_.end();
        return found;
    }

private:
    /// Which way the motor creeps: -1, 0, 1.
    int direction(int offset) {
        set_motor_variable(card_, motor_, output_bias, offset);
        const double start = motor_position(card_, motor_);
        card_.ask(fmt::format("#{}J/", motor_));
        int seen = 0;
        for (double time = 0.0; time < search_.look && seen == 0; time += search_.glance) {
            card_.wait(search_.glance);
            const double now = motor_position(card_, motor_);
            farthest_ = std::max(farthest_, std::abs(now - begin_));
            seen = now - start >= search_.creep ? 1 : start - now >= search_.creep ? -1 : 0;
        }
        borrowed_.kill();
        await_rest();
        if (farthest_ > search_.most_way) {
            throw Error(fmt::format("motor {} moved {:.0f} counts, but only {:.0f} were allowed",
                                    motor_,
                                    farthest_,
                                    search_.most_way),
                        {},
                        fmt::format("start with an offset closer to standstill, allow a longer travel, or "
                                    "reverse the direction of its encoder (I{:03}): if that is wrong, the "
                                    "search moves faster and faster the wrong way",
                                    895 + 5 * motor_));
        }
        return seen;
    }

    /// Without power it coasts.
    void await_rest() {
        constexpr double pause = 0.05, patience = 2.0; // s
        double before = motor_position(card_, motor_);
        for (double time = 0.0; time < patience; time += pause) {
            card_.wait(pause);
            const double now = motor_position(card_, motor_);
            farthest_ = std::max(farthest_, std::abs(now - begin_));
            if (std::abs(now - std::exchange(before, now)) < 1.0) {
                return;
            }
        }
    }

    /// From `offset` on in growing steps, one at which the motor goes to `sense`.
    int moving(int offset, int sense) {
        for (int step = 1; direction(offset) != sense; step *= 2) {
            if (std::abs(offset) >= limit_) {
                throw Error(fmt::format("motor {} does not move {} with any offset up to {} bits (Ix69)",
                                        motor_,
                                        sense > 0 ? "forward" : "backward",
                                        limit_),
                            {},
                            "check power, encoder and direction");
            }
            offset = std::clamp(offset + sense * step, -limit_, limit_);
        }
        return offset;
    }

    /// The offset nearest to `other` at which the motor goes to `sense`, as it does at `at`.
    int last_moving(int at, int other, int sense) {
        while (std::abs(at - other) > 1) {
            const int middle = other + (at - other) / 2;
            (direction(middle) == sense ? at : other) = middle;
        }
        return at;
    }

    const CardTalk& card_;
    int motor_;
    const OffsetSearch& search_;
    Borrowed borrowed_;
    int limit_; ///< bits
    double begin_;
    double farthest_ = 0.0;
};

} // namespace

OffsetFound find_offset(const CardTalk& card, int motor, const OffsetSearch& search) {
    expects(search.creep > 0.0 && search.look > 0.0 && search.glance > 0.0 && search.most_way > 0.0,
            "ways and times of the search are positive");
    return Finder(card, motor, search).find();
}

} // namespace millwright::pmac
