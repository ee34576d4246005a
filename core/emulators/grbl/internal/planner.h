// The look-ahead of an emulated Grbl: 15 blocks (or more), straight lines in all axes, speeds in the corners
// by junction deviation. mm, of rotary axes degrees, s.
#pragma once

#include "core/emulators/grbl/internal/eeprom.h"

#include <cstdint>
#include <deque>
#include <optional>

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

} // namespace millwright::emulators::internal
