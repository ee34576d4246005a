#include "core/simulation/collision.h"

#include "core/base/parallel.h"
#include "core/kinematics/forward.h"
#include "core/simulation/internal/collision_pair.h"
#include "core/simulation/internal/collision_pairs.h"
#include "core/simulation/internal/remaining_stock.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <tuple>
#include <utility>

namespace millwright::simulation {

namespace {

using kinematics::MachineModel;

/// What one move showed of one pair.
struct PairEvent {
    std::size_t pair = 0;
    int block = 0;
    Approach approach;
    bool first = false;            // nothing was looked at before
    std::optional<double> depth{}; // of what is found in the remaining stock
};

/// A pair on a move; `first`: they may be in each other from the start.
std::optional<Approach>
approach_of(const CollisionPair& pair, const RelativeMotion& motion, double clearance, bool first) {
    std::optional<Approach> found = pair.approach(motion, clearance);
    if (first && !(found && found->contact) && pair.is_inside(motion)) {
        found = Approach{0.0, true, {0.0, motion.at(0.0) * pair.ball().center}};
    }
    return found;
}

class CollisionRun {
public:
    CollisionRun(const CollisionInput& input, const Progress& progress) : input_(input), progress_(progress) {
        for (const CollisionTool& tool : input.tools) {
            const MachineModel& machine = tool.machine ? *tool.machine : input.machine;
            setups_.push_back(
                {tool.first_block, &machine, pairs_of(machine, tool, input, report_.unchecked)});
            report_.pairs = std::max(report_.pairs, static_cast<int>(setups_.back().pairs.size()));
        }
        std::sort(report_.unchecked.begin(), report_.unchecked.end());
        report_.unchecked.erase(std::unique(report_.unchecked.begin(), report_.unchecked.end()),
                                report_.unchecked.end());
    }

    CollisionReport finish() {
        constexpr int blocks_at_a_time = 4096;
        const int count = input_.program.block_count();
        std::vector<int> moves;
        for (int n = input_.first_block; n < count; ++n) {
            if (input_.program.blocks[static_cast<std::size_t>(n)].moves()) {
                moves.push_back(n);
            }
            if (std::ssize(moves) == blocks_at_a_time || n + 1 == count) {
                look(moves);
                moves.clear();
                done_ = searched * (n + 1.0 - input_.first_block) / (count - input_.first_block);
                progress_.report(done_);
            }
        }
        measure();
        progress_.report(1.0);
        return std::move(report_);
    }

private:
    static constexpr double searched = 0.8;   // of the progress
    static constexpr int most_renewals = 200; // of a mesh of what is left: up to a second each

    struct Setup {
        int first_block = 0;
        const MachineModel* machine = nullptr;
        std::vector<CollisionPair> pairs;
    };

    /// A row of moves on which a pair meets, or comes near.
    struct Row {
        const Setup* setup = nullptr;
        std::size_t pair = 0;
        std::vector<PairEvent> events;
    };

    [[nodiscard]] const Setup* setup_at(int block) const {
        const Setup* found = nullptr;
        for (const Setup& setup : setups_) {
            found = setup.first_block <= block ? &setup : found;
        }
        return found;
    }

    [[nodiscard]] const kinematics::AxisPositions& before(int block) const {
        return program::position_before(input_.program, block);
    }
    [[nodiscard]] const kinematics::AxisPositions& after(int block) const {
        return input_.program.blocks[static_cast<std::size_t>(block)].target;
    }
    [[nodiscard]] int line_of(int block) const {
        return input_.program.blocks[static_cast<std::size_t>(block)].source_line;
    }

    [[nodiscard]] std::vector<PairEvent> events_of(int block, const Setup& setup, bool first) const {
        std::vector<PairEvent> events;
        std::optional<RelativeMotion> motion;
        const CollisionPair* with_motion = nullptr;
        for (std::size_t n = 0; n < setup.pairs.size(); ++n) {
            const CollisionPair& pair = setup.pairs[n];
            if (with_motion == nullptr || !pair.moves_as(*with_motion)) {
                motion.emplace(
                    *setup.machine, before(block), after(block), pair.moving_carrier(), pair.still_carrier());
                with_motion = &pair;
            }
            if (!first && motion->rests()) {
                continue;
            }
            if (const auto found = approach_of(pair, *motion, input_.clearance, first)) {
                events.push_back({n, block, *found, first});
            }
        }
        return events;
    }

    void look(const std::vector<int>& moves) {
        std::vector<std::vector<PairEvent>> events(moves.size());
        constexpr std::ptrdiff_t moves_per_chunk = 32;
        parallel_for(std::ssize(moves), moves_per_chunk, [&](std::ptrdiff_t n) {
            progress_.check();
            const int block = moves[static_cast<std::size_t>(n)];
            if (const Setup* setup = setup_at(block)) {
                const bool first = n == 0 ? report_.moves == 0 || setup != last_
                                          : setup != setup_at(moves[static_cast<std::size_t>(n) - 1]);
                events[static_cast<std::size_t>(n)] = events_of(block, *setup, first);
            }
        });
        for (std::size_t n = 0; n < moves.size(); ++n) {
            look_at_limits(moves[n]);
            if (input_.removal != nullptr) {
                compare_with_rest(events[n]);
            }
            take(moves[n], events[n]);
            last_ = setup_at(moves[n]);
            ++report_.moves;
        }
    }

    /// Events with the uncut stock become those with what is left of it before their block, or go.
    void compare_with_rest(std::vector<PairEvent>& events) {
        std::vector<PairEvent> kept;
        for (PairEvent& event : events) {
            const Setup& setup = *setup_at(event.block);
            if (!setup.pairs[event.pair].has_stock() || is_in_rest(setup, event)) {
                kept.push_back(event);
            }
        }
        events = std::move(kept);
    }

    /// By the surface of what is left. What that does not show, the blocks may: they have all material of
    /// the lines.
    bool is_in_rest(const Setup& setup, PairEvent& event) {
        const Progress here = progress_.part(done_, done_);
        if (!rest_) {
            rest_.emplace(*input_.removal, here);
        }
        rest_->advance_to(event.block, here);
        const auto found = found_in(RemainingStock::Shape::surface, setup, event, here);
        if (found && found->approach.contact) {
            event = *found;
            return true;
        }
        const auto in_blocks = found_in(RemainingStock::Shape::blocks, setup, event, here);
        if (in_blocks && (in_blocks->approach.contact || !found)) {
            event = *in_blocks;
            return true;
        }
        event = found.value_or(event);
        return found.has_value();
    }

    /// The event with what is left in this shape; nullopt where they stay apart.
    std::optional<PairEvent>
    found_in(RemainingStock::Shape shape, const Setup& setup, PairEvent event, const Progress& here) {
        const CollisionPair& uncut = setup.pairs[event.pair];
        const RelativeMotion motion = motion_of({&setup, event.pair, {}}, event.block);
        int& renewals = renewals_[shape];
        while (rest_->mesh(shape)) {
            progress_.check();
            const CollisionPair pair = uncut.with_stock(rest_->mesh(shape));
            const auto found = approach_of(pair, motion, input_.clearance, event.first);
            if (!found) {
                return std::nullopt;
            }
            event.approach = *found;
            if (renewals == most_renewals || rest_->is_current_near(in_workpiece(setup, event), shape)) {
                event.depth = found->contact ? deepest_of(pair, motion, found->time) : 0.0;
                return event;
            }
            rest_->renew(shape, here);
            if (++renewals == most_renewals) {
                report_.unchecked.push_back(fmt::format(
                    "from line {} on, machine bodies are compared with the stock that is left before "
                    "it: later cuts may have removed what they meet",
                    line_of(event.block)));
            }
        }
        return std::nullopt;
    }

    /// At a few moments from `begin` on.
    static double deepest_of(const CollisionPair& pair, const RelativeMotion& motion, double begin) {
        constexpr int moments = 9;
        double deepest = -1.0, time = begin;
        for (int k = 0; k < moments; ++k) {
            const double t = begin + (1.0 - begin) * k / (moments - 1);
            const double depth = pair.depth(motion.at(t), CollisionPair::Care::rough);
            time = depth > deepest ? t : time;
            deepest = std::max(deepest, depth);
        }
        return std::max(pair.depth(motion.at(time), CollisionPair::Care::close), 0.0);
    }

    void look_at_limits(int block) {
        for (int n = 0; n < input_.machine.axis_count(); ++n) {
            constexpr double rounding = 1e-6; // mm or rad: positions are read from text
            const kinematics::MachineAxis& axis = input_.machine.axis(n);
            const double position = after(block)[n];
            const bool below = position < axis.min - rounding;
            if (!below && !(position > axis.max + rounding)) {
                beyond_.erase(n);
                continue;
            }
            const double limit = below ? axis.min : axis.max;
            const auto open = beyond_.find(n);
            if (open == beyond_.end()) {
                beyond_[n] = report_.limits.size();
                report_.limits.push_back(
                    {axis.letter, block, line_of(block), line_of(block), position, limit, 1});
                continue;
            }
            LimitViolation& violation = report_.limits[open->second];
            violation.last_line = line_of(block);
            ++violation.moves;
            if (std::abs(position - limit) > std::abs(violation.position - violation.limit)) {
                violation.position = position;
                violation.limit = limit;
            }
        }
    }

    /// Adds the events of a move to the rows that go on, and begins new ones.
    void take(int block, const std::vector<PairEvent>& events) {
        const Setup* setup = setup_at(block);
        std::map<Key, std::size_t> next;
        for (const PairEvent& event : events) {
            const Key key{setup, event.pair, event.approach.contact};
            const auto open = open_.find(key);
            const std::size_t row = open == open_.end() ? rows_.size() : open->second;
            if (row == rows_.size()) {
                rows_.push_back({setup, event.pair, {}});
            }
            rows_[row].events.push_back(event);
            next[key] = row;
        }
        open_ = std::move(next);
    }

    /// How deep the bodies of each row meet, on the moves of a sample that goes over all of it.
    void measure() {
        std::vector<Collision> found(rows_.size());
        parallel_for(std::ssize(rows_), 1, [&](std::ptrdiff_t n) {
            progress_.check();
            found[static_cast<std::size_t>(n)] = collision_of(rows_[static_cast<std::size_t>(n)]);
        });
        for (std::size_t n = 0; n < rows_.size(); ++n) {
            (rows_[n].events.front().approach.contact ? report_.collisions : report_.near_misses)
                .push_back(found[n]);
        }
    }

    [[nodiscard]] Collision collision_of(const Row& row) const {
        const CollisionPair& pair = row.setup->pairs[row.pair];
        const bool contact = row.events.front().approach.contact;
        const auto shown = contact ? row.events.begin()
                                   : std::ranges::min_element(row.events, {}, [](const PairEvent& event) {
                                         return event.approach.at.distance;
                                     });
        Collision collision{.moving = pair.moving_name(), .still = pair.still_name()};
        collision.block = collision.deepest_block = shown->block;
        collision.line = line_of(shown->block);
        collision.time = shown->approach.time;
        collision.rapid =
            input_.program.blocks[static_cast<std::size_t>(shown->block)].kind == program::BlockKind::rapid;
        collision.place = in_workpiece(*row.setup, *shown);
        collision.last_line = line_of(row.events.back().block);
        collision.moves = static_cast<int>(row.events.size());
        collision.depth = contact ? 0.0 : shown->approach.at.distance;
        if (contact && shown->depth) {
            const auto deepest = std::ranges::max_element(
                row.events, {}, [](const PairEvent& event) { return event.depth.value_or(0.0); });
            collision.depth = deepest->depth.value_or(0.0);
            collision.deepest_block = deepest->block;
        } else if (contact) {
            find_depth(row, collision);
        }
        collision.deepest_line = line_of(collision.deepest_block);
        return collision;
    }

    [[nodiscard]] RelativeMotion motion_of(const Row& row, int block) const {
        const CollisionPair& pair = row.setup->pairs[row.pair];
        return {
            *row.setup->machine, before(block), after(block), pair.moving_carrier(), pair.still_carrier()};
    }

    /// Of a few moves the deepest of a few moments; around it closer and closer.
    void find_depth(const Row& row, Collision& collision) const {
        const CollisionPair& pair = row.setup->pairs[row.pair];
        constexpr std::size_t most_moves = 24;
        const std::size_t step = (row.events.size() + most_moves - 1) / most_moves;
        const int moments = row.events.size() > 1 ? 3 : 9;
        double deepest = -1.0, time = 0.0;
        for (std::size_t n = 0; n < row.events.size(); n += step) {
            progress_.check();
            const int block = row.events[n].block;
            const RelativeMotion motion = motion_of(row, block);
            const double begin = row.events[n].approach.time;
            for (int k = 0; k < moments; ++k) {
                const double t = begin + (1.0 - begin) * k / (moments - 1);
                const double depth = pair.depth(motion.at(t), CollisionPair::Care::rough);
                if (depth > deepest) {
                    deepest = depth;
                    time = t;
                    collision.deepest_block = block;
                }
            }
        }
        const RelativeMotion motion = motion_of(row, collision.deepest_block);
        constexpr double closest = 1e-4;
        for (double around = 0.5 / (moments - 1); around > closest; around *= 0.5) {
            progress_.check();
            for (const double t : {time - around, time + around}) {
                const double depth =
                    t >= 0.0 && t <= 1.0 ? pair.depth(motion.at(t), CollisionPair::Care::rough) : -1.0;
                if (depth > deepest) {
                    deepest = depth;
                    time = t;
                    break;
                }
            }
        }
        collision.depth = std::max(pair.depth(motion.at(time), CollisionPair::Care::close), 0.0);
    }

    [[nodiscard]] Vec3 in_workpiece(const Setup& setup, const PairEvent& event) const {
        const CollisionPair& pair = setup.pairs[event.pair];
        const kinematics::AxisPositions now =
            before(event.block) + event.approach.time * (after(event.block) - before(event.block));
        const Vec3 in_m =
            kinematics::carrier_motion(*setup.machine, now, pair.still_carrier()) * event.approach.at.place;
        return kinematics::m_T_w(*setup.machine, now).inverse() * in_m;
    }

    using Key = std::tuple<const Setup*, std::size_t, bool>;

    const CollisionInput& input_;
    const Progress& progress_;
    CollisionReport report_;
    std::vector<Setup> setups_;
    const Setup* last_ = nullptr;
    std::optional<RemainingStock> rest_;            // from the first event with the stock on
    std::map<RemainingStock::Shape, int> renewals_; // of its meshes
    double done_ = 0.0;                             // of the progress
    std::vector<Row> rows_;
    std::map<Key, std::size_t> open_;
    std::map<int, std::size_t> beyond_; // axes that are beyond a limit now, and their violation
};

} // namespace

CollisionReport check_collisions(const CollisionInput& input, const Progress& progress) {
    return CollisionRun(input, progress).finish();
}

} // namespace millwright::simulation
