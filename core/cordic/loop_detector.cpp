#include "core/cordic/loop_detector.h"

#include <algorithm>

namespace millwright::cordic {
namespace {

/// What the next clock does depends on all of the state but these.
ProcessorState without_counts(ProcessorState state) {
    state.clocks = {};
    state.instructions = 0;
    return state;
}

} // namespace

bool LoopDetector::came_back(const Processor& processor) {
    const CodeAddress at = processor.state().instruction_at;
    if (++looks_ != next_ && seen_ && seen_->state.instruction_at != at) {
        return false; // as nearly always
    }
    const ProcessorState now = without_counts(processor.state());
    if (seen_ && seen_->state == now && seen_->memory == processor.memory()) {
        return true;
    }
    if (looks_ == next_) {
        seen_ = {now, processor.memory()};
        looks_ = 0;
        next_ *= 2;
    }
    return false;
}

bool run_watched(Processor& processor, std::int64_t clocks) {
    LoopDetector watch;
    while (clocks > 0 && processor.state().stop == Stop::none) {
        clocks -= processor.run(std::min(clocks, LoopDetector::interval));
        if (processor.state().stop == Stop::none && watch.came_back(processor)) {
            return true;
        }
    }
    return false;
}

} // namespace millwright::cordic
