#include "core/posts/writer.h"

#include "core/base/error.h"
#include "core/base/units.h"
#include "core/posts/internal/comment_text.h"
#include "core/posts/internal/tool_number.h"
#include "core/program/cutter_comment.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>
#include <optional>
#include <utility>

namespace millwright::posts {

namespace {

using kinematics::AxisKind;
using kinematics::AxisPositions;

/// `pattern` with {word} filled in.
std::string filled(std::string pattern, std::string_view word, std::string_view with) {
    const std::string place = fmt::format("{{{}}}", word);
    for (std::size_t at = pattern.find(place); at != std::string::npos;
         at = pattern.find(place, at + with.size())) {
        pattern.replace(at, place.size(), with);
    }
    return pattern;
}

class Writer {
public:
    Writer(const program::Program& program,
           const ProgramWords& program_words,
           const PostFormat& format,
           const TextSettings& settings)
        : program_(program), program_words_(program_words), format_(format), settings_(settings),
          words_(program.axes.size()), feed_code_(format.feed.first_code),
          number_(format.line_numbers.first - format.line_numbers.step) {
        expects(program_words.blocks.size() == program.blocks.size(), "a wording belongs to its program");
    }

    program::Listing take() {
        frame(format_.blocks.top);
        std::ranges::for_each(settings_.remarks, [this](const std::string& remark) { comment(remark); });
        for (const program::ProgramCutter& cutter : program_.cutters) {
            comment(program::cutter_comment(cutter, format_.length_unit()));
        }
        auto arc = program_words_.arcs.begin();
        for (block_ = 0; block_ < program_.block_count(); ++block_) {
            const bool begins_arc = arc != program_words_.arcs.end() && arc->first == block_;
            const int last = begins_arc ? arc->last : block_;
            begin(last);
            if (begins_arc) {
                code_line(arc_text(*arc++));
                block_ = last;
            } else {
                write(program_.blocks[static_cast<std::size_t>(block_)]);
            }
        }
        frame(format_.blocks.bottom);
        listing_.line_starts.push_back(listing_.text.size());
        return std::move(listing_);
    }

private:
    const program::Program& program_;
    const ProgramWords& program_words_;
    const PostFormat& format_;
    const TextSettings& settings_;
    program::Listing listing_;
    std::vector<std::string> words_; ///< last written position of each axis; empty: not known
    std::string motion_code_;
    std::string feed_code_;
    std::string feed_;
    gcode::Plane plane_ = gcode::Plane::xy;
    bool prepared_ = false;
    bool tip_ = false;
    std::optional<int> tool_number_; ///< of the tool that lines with {tool} call
    int number_ = 0;
    int block_ = 0;

    [[nodiscard]] const BlockWords& words(int block) const {
        return program_words_.blocks[static_cast<std::size_t>(block)];
    }

    [[noreturn]] void refuse(std::string_view what) const {
        throw Error(fmt::format("block {}: {}", block_ + 1, what));
    }

    // ---- lines

    void line(std::string text, bool numbered) {
        if (numbered) {
            number_ += format_.line_numbers.step;
            text =
                fmt::format("{}{}{}{}", format_.line_numbers.prefix, number_, format_.lines.separator, text);
        }
        if (std::ssize(text) > format_.lines.longest) {
            refuse(fmt::format("its line would have {} characters, but {} accepts only {}",
                               text.size(),
                               format_.name,
                               format_.lines.longest));
        }
        listing_.line_starts.push_back(listing_.text.size());
        listing_.text += text;
        listing_.text += '\n';
    }

    void code_line(std::string text) {
        const bool asked = settings_.line_numbers;
        line(std::move(text), asked || format_.line_numbers.lines != NumberedLines::on_request);
    }

    void frame_line(std::string text) {
        line(std::move(text), format_.line_numbers.lines == NumberedLines::every_line);
    }

    void frame(const Lines& lines) {
        for (const std::string& pattern : lines) {
            frame_line(filled(pattern, "name", settings_.name));
        }
    }

    void comment(const std::string& text) {
        for (std::string& part : internal::comment_lines(text, format_.comment)) {
            frame_line(std::move(part));
        }
    }

    /// What a control that has no lines for it cannot do.
    void switch_lines(const Lines& lines,
                      std::string_view what,
                      std::string_view word = {},
                      std::string_view with = {}) {
        if (lines.empty()) {
            refuse(fmt::format("{} cannot be written for {}", what, format_.name));
        }
        for (const std::string& pattern : lines) {
            code_line(with_tool(filled(pattern, word, with)));
        }
    }

    // ---- blocks

    /// What comes before the blocks up to `last`, which belong to the next line.
    void begin(int last) {
        const program::BlockKind kind = program_.blocks[static_cast<std::size_t>(block_)].kind;
        if (kind != program::BlockKind::comment && !std::exchange(prepared_, true)) {
            prepare();
        }
        for (int n = block_; n <= last; ++n) {
            listing_.line_of_block.push_back(static_cast<int>(listing_.line_starts.size()) + 1);
        }
        const bool moves = kind == program::BlockKind::rapid || kind == program::BlockKind::feed;
        if (moves || kind == program::BlockKind::end) {
            control_tip(moves && words(block_).tip);
        }
    }

    void prepare() {
        const std::string path =
            settings_.path_tolerance > 0.0
                ? filled(format_.blocks.path_blended,
                         "tolerance",
                         format_.numbers.tolerance.text(settings_.path_tolerance / format_.length_unit()))
                : format_.blocks.path_exact;
        for (const std::string& pattern : format_.blocks.head) {
            code_line(filled(pattern, "path", path));
        }
        call_tool();
    }

    void call_tool() {
        if (!program_.tool) {
            return;
        }
        if (format_.blocks.tool.empty()) {
            comment(fmt::format("set the zero of Z with tool {}: its length is not compensated",
                                program_.tool->number));
        }
        for (const std::string& pattern : format_.blocks.tool) {
            code_line(with_tool(pattern));
        }
    }

    [[nodiscard]] std::string with_tool(const std::string& pattern) {
        if (pattern.find("{tool}") == std::string::npos) {
            return pattern;
        }
        if (!tool_number_) { // looked for once, since it may take the whole program
            tool_number_ = internal::tool_number(program_, format_.name);
        }
        return filled(pattern, "tool", std::to_string(*tool_number_));
    }

    void control_tip(bool wanted) {
        if (wanted == std::exchange(tip_, wanted)) {
            return;
        }
        expects(format_.tip.has_value(), "a control with tip positions has tip control");
        for (const std::string& text : wanted ? format_.tip->on : format_.tip->off) {
            code_line(with_tool(text));
        }
        // The same letters mean something else from here on.
        std::fill(words_.begin(), words_.end(), std::string());
        motion_code_.clear();
    }

    void write(const program::Block& block) {
        const BlockLines& lines = format_.blocks;
        switch (block.kind) {
        case program::BlockKind::comment:
            return comment(block.text);
        case program::BlockKind::spindle_on:
            return switch_lines(block.spindle_rpm < 0.0 ? lines.spindle_counterclockwise
                                                        : lines.spindle_clockwise,
                                "this spindle direction",
                                "speed",
                                format_.numbers.speed.text(std::abs(block.spindle_rpm)));
        case program::BlockKind::spindle_off:
            return switch_lines(lines.spindle_off, "spindle off");
        case program::BlockKind::coolant_on:
            return switch_lines(lines.coolant_on, "coolant on");
        case program::BlockKind::coolant_off:
            return switch_lines(lines.coolant_off, "coolant off");
        case program::BlockKind::dwell: {
            const double unit = format_.milliseconds ? 1e-3 : 1.0;
            return switch_lines(
                lines.dwell, "a dwell", "time", format_.numbers.time.text(block.duration / unit));
        }
        case program::BlockKind::pause:
            comment(block.text);
            return switch_lines(lines.pause, "a pause");
        case program::BlockKind::rapid:
        case program::BlockKind::feed:
            return code_line(move_text(block));
        case program::BlockKind::end:
            return switch_lines(lines.end, "a program end");
        }
    }

    // ---- moves

    std::string move_text(const program::Block& block) {
        const bool feeds = block.kind == program::BlockKind::feed;
        const bool machine = !words(block_).tip && format_.tip.has_value();
        if (machine && feeds) {
            refuse("a feed move that does not specify all axes cannot be written with tip positions");
        }
        const MoveFormat& move = machine ? format_.tip->machine_rapid
                                 : feeds ? format_.moves.feed
                                         : format_.moves.rapid;
        if (machine) { // for one line only, whatever it says
            motion_code_.clear();
            std::fill(words_.begin(), words_.end(), std::string());
        }
        std::vector<std::string> text = codes(move.code, feeds, block.programmed_speed.has_value());
        const std::vector<std::string> axes = axis_words(block);
        text.insert(text.end(), axes.begin(), axes.end());
        if (!move.behind.empty()) {
            text.push_back(move.behind);
        }
        if (feeds && block.programmed_speed) {
            append_speed(text, block);
        } else if (feeds) {
            const FeedWay way = feed_way(program_.axes, words(block_).from, words(block_).to);
            append_feed(text, way, block.duration);
        }
        return joined(text);
    }

    std::string arc_text(const FittedArc& arc) {
        expects(format_.arcs.has_value(), "arcs are written only for a control that has them");
        const bool clockwise = arc.sweep < 0.0;
        std::vector<std::string> text =
            codes(clockwise ? format_.arcs->clockwise : format_.arcs->counterclockwise, true);
        if (plane_ != arc.plane) {
            plane_ = arc.plane;
            text.insert(text.begin(),
                        plane_ == gcode::Plane::xy   ? "G17"
                        : plane_ == gcode::Plane::xz ? "G18"
                                                     : "G19");
        }
        const PlaneAxes axes = plane_axes(program_.axes, arc.plane);
        const AxisPositions& from = words(arc.first).from;
        const AxisPositions& to = words(arc.last).to;
        // Both axes of the plane always stand there, so that the end is plain to see.
        for (const int n : {axes.first, axes.second}) {
            words_[static_cast<std::size_t>(n)].clear();
        }
        const program::AxisSet named = axes_named(program_, arc);
        for (int n = 0; n < std::ssize(program_.axes); ++n) {
            if (named.contains(n)) {
                append_if_new(text, n, to[n]);
            }
        }
        append_centre(text, arc, axes, from);
        double duration = 0.0;
        for (int n = arc.first; n <= arc.last; ++n) {
            duration += program_.blocks[static_cast<std::size_t>(n)].duration;
        }
        append_feed(text, {length_of_feeds(program_, program_words_, arc), false}, duration);
        return joined(text);
    }

    void append_centre(std::vector<std::string>& text,
                       const FittedArc& arc,
                       const PlaneAxes& axes,
                       const AxisPositions& from) const {
        const program::NumberFormat& number = format_.numbers.length;
        if (format_.arcs->centre == ArcCentre::radius) {
            text.push_back("R" + number.text(arc.radius / format_.length_unit()));
            return;
        }
        const bool relative = format_.arcs->centre == ArcCentre::relative;
        const std::string_view letters = arc.plane == gcode::Plane::xy   ? "IJ"
                                         : arc.plane == gcode::Plane::xz ? "KI"
                                                                         : "JK";
        const double first = arc.centre.x() - (relative ? from[axes.first] : 0.0);
        const double second = arc.centre.y() - (relative ? from[axes.second] : 0.0);
        text.push_back(letters[0] + number.text(first / format_.length_unit()));
        text.push_back(letters[1] + number.text(second / format_.length_unit()));
    }

    /// Feed mode and motion, as far as they are not in force.
    /// `by_speed`: a feed of unknown length, which has no time.
    std::vector<std::string> codes(const std::string& motion, bool feeds, bool by_speed = false) {
        std::vector<std::string> text;
        const bool timed = format_.feed.mode == FeedWriting::inverse_time;
        if (by_speed && timed && format_.feed.rapid_code.empty()) {
            refuse("its feed time is unknown because the program does not specify where the move starts");
        }
        const bool as_feed = feeds && !(by_speed && timed);
        const std::string& mode = as_feed ? format_.feed.feed_code : format_.feed.rapid_code;
        if (mode != feed_code_ && !mode.empty()) {
            feed_code_ = mode;
            text.push_back(mode);
        }
        if (motion != motion_code_ || !format_.moves.modal_codes) {
            text.push_back(motion);
        }
        motion_code_ = motion;
        return text;
    }

    std::vector<std::string> axis_words(const program::Block& block) {
        std::vector<std::string> text;
        int first = -1;
        for (int n = 0; n < std::ssize(program_.axes); ++n) {
            if (block.named.contains(n)) {
                first = first < 0 ? n : first;
                append_if_new(text, n, words(block_).to[n]);
            }
        }
        expects(first >= 0, "a move names at least one axis");
        if (text.empty()) { // a move without any axis word would be no move
            text.push_back(axis_word(first, words(block_).to[first]));
        }
        return text;
    }

    void append_if_new(std::vector<std::string>& text, int n, double position) {
        std::string word = axis_word(n, position);
        std::string& last = words_[static_cast<std::size_t>(n)];
        if (word != last || !format_.moves.modal_axes) {
            last = word;
            text.push_back(std::move(word));
        }
    }

    [[nodiscard]] std::string axis_word(int n, double position) const {
        const program::ProgramAxis& axis = program_.axes[static_cast<std::size_t>(n)];
        const bool rotary = axis.kind == AxisKind::rotary;
        return axis.letter + (rotary ? format_.numbers.angle.text(to_degrees(position))
                                     : format_.numbers.length.text(position / format_.length_unit()));
    }

    void append_feed(std::vector<std::string>& text, const FeedWay& way, double duration) {
        append_feed_word(text, feed_of(way, duration));
    }

    void append_speed(std::vector<std::string>& text, const program::Block& block) {
        append_feed_word(
            text, speed_per_minute(*block.programmed_speed, !names_linear(program_.axes, block.named)));
    }

    void append_feed_word(std::vector<std::string>& text, double feed) {
        std::string word = format_.feed.word + format_.numbers.feed.text(feed);
        if (!format_.feed.modal || word != feed_) {
            text.push_back(word);
        }
        feed_ = std::move(word);
    }

    /// In inverse time rounded down, so that rounding never makes a move faster; mm per minute to the
    /// nearest, as people write them.
    [[nodiscard]] double feed_of(const FeedWay& way, double duration) const {
        constexpr double seconds_per_minute = 60.0;
        constexpr double rounding = 1e-6; // of a digit: of a duration that was rounded to be written
        const program::NumberFormat& number = format_.numbers.feed;
        const double moves_per_minute = seconds_per_minute / duration;
        if (format_.feed.mode == FeedWriting::inverse_time) {
            const double steps = std::floor(moves_per_minute / number.digit() + rounding);
            return std::max(1.0, steps) * number.digit();
        }
        return speed_per_minute(way.length / duration, way.angular);
    }

    /// Of mm/s or rad/s, as it is written.
    [[nodiscard]] double speed_per_minute(double speed, bool angular) const {
        constexpr double seconds_per_minute = 60.0;
        const double a_second = angular ? to_degrees(speed) : speed / format_.length_unit();
        const double feed = format_.numbers.feed.rounded(a_second * seconds_per_minute);
        if (!(feed > 0.0)) {
            refuse(fmt::format("its feed rate, {} per minute, is too small to be written",
                               angular          ? "degrees"
                               : format_.inches ? "inch"
                                                : "mm"));
        }
        return feed;
    }

    [[nodiscard]] std::string joined(const std::vector<std::string>& text) const {
        std::string line;
        for (const std::string& word : text) {
            line += (line.empty() ? "" : format_.lines.separator) + word;
        }
        return line;
    }
};

} // namespace

std::string text_name(std::string_view name) {
    constexpr std::size_t longest = 24;
    std::string text;
    for (const char c : name.substr(0, longest)) {
        const bool plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '-';
        text += plain ? static_cast<char>(std::toupper(static_cast<unsigned char>(c))) : '_';
    }
    return text.find_first_not_of('_') == std::string::npos ? "PROGRAM" : text;
}

program::Listing write_text(const program::Program& program,
                            const ProgramWords& program_words,
                            const PostFormat& format,
                            const TextSettings& settings) {
    return Writer(program, program_words, format, settings).take();
}

program::Listing write_gcode(const program::Program& program, const program::ProgramSettings& settings) {
    PostFormat format;
    format.numbers.length.decimals = settings.length_decimals;
    format.numbers.angle.decimals = settings.angle_decimals;
    return write_text(program,
                      axis_program_words(program),
                      format,
                      {.line_numbers = settings.line_numbers, .path_tolerance = settings.path_tolerance});
}

} // namespace millwright::posts
