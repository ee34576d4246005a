// The virtual machine's pauses: where a program waits for a person.
#include "core/drivers/pause.h"
#include "core/drivers/virtual_machine/internal/virtual_axes.h"

#include <algorithm>
#include <limits>

namespace millwright::drivers::internal {

/// The first from `block` on that waits, as the switch for optional stops is now.
void VirtualAxes::look_for_pause(int block) {
    const auto waits = [&](const program::Block& candidate) {
        return candidate.kind == program::BlockKind::pause &&
               (candidate.pause != program::PauseKind::optional_stop || optional_stop_);
    };
    const auto& blocks = work_.program->blocks;
    const auto found = std::find_if(blocks.begin() + block, blocks.end(), waits);
    pause_ = static_cast<int>(found - blocks.begin());
}

/// In `now_`, which is planned to rest there. A motion that begins behind it was planned from its very place.
double VirtualAxes::time_of_pause() const {
    const bool pauses = activity_ == Activity::program && state_ == DriverState::running;
    if (!pauses || pause_ > now_->last_block()) {
        return std::numeric_limits<double>::infinity();
    }
    return pause_ < now_->first_block() ? 0.0 : now_->end_of(pause_);
}

void VirtualAxes::wait_for_person() {
    pace_ = Pace::at_pause;
    rest_position_ = now_->at(time_).position;
    take_accessories(pause_);
    state_ = DriverState::holding;
    message_ = reason_of_pause(*work_.program, work_.listing.get(), pause_);
}

/// One that is passed already is passed.
void VirtualAxes::set_optional_stop(bool on) {
    optional_stop_ = on;
    if (pace_ == Pace::at_pause || activity_ != Activity::program || now_ == nullptr) {
        return; // it is looked at again before the axes go on
    }
    look_for_pause(now_->block_at(time_));
    pause_at_ = time_of_pause();
}

} // namespace millwright::drivers::internal
