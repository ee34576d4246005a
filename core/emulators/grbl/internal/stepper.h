// What an emulated Grbl does with its planned blocks: cuts them into segments of 10 ms, keeps some of them
// ready, and moves along them. So the planner is always a little ahead of the machine, as in the real one.
// mm, s.
#pragma once

#include "core/emulators/grbl/internal/planner.h"

#include <deque>
#include <functional>
#include <utility>

namespace millwright::emulators::internal {

class Stepper {
public:
    /// Called with the owner of a block that has been executed to its end.
    using BlockDone = std::function<void(std::int64_t owner)>;

    /// `most_segments`: that are kept ready.
    Stepper(Planner& planner, std::size_t most_segments, BlockDone done)
        : planner_(planner), most_segments_(most_segments), done_(std::move(done)) {}

    [[nodiscard]] const Axes& position() const { return position_; }
    /// Of the motion being prepared, mm/s.
    [[nodiscard]] double speed() const { return speed_; }
    [[nodiscard]] bool at_rest() const { return segments_.empty() && !(speed_ > 0.0); }
    /// Whether a hold has come to rest.
    [[nodiscard]] bool held() const { return holding_ && at_rest(); }
    [[nodiscard]] double travelled() const { return travelled_; }

    /// Brakes at the blocks' accelerations, along them; resume() goes on.
    void hold() { holding_ = true; }
    void resume() { holding_ = false; }
    /// At once: forgets segments and planned blocks.
    void halt();
    void stand_at(const Axes& position);

    /// How long the segment under way still takes, after making sure that there is one if anything moves; 0
    /// at rest.
    [[nodiscard]] double next_event();
    /// Moves on by `seconds`, at most next_event().
    void advance(double seconds);

private:
    struct Segment {
        Axes from{}, to{};
        double duration = 0.0;
        std::int64_t owner = -1;
        bool ends_block = false;
    };

    void prepare();
    void prepare_segment();
    [[nodiscard]] double go(const PlannedBlock& block, double time);

    Planner& planner_;
    std::size_t most_segments_;
    BlockDone done_;
    std::deque<Segment> segments_;
    double passed_ = 0.0; ///< of the first segment
    double offset_ = 0.0; ///< into the planner's first block, of what is prepared
    double speed_ = 0.0;  ///< there
    bool holding_ = false;
    Axes position_{};
    double travelled_ = 0.0;
};

} // namespace millwright::emulators::internal
