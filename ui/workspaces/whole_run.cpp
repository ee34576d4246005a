#include "ui/workspaces/whole_run.h"

#include <algorithm>
#include <utility>

namespace millwright::actions {

WholeRun::WholeRun(std::function<void()> wake)
    : known_(std::make_shared<const Answer>()),
      rest_(std::make_unique<LatestWork<Wish, Answer>>(run_on, std::move(wake))) {}

WholeRun::Answer WholeRun::judged(const Wish& wish) {
    const cordic::Processor& processor = *wish.from;
    return {wish.from,
            cordic::report_of(processor, *wish.expected, wish.terms.clock_hz),
            cordic::time_stitches({.needle_rpm = wish.terms.needle_rpm},
                                  cordic::stitches_of(processor, wish.terms.clock_hz)),
            cordic::path_differences(processor, *wish.expected)};
}

WholeRun::Answer WholeRun::run_on(const Wish& wish, const Progress& progress) {
    const auto is_under_way = [](const cordic::Processor& processor) {
        return processor.state().stop == cordic::Stop::none && processor.state().clocks.total < most_clocks;
    };
    if (!is_under_way(*wish.from)) {
        return judged(wish);
    }
    const auto processor = std::make_shared<cordic::Processor>(*wish.from);
    while (is_under_way(*processor)) {
        progress.check();
        processor->run(std::min(clocks_at_once, most_clocks - processor->state().clocks.total));
    }
    return judged({processor, wish.expected, wish.terms});
}

void WholeRun::begin(const cordic::Processor& processor,
                     std::vector<cordic::ExactPoint> expected,
                     RunTerms terms) {
    rest_->forget();
    expected_ = std::make_shared<const std::vector<cordic::ExactPoint>>(std::move(expected));
    const auto beginning = std::make_shared<cordic::Processor>(processor);
    beginning->run(clocks_at_once);
    known_ = std::make_shared<const Answer>(judged({beginning, expected_, terms}));
    goes_on_ = beginning->state().stop == cordic::Stop::none;
    if (goes_on_) {
        rest_->want({beginning, expected_, terms});
    }
}

void WholeRun::judge(RunTerms terms) {
    if (!known_->processor) {
        return;
    }
    const Wish wish{known_->processor, expected_, terms};
    if (known_->processor->state().clocks.total > clocks_at_once || goes_on_) {
        goes_on_ = true;
        rest_->want(wish);
    } else {
        known_ = std::make_shared<const Answer>(judged(wish));
    }
}

void WholeRun::clear() {
    rest_->forget();
    known_ = std::make_shared<const Answer>();
    goes_on_ = false;
}

bool WholeRun::take() {
    if (!goes_on_) {
        return false;
    }
    const bool busy = rest_->busy(); // asked first: what is found meanwhile is taken the next time
    const auto found = rest_->answer();
    const bool newer = found && found != known_;
    known_ = newer ? found : known_;
    goes_on_ = busy;
    return newer || !busy;
}

} // namespace millwright::actions
