#include "core/posts/prepare.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/gcode/inverse_time.h"
#include "core/kinematics/forward.h"
#include "core/program/number_format.h"
#include "core/program/retract.h"

#include <fmt/format.h>
#include <fmt/ranges.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::posts {

namespace {

using kinematics::AxisKind;
using kinematics::AxisPositions;
using kinematics::MachineModel;

void refuse_missing_axes(const program::Program& program, const PostFormat& format) {
    std::vector<char> missing;
    std::vector<char> known(format.axes.begin(), format.axes.end());
    for (const program::ProgramAxis& axis : program.axes) {
        if (format.axes.find(axis.letter) == std::string::npos) {
            missing.push_back(axis.letter);
        }
    }
    if (!missing.empty()) {
        throw Error(fmt::format("{} moves only {}, but the program for '{}' also moves {}",
                                format.name,
                                fmt::join(known, " "),
                                program.machine,
                                fmt::join(missing, " ")),
                    {},
                    "choose a post for a control with these axes");
    }
}

/// The rotary axes at the place where the workpiece stands as on the drawing.
AxisPositions at_rotary_zero(const MachineModel& machine, AxisPositions positions) {
    for (const int n : machine.rotary_axes()) {
        positions[n] = -machine.axis(n).zero_offset;
    }
    return positions;
}

constexpr int most_pieces = 4096; // of a move

class Preparer {
public:
    Preparer(const program::Program& program,
             const MachineModel& machine,
             const PostFormat& format,
             double tolerance)
        : machine_(machine), format_(format), tip_tolerance_(tolerance),
          all_(program::AxisSet::all(machine.axis_count())), digits_{format.numbers.length.decimals,
                                                                     format.numbers.angle.decimals,
                                                                     format.length_unit()} {
        result_.program.machine = program.machine;
        result_.program.axes = program.axes;
        result_.program.start = program.start;
        result_.program.tool = program.tool;
        result_.program.cutters = program.cutters;
        result_.program.blocks.reserve(program.blocks.size());
        result_.program_words.blocks.reserve(program.blocks.size());
        meant_ = program.start;
    }

    /// `without_tip`: in machine positions.
    void add(program::Block block, bool without_tip) {
        if (!block.moves()) {
            block.target = here();
            append(std::move(block), false);
            return;
        }
        const AxisPositions meant_from = std::exchange(meant_, block.target);
        block.target = with_named(rounded(block.target), block.named);
        if (block.kind == program::BlockKind::feed) {
            if (!block.programmed_speed && goes_nowhere(block)) {
                return; // too short to be written
            }
            if (block.programmed_speed) {
                // has no length that its time could be kept for
            } else if (format_.feed.mode == FeedWriting::per_minute) {
                keep_speed(block, meant_from);
            } else {
                keep_to_digits(block);
                keep_time_of_turn(block);
            }
        }
        moved_ = true;
        for (int n = 0; n < machine_.axis_count(); ++n) {
            if (block.named.contains(n)) {
                named_.insert(n);
            }
        }
        if (format_.positions == PositionsOf::axes || without_tip) {
            tip_ = false;
            retracted_ = true;
            append(std::move(block), false);
        } else {
            if (!machine_.rotary_axes().empty()) {
                if (block.kind == program::BlockKind::rapid && !(named_ == all_)) {
                    before_ = block.target; // until all are named: the text begins with a retract anyway
                    return;
                }
                expect_all_named(block);
                block.named = all_; // whatever turns, the tip's three coordinates change
            }
            before_.reset();
            add_for_tip(std::move(block));
        }
    }

    PreparedProgram take() { return std::move(result_); }

private:
    const MachineModel& machine_;
    const PostFormat& format_;
    double tip_tolerance_; ///< of feeds, mm; 0: they are not cut
    program::AxisSet all_;
    program::WrittenDigits digits_;
    PreparedProgram result_;
    AxisPositions meant_; ///< where the last move ended before it was rounded
    bool tip_ = false;
    bool moved_ = false;
    program::AxisSet named_;              ///< so far: where these are is known
    std::optional<AxisPositions> before_; ///< the place that the first move of the tip is relative to
    bool retracted_ = false;              ///< in machine positions
    bool from_anywhere_ = false;          ///< the tip goes to its first place

    /// The tip is where all axes are.
    void expect_all_named(const program::Block& block) const {
        for (int n = 0; n < machine_.axis_count(); ++n) {
            if (!named_.contains(n) || block.programmed_speed) {
                throw Error(Diagnostic{{{}, block.source_line, 0, -1},
                                       fmt::format("{} uses tool-tip positions, but the program does not "
                                                   "specify {} before its first move",
                                                   format_.name,
                                                   machine_.axis(n).letter),
                                       "start with rapids that specify all axes of the machine"});
            }
        }
    }

    /// Rounded ends make a move a little longer or shorter: its speed stays, so that a feed stays the feed.
    /// The tip goes as far as the linear axes as long as nothing turns.
    void keep_speed(program::Block& block, const AxisPositions& meant_from) const {
        const bool of_tip = format_.positions == PositionsOf::tip;
        const bool turns = std::ranges::any_of(machine_.rotary_axes(), [&](int n) {
            return std::abs(meant_[n] - meant_from[n]) > 0.0 || std::abs(block.target[n] - here()[n]) > 0.0;
        });
        const FeedWay meant = feed_way(result_.program.axes, meant_from, meant_);
        const FeedWay now = of_tip ? feed_way(result_.program.axes, words(here()), words(block.target))
                                   : feed_way(result_.program.axes, here(), block.target);
        if (!(of_tip && (turns || before_)) && !meant.angular && !now.angular && meant.length > 0.0 &&
            now.length > 0.0) {
            block.duration *= now.length / meant.length;
        }
    }

    /// Inverse time is rounded down to what is written, or up to the smallest that can be.
    void keep_to_digits(program::Block& block) const {
        constexpr double seconds_per_minute = 60.0;
        constexpr double same = 1e-6; // of a digit: it was rounded before
        const double digits = seconds_per_minute / block.duration / format_.numbers.feed.digit();
        const double steps = std::max(1.0, std::floor(digits + same));
        if (std::abs(digits - steps) > same) {
            block.duration = seconds_per_minute / (steps * format_.numbers.feed.digit());
        }
    }

    /// While axes turn by much and the tool goes by next to nothing, a control that takes the feed of the
    /// latter for too small would make the turn too fast: it is written as a turn alone, the rest of the way
    /// with the next move.
    void keep_time_of_turn(program::Block& block) const {
        constexpr double next_to_nothing = 2e-3; // mm
        constexpr double seconds_per_minute = 60.0;
        const FeedWay way = feed_way(result_.program.axes, here(), block.target);
        const double a_minute = way.length / format_.length_unit() / block.duration * seconds_per_minute;
        if (format_.positions != PositionsOf::axes || way.angular || way.length > next_to_nothing ||
            !(a_minute < gcode::least_inverse_time_feed)) {
            return;
        }
        AxisPositions turned = here();
        for (const int n : machine_.rotary_axes()) {
            turned[n] = block.target[n];
        }
        if ((turned - here()).cwiseAbs().maxCoeff() > 0.0) {
            block.target = turned;
        }
    }

    [[nodiscard]] bool goes_nowhere(const program::Block& block) const {
        const bool there = (block.target - here()).cwiseAbs().maxCoeff() <= 0.0;
        if (there && !moved_) {
            throw Error(fmt::format("block {}: a feed move to the assumed start position has no length, so "
                                    "no feed rate can be written",
                                    result_.program.block_count() + 1),
                        {},
                        "start the program with a rapid");
        }
        return there;
    }

    [[nodiscard]] const AxisPositions& here() const {
        return position_before(result_.program, result_.program.block_count());
    }

    [[nodiscard]] AxisPositions rounded(const AxisPositions& positions) const {
        return program::written(machine_, positions, digits_, result_.program.block_count());
    }

    /// Axes without a word stay where the text, or a rapid before it, has left them.
    [[nodiscard]] AxisPositions with_named(AxisPositions target, const program::AxisSet& named) const {
        const AxisPositions from = before_.value_or(here());
        for (int n = 0; n < machine_.axis_count(); ++n) {
            target[n] = named.contains(n) ? target[n] : from[n];
        }
        return target;
    }

    /// What the words say with the tip in place of X Y Z, as it will be read.
    [[nodiscard]] AxisPositions words(const AxisPositions& positions) const {
        const Vec3 tip = kinematics::forward(machine_, positions).tip;
        AxisPositions shown = positions;
        for (int n = 0; n < machine_.axis_count(); ++n) {
            const std::size_t along = std::string_view("XYZ").find(machine_.axis(n).letter);
            if (machine_.axis(n).kind == AxisKind::linear) {
                const double unit = format_.length_unit();
                shown[n] =
                    format_.numbers.length.rounded(tip[static_cast<Eigen::Index>(along)] / unit) * unit;
            }
        }
        return shown;
    }

    void append(program::Block block, bool tip) {
        const AxisPositions from = here();
        const AxisPositions& to = block.target;
        result_.program_words.blocks.push_back(tip ? BlockWords{words(from), words(to), true}
                                               : format_.positions == PositionsOf::tip
                                                   ? BlockWords{from, to, false}
                                                   // machine positions, whatever the tool
                                                   : BlockWords{program::programmed(result_.program, from),
                                                                program::programmed(result_.program, to),
                                                                false});
        result_.program.blocks.push_back(std::move(block));
    }

    void add_for_tip(program::Block block) {
        if (!std::exchange(tip_, true)) {
            switch_tip_on(block);
        }
        if (block.kind == program::BlockKind::rapid) {
            const bool whole = std::exchange(from_anywhere_, false);
            const int pieces = whole ? 1 : pieces_within(block, format_.tip->rapid_tolerance);
            cut(std::move(block), pieces);
        } else {
            const int pieces = tip_tolerance_ > 0.0 ? pieces_of_feed(block) : 1;
            cut(std::move(block), pieces);
        }
    }

    /// Before `block`: the rotary axes to zero with the tool out of their way, and before a feed a word about
    /// where the tip is.
    void switch_tip_on(const program::Block& block) {
        program::Block entry;
        entry.kind = program::BlockKind::rapid;
        entry.role = block.role;
        entry.source_line = block.source_line;
        entry.path = block.path;
        entry.target = here();
        if (!machine_.rotary_axes().empty()) {
            if (!retracted_) {
                retract(entry);
            }
            entry.target = rounded(at_rotary_zero(machine_, here()));
            entry.named = {};
            for (const int n : machine_.rotary_axes()) {
                entry.named.insert(n);
            }
            append(entry, false);
        }
        if (block.kind == program::BlockKind::feed && !block.programmed_speed) {
            entry.named = machine_.rotary_axes().empty() ? block.named : all_;
            append(std::move(entry), true);
        }
    }

    /// A program of somebody else's need not begin with it.
    void retract(program::Block entry) {
        from_anywhere_ = true;
        entry.named = program::AxisSet::only(program::retract_axis(machine_).axis);
        entry.target = rounded(program::retracted(machine_, here(), {}));
        append(std::move(entry), false);
    }

    /// By how much the tip's way leaves the straight line between its ends while the axes go straight.
    [[nodiscard]] double deviation(const AxisPositions& a, const AxisPositions& b) const {
        constexpr int samples = 15;
        const Vec3 begin = kinematics::forward(machine_, a).tip;
        const Vec3 way = kinematics::forward(machine_, b).tip - begin;
        double largest = 0.0;
        for (int k = 1; k <= samples; ++k) {
            const double t = static_cast<double>(k) / (samples + 1);
            const Vec3 off = kinematics::forward(machine_, a + t * (b - a)).tip - begin;
            const double square = way.squaredNorm();
            const double along = square > 0.0 ? std::clamp(off.dot(way) / square, 0.0, 1.0) : 0.0;
            largest = std::max(largest, (off - along * way).norm());
        }
        return largest;
    }

    /// A power of two: so many straight ways of the tip stay within `tolerance` of the axes' own, as far as
    /// `most_pieces` do.
    [[nodiscard]] int pieces_within(const program::Block& block, double tolerance) const {
        const AxisPositions from = here();
        const AxisPositions way = block.target - from;
        int pieces = 1;
        const auto at = [&](int k) -> AxisPositions { return from + static_cast<double>(k) / pieces * way; };
        const auto near_enough = [&] {
            for (int k = 0; k < pieces; ++k) {
                if (deviation(at(k), at(k + 1)) > tolerance) {
                    return false;
                }
            }
            return true;
        };
        while (!near_enough() && pieces < most_pieces) {
            pieces *= 2;
        }
        return pieces;
    }

    [[nodiscard]] int pieces_of_feed(const program::Block& block) const {
        const int pieces = pieces_within(block, tip_tolerance_);
        const AxisPositions step = (block.target - here()) / pieces;
        if (const double off = deviation(here(), here() + step); off > tip_tolerance_) {
            throw Error(Diagnostic{{{}, block.source_line, 0, -1},
                                   fmt::format("even in {} segments the tip deviates by {:.4f} mm from the "
                                               "path of straight axis moves, more than {:.4f}",
                                               pieces,
                                               off,
                                               tip_tolerance_),
                                   "use a larger tolerance"});
        }
        return pieces;
    }

    /// Each piece takes its share of the time.
    void cut(program::Block block, int pieces) {
        const AxisPositions from = here();
        const AxisPositions way = block.target - from;
        block.duration /= pieces;
        if (block.kind == program::BlockKind::feed && pieces > 1 &&
            format_.feed.mode == FeedWriting::inverse_time) {
            keep_to_digits(block);
        }
        for (int k = 1; k < pieces; ++k) {
            program::Block piece = block;
            piece.path_point = -1;
            piece.target = rounded(from + static_cast<double>(k) / pieces * way);
            append_for_tip(std::move(piece));
        }
        append_for_tip(std::move(block));
    }

    void append_for_tip(program::Block block) {
        if (block.kind == program::BlockKind::feed) {
            result_.tip_deviation = std::max(result_.tip_deviation, deviation(here(), block.target));
        }
        append(std::move(block), true);
    }
};

void check_letters_of_tip(const MachineModel& machine) {
    for (const int n : machine.linear_axes()) {
        if (std::string_view("XYZ").find(machine.axis(n).letter) == std::string_view::npos) {
            throw Error(
                fmt::format("tip positions can be written for axes X Y Z only, but machine '{}' has {}",
                            machine.name(),
                            machine.axis(n).letter));
        }
    }
}

/// G43 counts along Z alone.
void check_tool(const program::Program& program, const MachineModel& machine, const PostFormat& format) {
    if (program.tool && format.positions == PositionsOf::axes && !machine.compensates_along_z()) {
        throw Error(fmt::format("the control applies the tool length along +Z, but the tool of machine '{}' "
                                "points in another direction",
                                machine.name()),
                    {},
                    "set the tool number to 0: the tool is not called, and the positions include its length");
    }
}

} // namespace

/// Which blocks are written without tip control: the retracts at both ends. Nothing else may be, since a
/// machine position is where the program means it only if no offset is set.
class Ends {
public:
    Ends(const program::Program& program, const MachineModel& machine) {
        const program::RetractAxis retract = program::retract_axis(machine);
        const kinematics::MachineAxis& axis = machine.axis(retract.axis);
        const double limit = retract.sense > 0.0 ? axis.max : axis.min;
        const auto pulls_off = [&](const program::Block& block) {
            const bool ours =
                block.role == program::MoveRole::approach || block.role == program::MoveRole::retract;
            return block.kind == program::BlockKind::rapid &&
                   block.named == program::AxisSet::only(retract.axis) &&
                   (ours || exactly_equal(block.target[retract.axis], limit));
        };
        const auto stays = [&](const program::Block& block) { return !block.moves() || pulls_off(block); };
        const auto& blocks = program.blocks;
        first_ = static_cast<int>(std::find_if_not(blocks.begin(), blocks.end(), stays) - blocks.begin());
        last_ = static_cast<int>(blocks.rend() - std::find_if_not(blocks.rbegin(), blocks.rend(), stays)) - 1;
    }

    [[nodiscard]] bool contain(int block) const { return block < first_ || block > last_; }

private:
    int first_ = 0; ///< the first and last block under tip control
    int last_ = 0;
};

PreparedProgram prepare(const program::Program& program,
                        const MachineModel& machine,
                        const PostFormat& format,
                        double tip_tolerance) {
    expects(static_cast<int>(program.axes.size()) == machine.axis_count(), "a program is for its machine");
    refuse_missing_axes(program, format);
    if (format.positions == PositionsOf::tip) {
        check_letters_of_tip(machine);
    }
    check_tool(program, machine, format);
    const Ends ends(program, machine);
    Preparer preparer(program, machine, format, tip_tolerance);
    for (int n = 0; n < program.block_count(); ++n) {
        preparer.add(program.blocks[static_cast<std::size_t>(n)], ends.contain(n));
    }
    return preparer.take();
}

} // namespace millwright::posts
