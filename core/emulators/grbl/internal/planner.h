// The look-ahead of an emulated Grbl: 15 blocks (or more), straight lines in all axes, speeds in the corners
// by junction deviation. mm, of rotary axes degrees, s.
#pragma once

#include "core/emulators/grbl/internal/eeprom.h"

#include <cstdint>
#include <deque>
#include <functional>
#include <optional>
#include <utility>

namespace millwright::emulators::internal {

/// What the parser asks for.
struct Move {
    Axes target{};           ///< machine coordinates
    bool rapid = false;      ///<
    bool overridable = true; ///< by the feed override; jogs are not
    double rate = 0.0;       ///< mm/s, or 1/s with `inverse_time`
    bool inverse_time = false;
    std::int32_t line_number = 0;
    std::int64_t owner = -1; ///< the line of the truth log that it belongs to
};

struct PlannedBlock {
    Move move;
    Axes from{}, unit{};
    double length = 0.0;
    double acceleration = 0.0;
    double fastest = 0.0;    ///< that the axes allow
    double top_corner = 0.0; ///< greatest speed at its beginning by the corner alone, whatever the overrides
    double entry = 0.0;      ///< planned speed at its beginning
};

struct PlannerOverrides {
    int feed = 100, rapid = 100; ///< percent
};

class Planner {
public:
    Planner(const Eeprom& eeprom, int capacity) : eeprom_(&eeprom), capacity_(capacity) {}

    [[nodiscard]] int capacity() const { return capacity_; }
    [[nodiscard]] int free_blocks() const { return capacity_ - static_cast<int>(blocks_.size()); }
    [[nodiscard]] bool empty() const { return blocks_.empty(); }
    [[nodiscard]] const PlannedBlock& first() const { return blocks_.front(); }
    /// Where the last planned block ends.
    [[nodiscard]] const Axes& position() const { return position_; }
    /// Speed that `block` goes for now.
    [[nodiscard]] double nominal_speed(const PlannedBlock& block) const;
    /// Speed with which the first block shall end.
    [[nodiscard]] double exit_speed() const;

    /// Adds a block; one shorter than a step of every axis is left out (false). There must be room.
    bool add(const Move& move);
    /// The first block is done.
    void drop_first();
    void clear();
    /// Forgets where planned motion ends: the machine stands at `position`.
    void stand_at(const Axes& position);
    void set_overrides(const PlannerOverrides& overrides);
    /// The first block goes on from `offset` at `speed`.
    void replan(double offset, double speed);

private:
    [[nodiscard]] double corner_speed(const PlannedBlock& before, const PlannedBlock& after) const;
    [[nodiscard]] double limit_along(int first_setting, const Axes& unit) const;
    void plan_speeds();

    const Eeprom* eeprom_;
    int capacity_;
    PlannerOverrides overrides_;
    std::deque<PlannedBlock> blocks_;
    Axes position_{};
    double offset_ = 0.0; ///< into the first block
    double speed_ = 0.0;  ///< there
};

// What an emulated Grbl does with its planned blocks: cuts them into segments of 10 ms, keeps some of them
// ready, and moves along them. So the planner is always a little ahead of the machine, as in the real one.
// mm, s.

class Stepper {
public:
    /// Called with the owner of a block that has been executed completely.
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
