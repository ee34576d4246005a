#include "ui/actions/card_run.h"

#include <algorithm>
#include <utility>

namespace millwright::actions {

namespace {

constexpr double longest_wait = 2.0; // s
constexpr int ahead = 4;             // lines that may be executed beyond those that the driver is certain of

/// When `line` (from 0) begins.
double begin_of(const CardPlan& plan, int line) {
    return line > 0 ? plan.ends[static_cast<std::size_t>(line) - 1] : 0.0;
}

bool is_under_way(const machine::DriverStatus& status) {
    using machine::DriverState;
    return status.state == DriverState::holding ||
           (status.state == DriverState::running && status.activity == machine::Activity::program);
}

} // namespace

void CardRun::begin(CardPlan plan) {
    plan_ = std::move(plan);
    seen_ = false;
    elapsed_ = waited_ = 0.0;
    place_.reset();
}

void CardRun::follow(const machine::DriverStatus& status, double seconds) {
    const bool under_way = is_under_way(status);
    waited_ +=
        under_way || seen_ ? 0.0 : seconds; // what is told of the machine may be older than the program
    seen_ = seen_ || under_way;
    if (!under_way && (seen_ || waited_ > longest_wait)) {
        plan_.reset();
        place_.reset();
    }
    if (!plan_ || !seen_) {
        return;
    }
    const bool sending = status.sent_blocks < plan_->lines;
    if (status.state == machine::DriverState::running && !sending) {
        elapsed_ += seconds * 0.01 * status.overrides.feed;
    }
    if (!plan_->ends.empty()) {
        const int done = std::clamp(status.executed_blocks, 0, plan_->lines);
        elapsed_ = std::clamp(
            elapsed_, begin_of(*plan_, done), begin_of(*plan_, std::min(done + ahead + 1, plan_->lines)));
    }
    elapsed_ = plan_->duration > 0.0 ? std::min(elapsed_, plan_->duration) : elapsed_;
    place_ = place_by(status);
}

CardPlace CardRun::place_by(const machine::DriverStatus& status) const {
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
