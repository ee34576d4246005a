#include "core/simulation/collision_search.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace millwright::simulation {

namespace {

/// A nearer place than the nearest so far is looked for where it would be nearer by so much.
constexpr double worth_a_look = 0.75;

struct Stretch {
    double middle = 0.5, half = 0.5;
};

class WaySearch {
public:
    explicit WaySearch(const BodyWay& way) : way_(way) {
        const double half = 0.5 / way.parts;
        for (int n = way.parts - 1; n >= 0; --n) {
            left_.push_back({(2 * n + 1) * half, half});
        }
    }

    std::optional<Approach> found() {
        while (!left_.empty()) {
            const Stretch now = left_.back();
            left_.pop_back();
            if (!best_ || !best_->contact || now.middle - now.half < best_->time) {
                look(now);
            }
        }
        return best_;
    }

private:
    /// Distances that are not below do not matter.
    [[nodiscard]] double wanted() const {
        if (!best_) {
            return way_.clearance;
        }
        return best_->contact ? way_.contact : std::max(way_.contact, worth_a_look * best_->at.distance);
    }

    void look(const Stretch& now) {
        const double moved = way_.reach(now.middle, now.half);
        const double below = wanted() + moved;
        const auto near = way_.nearest(now.middle, beyond(below));
        if (!near) {
            return;
        }
        const bool meets = near->distance <= way_.contact;
        if (meets && (!best_ || !best_->contact) && meet_from_the_start()) {
            return;
        }
        if (meets && (!best_ || !best_->contact || now.middle < best_->time)) {
            best_ = Approach{now.middle, true, *near};
        } else if (!meets && near->distance < wanted()) {
            best_ = Approach{now.middle, false, *near};
        }
        if (!(moved > search_step)) {
            return;
        }
        const double quarter = 0.5 * now.half;
        if (!meets) {
            left_.push_back({now.middle + quarter, quarter});
        }
        left_.push_back({now.middle - quarter, quarter});
    }

    bool meet_from_the_start() {
        const auto near = way_.nearest(0.0, beyond(way_.contact));
        if (near && near->distance <= way_.contact) {
            best_ = Approach{0.0, true, *near};
            left_.clear();
            return true;
        }
        return false;
    }

    /// A little more, so that what is equal is below.
    static double beyond(double distance) {
        constexpr double rounding = 1e-12; // mm
        return distance + rounding * (1.0 + std::abs(distance));
    }

    const BodyWay& way_;
    std::vector<Stretch> left_; // the earliest last
    std::optional<Approach> best_;
};

} // namespace

std::optional<Approach> approach(const BodyWay& way) {
    return WaySearch(way).found();
}

} // namespace millwright::simulation
