#include "core/posts/read_back.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/units.h"
#include "core/gcode_programs/klartext.h"
#include "core/gcode_programs/written_steps.h"
#include "core/posts/arc_fit.h"

#include <fmt/format.h>

#include <cmath>
#include <utility>

namespace millwright::posts {

namespace {

using kinematics::AxisKind;
using kinematics::AxisPositions;

constexpr double text_rounding = 1e-7; // mm or degrees: of the arithmetic between text and position

std::size_t axis_of(char letter) {
    return static_cast<std::size_t>(
        std::find(gcode::axis_letters.begin(), gcode::axis_letters.end(), letter) -
        gcode::axis_letters.begin());
}

/// The same of the tool's length.
constexpr double strange_length = 5003.0; // mm

/// Far from everything, so that a position that leaves it out is found.
gcode::AxisValues strange_work_offset() {
    gcode::AxisValues offset;
    offset[gcode::Axis::x] = 1009.0;
    offset[gcode::Axis::y] = -2003.0;
    offset[gcode::Axis::z] = 3001.0;
    offset[gcode::Axis::a] = 7.0;
    offset[gcode::Axis::b] = -11.0;
    offset[gcode::Axis::c] = 13.0;
    return offset;
}

std::string_view name_of(gcode::StepKind kind) {
    switch (kind) {
    case gcode::StepKind::rapid:
        return "a rapid";
    case gcode::StepKind::feed:
        return "a feed";
    case gcode::StepKind::arc:
        return "an arc";
    case gcode::StepKind::tool:
        return "a tool call";
    case gcode::StepKind::spindle_on:
        return "spindle on";
    case gcode::StepKind::spindle_off:
        return "spindle off";
    case gcode::StepKind::coolant_on:
        return "coolant on";
    case gcode::StepKind::coolant_off:
        return "coolant off";
    case gcode::StepKind::dwell:
        return "a dwell";
    case gcode::StepKind::pause:
        return "a pause";
    case gcode::StepKind::end:
        return "the end";
    }
    return "nothing";
}

gcode::StepKind step_of(program::BlockKind kind) {
    switch (kind) {
    case program::BlockKind::spindle_on:
        return gcode::StepKind::spindle_on;
    case program::BlockKind::spindle_off:
        return gcode::StepKind::spindle_off;
    case program::BlockKind::coolant_on:
        return gcode::StepKind::coolant_on;
    case program::BlockKind::coolant_off:
        return gcode::StepKind::coolant_off;
    case program::BlockKind::dwell:
        return gcode::StepKind::dwell;
    case program::BlockKind::pause:
        return gcode::StepKind::pause;
    case program::BlockKind::rapid:
        return gcode::StepKind::rapid;
    case program::BlockKind::feed:
        return gcode::StepKind::feed;
    case program::BlockKind::end:
    case program::BlockKind::comment:
        break;
    }
    return gcode::StepKind::end;
}

class Comparison {
public:
    Comparison(const program::Program& program,
               const ProgramWords& program_words,
               const PostFormat& format,
               double arc_tolerance,
               const std::filesystem::path& file)
        : program_(program), program_words_(program_words), format_(format), arc_tolerance_(arc_tolerance),
          file_(file) {
        if (format.positions == PositionsOf::tip) {
            work_offset_ = strange_work_offset();
        }
        // Of Fanuc's and Heidenhain's tip control the length is the control's affair.
        const bool counts = format.reader == TextReader::linuxcnc || format.positions == PositionsOf::axes;
        if (program.tool && !format.blocks.tool.empty() && counts) {
            tool_offset_[gcode::Axis::z] = strange_length;
        }
        at_ = strange_start();
    }

    void compare(const program::Listing& listing) {
        steps_ = read(listing);
        compare_tool();
        auto arc = program_words_.arcs.begin();
        for (block_ = 0; block_ < program_.block_count(); ++block_) {
            const program::Block& block = program_.blocks[static_cast<std::size_t>(block_)];
            if (arc != program_words_.arcs.end() && arc->first == block_) {
                compare_arc(*arc);
                block_ = arc++->last;
            } else if (block.kind != program::BlockKind::comment) {
                compare_block(block);
            }
        }
        if (next_ < steps_.size()) {
            --block_;
            differ(fmt::format("{} follows the last block", name_of(steps_[next_].kind)));
        }
    }

private:
    const program::Program& program_;
    const ProgramWords& program_words_;
    const PostFormat& format_;
    double arc_tolerance_;
    const std::filesystem::path& file_;
    gcode::AxisValues work_offset_;
    gcode::AxisValues tool_offset_; ///< that the text has to call
    std::vector<gcode::WrittenStep> steps_;
    std::size_t next_ = 0;
    gcode::AxisValues at_;   ///< the last position that was read
    program::AxisSet known_; ///< axes of which the text has said where they are
    int block_ = 0;

    [[noreturn]] void differ(const std::string& what) const {
        const int line = next_ < steps_.size() ? steps_[next_].line : steps_.empty() ? 0 : steps_.back().line;
        throw Error({{file_, line, 0, -1},
                     fmt::format("block {}: {}", block_ + 1, what),
                     "the text read back differs from the program; it is not released"});
    }

    [[nodiscard]] gcode::AxisValues values_of(const AxisPositions& positions) const {
        gcode::AxisValues values;
        for (std::size_t n = 0; n < program_.axes.size(); ++n) {
            const program::ProgramAxis& axis = program_.axes[n];
            const double position = positions[static_cast<Eigen::Index>(n)];
            values[axis_of(axis.letter)] = axis.kind == AxisKind::rotary ? to_degrees(position) : position;
        }
        return values;
    }

    /// Where the axes stand before is not known, so each has to be named before it counts. A feed that is the
    /// first to name one, and has no speed of its own, has its length from where the program takes it to be.
    [[nodiscard]] gcode::AxisValues strange_start() const {
        gcode::AxisValues start = values_of(program::programmed(program_, program_.start));
        if (format_.positions == PositionsOf::axes) {
            start += tool_offset_;
        }
        program::AxisSet named;
        for (const program::Block& block : program_.blocks) {
            for (std::size_t n = 0; n < program_.axes.size() && block.moves(); ++n) {
                const auto axis = static_cast<int>(n);
                const bool first = block.named.contains(axis) && !named.contains(axis);
                if (first && (block.kind == program::BlockKind::rapid || block.programmed_speed)) {
                    constexpr double far_away = -17.0; // mm or degrees
                    start[axis_of(program_.axes[n].letter)] += far_away;
                }
                if (first) {
                    named.insert(axis);
                }
            }
        }
        return start;
    }

    [[nodiscard]] std::vector<gcode::WrittenStep> read(const program::Listing& listing) const {
        gcode::WrittenTextRules rules;
        rules.start = at_;
        rules.work_offset = work_offset_;
        if (program_.tool) {
            rules.tool.number = program_.tool->number;
            rules.tool.offset = tool_offset_;
        }
        if (format_.tip) {
            rules.tip_on = format_.tip->read_m_on;
            rules.tip_off = format_.tip->read_m_off;
        }
        if (format_.reader == TextReader::klartext) {
            return read_written_klartext(listing.text, file_, rules);
        }
        rules.dialect = format_.reader == TextReader::grbl    ? gcode::Dialect::grbl
                        : format_.reader == TextReader::fanuc ? gcode::Dialect::fanuc
                                                              : gcode::Dialect::linuxcnc;
        rules.grbl_axes = format_.axes;
        return read_written_rs274(listing.text, file_, rules);
    }

    const gcode::WrittenStep& next(gcode::StepKind wanted) {
        if (next_ == steps_.size()) {
            differ(fmt::format("the text ends before {}", name_of(wanted)));
        }
        const gcode::WrittenStep& step = steps_[next_];
        if (step.kind != wanted) {
            differ(fmt::format("{} instead of {}", name_of(step.kind), name_of(wanted)));
        }
        return step;
    }

    /// The tool comes before all else, where the program has one and the control takes a tool number.
    void compare_tool() {
        if (!program_.tool || format_.blocks.tool.empty()) { // a control that needs one has any
            std::erase_if(steps_,
                          [](const gcode::WrittenStep& step) { return step.kind == gcode::StepKind::tool; });
            return;
        }
        const gcode::WrittenStep& step = next(gcode::StepKind::tool);
        if (!exactly_equal(step.value, static_cast<double>(program_.tool->number))) {
            differ(fmt::format("tool {:.0f} is called in the text, but {} in the program",
                               step.value,
                               program_.tool->number));
        }
        ++next_;
    }

    /// What the control adds to a position of the text, machine positions by G53 or M91 apart.
    [[nodiscard]] double added(std::size_t letter, bool tip) const {
        if (format_.positions == PositionsOf::tip && !tip) {
            return 0.0;
        }
        return (tip ? work_offset_[letter] : 0.0) + tool_offset_[letter];
    }

    void compare_value(std::string_view name, double read, double meant, double within) const {
        if (!(std::abs(read - meant) <= within)) {
            differ(fmt::format("{} is {:.6f} in the text, but {:.6f} in the program", name, read, meant));
        }
    }

    void compare_block(const program::Block& block) {
        const gcode::WrittenStep& step = next(step_of(block.kind));
        const NumberFormats& numbers = format_.numbers;
        switch (block.kind) {
        case program::BlockKind::spindle_on:
            compare_value("the spindle speed", step.value, block.spindle_rpm, half_of(numbers.speed));
            break;
        case program::BlockKind::dwell: {
            const double unit = format_.milliseconds ? 1e-3 : 1.0;
            compare_value("the dwell", step.value, block.duration, half_of(numbers.time) * unit);
            break;
        }
        case program::BlockKind::rapid:
        case program::BlockKind::feed:
            compare_move(block, step);
            break;
        case program::BlockKind::end:
            if (step.tip) {
                differ("tip control is still on");
            }
            break;
        default:
            break;
        }
        ++next_;
    }

    [[nodiscard]] static double half_of(const program::NumberFormat& number) {
        return number.digit() / 2.0 + text_rounding;
    }

    void compare_move(const program::Block& block, const gcode::WrittenStep& step) {
        const BlockWords& words = program_words_.blocks[static_cast<std::size_t>(block_)];
        if (step.tip != words.tip) {
            differ(step.tip ? "tip control is on" : "tip control is off");
        }
        compare_positions(words, block.named, step.target);
        if (block.kind == program::BlockKind::feed && block.programmed_speed) {
            compare_speed(block, step);
        } else if (block.kind == program::BlockKind::feed) {
            const FeedWay way = feed_way(program_.axes, words.from, words.to);
            const double length = way.angular ? to_degrees(way.length) : way.length / format_.length_unit();
            compare_feed({length, step.value}, {length, block.duration});
        }
        at_ = step.target;
    }

    /// Axes that the block names are where it says, and so are those of axis positions that were named
    /// before. The others have not moved.
    void
    compare_positions(const BlockWords& words, const program::AxisSet& named, const gcode::AxisValues& read) {
        for (std::size_t n = 0; n < program_.axes.size(); ++n) {
            const program::ProgramAxis& axis = program_.axes[n];
            const auto index = static_cast<int>(n);
            const std::size_t letter = axis_of(axis.letter);
            const bool rotary = axis.kind == AxisKind::rotary;
            const double position = rotary ? to_degrees(words.to[index]) : words.to[index];
            if (named.contains(index) && format_.positions == PositionsOf::axes) {
                known_.insert(index);
            }
            const bool counts = named.contains(index) || known_.contains(index);
            const double meant = counts ? position + added(letter, words.tip) : at_[letter];
            const double within = rotary ? half_of(format_.numbers.angle)
                                         : half_of(format_.numbers.length) * format_.length_unit();
            compare_value(std::string(1, axis.letter), read[letter], meant, within);
        }
        for (std::size_t letter = 0; letter < gcode::axis_count; ++letter) {
            if (!has_axis(gcode::axis_letters[letter]) && !exactly_equal(read[letter], at_[letter])) {
                differ(fmt::format("{} moves, but the program does not have this axis",
                                   gcode::axis_letters[letter]));
            }
        }
    }

    [[nodiscard]] bool has_axis(char letter) const {
        return std::any_of(program_.axes.begin(),
                           program_.axes.end(),
                           [letter](const program::ProgramAxis& axis) { return axis.letter == letter; });
    }

    /// What a feed word stands for: a way (mm or inch, or degrees) in a time (s).
    struct TimedWay {
        double length = 0.0;
        double duration = 0.0;

        [[nodiscard]] double feed(bool inverse) const {
            constexpr double seconds_per_minute = 60.0;
            return (inverse ? 1.0 : length) / duration * seconds_per_minute;
        }
    };

    /// Of a feed from anywhere: by its length from where the text was taken to begin.
    void compare_speed(const program::Block& block, const gcode::WrittenStep& step) const {
        constexpr double seconds_per_minute = 60.0;
        const auto positions = [&](const gcode::AxisValues& values) {
            AxisPositions found(static_cast<Eigen::Index>(program_.axes.size()));
            for (std::size_t n = 0; n < program_.axes.size(); ++n) {
                const double value = values[axis_of(program_.axes[n].letter)];
                found[static_cast<Eigen::Index>(n)] =
                    program_.axes[n].kind == AxisKind::rotary ? from_degrees(value) : value;
            }
            return found;
        };
        const FeedWay way = feed_way(program_.axes, positions(at_), positions(step.target));
        const auto shown = [&](double speed) {
            return (way.angular ? to_degrees(speed) : speed / format_.length_unit()) * seconds_per_minute;
        };
        const double meant = shown(*block.programmed_speed);
        const double read = shown(way.length / step.value);
        if (!(std::abs(read - meant) <= half_of(format_.numbers.feed) + 1e-9 * meant)) {
            differ(
                fmt::format("the feed rate is {:.6f} in the text, but {:.6f} in the program", read, meant));
        }
    }

    /// Inverse time is never rounded up, unless to the smallest feed there is.
    void compare_feed(const TimedWay& read, const TimedWay& meant) const {
        const bool inverse = format_.feed.mode == FeedWriting::inverse_time;
        const double feed_read = read.feed(inverse);
        const double feed_meant = meant.feed(inverse);
        const double digit = format_.numbers.feed.digit();
        const double noise = 1e-5 * digit + 1e-9 * feed_meant; // of the quotients
        const double nearest = inverse ? std::max(digit, feed_meant - digit / 2.0) : feed_meant;
        if (!(std::abs(feed_read - nearest) <= digit / 2.0 + noise)) {
            differ(fmt::format(
                "the feed rate is {:.6f} in the text, but {:.6f} in the program", feed_read, feed_meant));
        }
    }

    // ---- arcs

    void compare_arc(const FittedArc& arc) {
        const gcode::WrittenStep& step = next(gcode::StepKind::arc);
        const BlockWords& begin = program_words_.blocks[static_cast<std::size_t>(arc.first)];
        const BlockWords& end = program_words_.blocks[static_cast<std::size_t>(arc.last)];
        compare_positions(end, axes_named(program_, arc), step.target);
        if (step.plane != arc.plane || (step.sweep > 0.0) != (arc.sweep > 0.0)) {
            differ("the arc turns in the wrong direction");
        }
        const auto [first, second] = letters_of(step.plane);
        const Vec2 centre(step.centre_1 - added(first, false), step.centre_2 - added(second, false));
        if (format_.arcs->centre != ArcCentre::radius) {
            const double within = half_of(format_.numbers.length) * format_.length_unit();
            compare_value("the centre's first coordinate", centre.x(), arc.centre.x(), within);
            compare_value("the centre's second coordinate", centre.y(), arc.centre.y(), within);
        }
        const FittedArc read{arc.first, arc.last, step.plane, centre, radius_of(step), step.sweep};
        const double deviation = arc_deviation(program_, program_words_, read);
        const double within = arc_tolerance_ + half_of(format_.numbers.length) * format_.length_unit();
        if (!(deviation <= within)) {
            differ(fmt::format(
                "the arc deviates by {:.6f} mm from its moves, more than {:.6f}", deviation, within));
        }
        compare_duration_of(arc, read, begin, end, step);
        at_ = step.target;
        ++next_;
    }

    [[nodiscard]] static std::pair<std::size_t, std::size_t> letters_of(gcode::Plane plane) {
        const std::string_view letters = plane == gcode::Plane::xy   ? "XY"
                                         : plane == gcode::Plane::xz ? "ZX"
                                                                     : "YZ";
        return {axis_of(letters[0]), axis_of(letters[1])};
    }

    [[nodiscard]] double radius_of(const gcode::WrittenStep& step) const {
        const auto [first, second] = letters_of(step.plane);
        return std::hypot(at_[first] - step.centre_1, at_[second] - step.centre_2);
    }

    void compare_duration_of(const FittedArc& arc,
                             const FittedArc& read,
                             const BlockWords& begin,
                             const BlockWords& end,
                             const gcode::WrittenStep& step) const {
        double duration = 0.0;
        for (int n = arc.first; n <= arc.last; ++n) {
            duration += program_.blocks[static_cast<std::size_t>(n)].duration;
        }
        const int third = plane_axes(program_.axes, arc.plane).third;
        const double rise = third < 0 ? 0.0 : end.to[third] - begin.from[third];
        const double meant = length_of_feeds(program_, program_words_, arc) / format_.length_unit();
        const double way = std::hypot(read.radius * read.sweep, rise) / format_.length_unit();
        compare_feed({way, step.value}, {meant, duration});
    }
};

} // namespace

void check_read_back(const program::Listing& listing,
                     const program::Program& program,
                     const ProgramWords& program_words,
                     const PostFormat& format,
                     double arc_tolerance,
                     const std::filesystem::path& file) {
    Comparison(program, program_words, format, arc_tolerance, file).compare(listing);
}

} // namespace millwright::posts
