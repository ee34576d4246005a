// The moves of a program on their way: each starts and ends on a ramp of its own, and two that are blended
// share the time in which one ends and the next begins, so that their motions add up. Axes in their own
// units, s.
#pragma once

#include "core/geometry/vectors.h"
#include "core/pmac/emulator/internal/ramp.h"

#include <array>
#include <deque>
#include <optional>

namespace millwright::pmac::card {

inline constexpr int axis_count = 9;
/// X Y Z A B C U V W.
using Axes = std::array<double, axis_count>;

/// About `normal`, through X Y Z.
struct Arc {
    Vec3 center = Vec3::Zero();
    Vec3 normal = Vec3::UnitZ();
    double angle = 0.0; ///< right-handed
    double last_radius = 0.0;
};

struct Move {
    Axes from{}, to{};
    std::optional<Arc> arc;
    double time = 0.0;          ///< at its feed, without ramps; no less than `ramp.time`
    Ramp ramp;                  ///< how it begins
    std::optional<Ramp> stop{}; ///< how it ends if none follows; nothing: as it begins
    bool blends = true;         ///< with what comes behind it

    /// At the fraction `u` of its way.
    [[nodiscard]] Axes at(double u) const;
};

class Path {
public:
    void begin(const Axes& position);
    /// Whether another move can be taken: one is on its way, one waits.
    [[nodiscard]] bool room() const { return waiting_ == 0; }
    void add(const Move& move);
    void advance(double seconds);

    [[nodiscard]] const Axes& position() const { return position_; }
    [[nodiscard]] bool empty() const { return moves_.empty(); }
    /// A move that is added now is blended with the one before it.
    [[nodiscard]] bool blends_on() const { return !moves_.empty() && !late_ && moves_.back().move.blends; }
    /// The last move that there is brakes: it came too late for another one to be blended with it.
    [[nodiscard]] bool braking() const { return late_ && !moves_.empty() && moves_.front().move.blends; }

private:
    struct Active {
        Move move;
        Ramp out;            ///< how it ends
        double begun = -1.0; ///< when; negative: it waits
        [[nodiscard]] double out_begin() const { return 0.5 * move.ramp.time + move.time - 0.5 * out.time; }
        [[nodiscard]] double end() const { return out_begin() + out.time; }
    };
    void start_next();

    std::deque<Active> moves_;
    int waiting_ = 0;
    double time_ = 0.0;
    bool late_ = false;
    Axes base_{}; ///< where the first of the moves begins
    Axes position_{};
};

} // namespace millwright::pmac::card
