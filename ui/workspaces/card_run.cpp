#include "ui/workspaces/card_run.h"

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace millwright::actions {

namespace {

constexpr double longest_wait = 2.0; // s
constexpr int lines_ahead = 4;       // lines that may be executed beyond those that the driver is certain of

/// When `line` (from 0) begins.
double begin_of(const CardPlan& plan, int line) {
    return line > 0 ? plan.ends[static_cast<std::size_t>(line) - 1] : 0.0;
}

bool is_under_way(const drivers::DriverStatus& status) {
    using drivers::DriverState;
    return status.state == DriverState::holding ||
           (status.state == DriverState::running && status.activity == drivers::Activity::program);
}

} // namespace

void CardRun::begin(CardPlan plan) {
    plan_ = std::move(plan);
    at_ = nullptr;
    seen_ = false;
    elapsed_ = waited_ = 0.0;
    place_.reset();
    broken_off_.reset();
}

void CardRun::follow(const drivers::DriverStatus& status, double seconds) {
    const bool under_way = is_under_way(status);
    waited_ += under_way || seen_ ? 0.0 : seconds; // what the machine reported may be older than the program
    seen_ = seen_ || under_way;
    if (plan_ && !under_way && (seen_ || waited_ > longest_wait)) {
        const bool well = status.state == drivers::DriverState::idle;
        broken_off_ = well ? std::nullopt : place_;
        plan_.reset();
        place_.reset();
    }
    if (plan_ && seen_) {
        go_on(status, seconds);
        place_ = place_by(status);
    }
}

void CardRun::go_on(const drivers::DriverStatus& status, double seconds) {
    const bool sending = status.sent_blocks < plan_->lines;
    const bool moves = status.state == drivers::DriverState::running && !sending;
    const double guess = elapsed_ + (moves ? seconds * 0.01 * status.overrides.feed : 0.0);
    double from = 0.0;
    double to = plan_->duration > 0.0 ? plan_->duration : std::max(guess, 0.0);
    if (!plan_->ends.empty()) {
        const int done = std::clamp(status.executed_blocks, 0, plan_->lines);
        from = begin_of(*plan_, done);
        to = std::min(std::max(to, from), begin_of(*plan_, std::min(done + lines_ahead + 1, plan_->lines)));
    }
    elapsed_ = std::clamp(elapsed_, from, std::max(from, to));
    const double time = at_ && !sending ? time_by_place(status, to, guess) : guess;
    elapsed_ = std::clamp(time, from, std::max(from, to));
}

/// From elapsed_ on, and no later than `to`: when the plan is next to where the motors are. Of several such
/// times, as in a dwell, the one next to `guess`.
double CardRun::time_by_place(const drivers::DriverStatus& status, double to, double guess) const {
    constexpr double step = 0.02, look = 2.0, tolerance = 1e-3; // s, s, rad
    const auto away = [&](double time) {
        const kinematics::AxisPositions planned = at_(time);
        return planned.size() == status.position.size() ? (planned - status.position).cwiseAbs().maxCoeff()
                                                        : 0.0;
    };
    const double last = std::min(to, elapsed_ + look);
    std::vector<std::pair<double, double>> found; // time, how far the plan is away
    for (double time = elapsed_; time < last; time += step) {
        found.emplace_back(time, away(time));
    }
    found.emplace_back(std::max(last, elapsed_), away(std::max(last, elapsed_)));
    const double least = std::ranges::min(found, {}, &std::pair<double, double>::second).second;
    double best = elapsed_;
    bool any = false;
    for (const auto& [time, distance] : found) {
        const bool near = distance <= least + tolerance;
        if (near && (!any || std::abs(time - guess) < std::abs(best - guess))) {
            best = time;
            any = true;
        }
    }
    const bool around =
        best <= guess && guess <= best + step && away(std::min(guess, last)) <= least + tolerance;
    return around ? std::min(guess, std::max(last, elapsed_)) : best;
}

CardPlace CardRun::place_by(const drivers::DriverStatus& status) const {
    CardPlace place;
    place.lines = plan_->lines;
    place.sending = status.sent_blocks < plan_->lines;
    place.duration = plan_->duration;
    place.time = place.duration > 0.0 ? elapsed_ : 0.0;
    const auto now = std::ranges::upper_bound(plan_->ends, elapsed_); // the first that has not ended
    const int line =
        plan_->ends.empty() ? status.executed_blocks : static_cast<int>(now - plan_->ends.begin());
    place.line = std::min((place.sending ? status.sent_blocks : line) + 1, place.lines);
    place.share = place.sending          ? static_cast<double>(status.sent_blocks) / place.lines
                  : place.duration > 0.0 ? place.time / place.duration
                                         : static_cast<double>(status.executed_blocks) / place.lines;
    return place;
}

} // namespace millwright::actions
