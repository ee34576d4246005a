#include "core/gcode/writer.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/gcode/internal/comment_text.h"
#include "core/gcode/internal/written.h"

#include <fmt/format.h>

#include <algorithm>
#include <optional>
#include <utility>

namespace millwright::gcode {

namespace {

using kinematics::AxisKind;

/// Motion code and feed mode go together: rapids in units per minute, feeds in inverse time.
enum class Mode { none, rapid, feed };

class Writer {
public:
    Writer(const Program& program, const ProgramSettings& settings)
        : program_(program), settings_(settings), words_(program.axes.size()) {}

    Listing take() {
        for (const Block& block : program_.blocks) {
            if (block.kind != BlockKind::comment && !prepared_) {
                prepare();
            }
            listing_.line_of_block.push_back(static_cast<int>(listing_.line_starts.size()) + 1);
            write(block);
        }
        listing_.line_starts.push_back(listing_.text.size());
        return std::move(listing_);
    }

private:
    const Program& program_;
    const ProgramSettings& settings_;
    Listing listing_;
    std::vector<std::string> words_; ///< last written position of each axis; empty: never
    Mode mode_ = Mode::none;
    bool prepared_ = false;
    int number_ = 0;

    void line(std::string_view text) {
        listing_.line_starts.push_back(listing_.text.size());
        listing_.text += text;
        listing_.text += '\n';
    }

    void code_line(std::string_view text) {
        constexpr int step = 10; // leaves room for lines that a person adds
        if (settings_.line_numbers) {
            number_ += step;
            line(fmt::format("N{} {}", number_, text));
        } else {
            line(text);
        }
    }

    void prepare() {
        prepared_ = true;
        code_line("G21 G90 G17 G40 G49 G80");
        code_line(settings_.path_tolerance > 0.0 ? "G54 G94 G64 P" + fixed(settings_.path_tolerance, 4)
                                                 : std::string("G54 G94 G61"));
    }

    void write(const Block& block) {
        switch (block.kind) {
        case BlockKind::comment:
            for (const std::string& part : internal::comment_lines(block.text)) {
                line(part);
            }
            return;
        case BlockKind::spindle_on:
            return code_line("S" + shortest(std::abs(block.spindle_rpm)) +
                             (block.spindle_rpm < 0.0 ? " M4" : " M3"));
        case BlockKind::spindle_off:
            return code_line("M5");
        case BlockKind::coolant_on:
            return code_line("M8");
        case BlockKind::coolant_off:
            return code_line("M9");
        case BlockKind::dwell:
            return code_line("G4 P" + fixed(block.duration, 4));
        case BlockKind::pause:
            for (const std::string& part : internal::comment_lines(block.text)) {
                line(part);
            }
            return code_line("M0");
        case BlockKind::rapid:
        case BlockKind::feed:
            return code_line(move_text(block));
        case BlockKind::end:
            return code_line("M2");
        }
    }

    std::string move_text(const Block& block) {
        std::string text = mode_text(block.kind == BlockKind::rapid ? Mode::rapid : Mode::feed);
        text += axis_words(block);
        if (block.kind == BlockKind::feed) {
            // In inverse time the feed word belongs to its line and is never left out.
            constexpr double seconds_a_minute = 60.0;
            text += " F" + fixed(seconds_a_minute / block.duration, internal::feed_decimals);
        }
        return text.substr(text.find_first_not_of(' '));
    }

    std::string mode_text(Mode wanted) {
        const Mode before = std::exchange(mode_, wanted);
        if (before == wanted) {
            return {};
        }
        if (wanted == Mode::feed) {
            return "G93 G1";
        }
        return before == Mode::none ? "G0" : "G94 G0";
    }

    std::string axis_words(const Block& block) {
        std::string text;
        std::string first;
        for (int n = 0; n < std::ssize(program_.axes); ++n) {
            if (!block.named.contains(n)) {
                continue;
            }
            std::string word = axis_word(n, block.target[n]);
            std::string& last = words_[static_cast<std::size_t>(n)];
            if (word != last) {
                text += " " + word;
                last = word;
            }
            if (first.empty()) {
                first = std::move(word);
            }
        }
        return text.empty() ? " " + first : text; // a move without any axis word would be no move
    }

    [[nodiscard]] std::string axis_word(int n, double position) const {
        const ProgramAxis& axis = program_.axes[static_cast<std::size_t>(n)];
        const bool rotary = axis.kind == AxisKind::rotary;
        return axis.letter + (rotary ? fixed(to_degrees(position), settings_.angle_decimals)
                                     : fixed(position, settings_.length_decimals));
    }
};

} // namespace

std::string_view Listing::line(int line) const {
    expects(line >= 1 && line <= line_count(), "a line belongs to its listing");
    const std::size_t begin = line_starts[static_cast<std::size_t>(line) - 1];
    const std::size_t end = line_starts[static_cast<std::size_t>(line)];
    return std::string_view(text).substr(begin, end - begin - 1);
}

int Listing::block_at_line(int line) const {
    const auto after = std::upper_bound(line_of_block.begin(), line_of_block.end(), line);
    return static_cast<int>(after - line_of_block.begin()) - 1;
}

Listing write_gcode(const Program& program, const ProgramSettings& settings) {
    return Writer(program, settings).take();
}

} // namespace millwright::gcode
