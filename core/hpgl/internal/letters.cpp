#include "core/hpgl/internal/letters.h"

#include "core/base/numbers.h"
#include "core/plot_strokes/stroke_font.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <string_view>

namespace millwright::hpgl::internal {
namespace {

constexpr double units_per_cm = 400.0;

/// The axes of a character in plotter units: `right` a capital's width, `up` its height; a cell is 1.5 by 2
/// of them.
struct CharacterFrame {
    Vec2 right;
    Vec2 up;
    Vec2 advance;   ///< to the next character
    Vec2 line_feed; ///< to the next line
    double slant = 0.0;

    [[nodiscard]] Vec2 at(const Vec2& corner, const Vec2& p) const {
        return corner + p.x() * right + p.y() * up + slant * p.y() * up.norm() * right.normalized();
    }
};

Vec2 size_of(const Run& run) {
    const LabelStyle& style = run.modes.label;
    return style.size_relative ? Vec2(style.size.cwiseProduct(run.units.span()) / 100.0)
                               : Vec2(style.size * units_per_cm);
}

CharacterFrame frame_of(const Run& run) {
    const LabelStyle& style = run.modes.label;
    const Vec2 along =
        style.direction_relative ? Vec2(style.direction.cwiseProduct(run.units.span())) : style.direction;
    const Vec2 base = run.units.turned(along.normalized());
    const Vec2 size = size_of(run);
    CharacterFrame frame;
    frame.right = size.x() * base;
    frame.up = size.y() * Vec2(-base.y(), base.x());
    frame.slant = style.slant;
    const Vec2 across = 1.5 * (1.0 + style.extra.x()) * frame.right;
    const Vec2 upwards = 2.0 * (1.0 + style.extra.y()) * frame.up;
    switch (style.path) {
    case 1:
        frame.advance = -upwards;
        frame.line_feed = -across;
        break;
    case 2:
        frame.advance = -across;
        frame.line_feed = -upwards;
        break;
    case 3:
        frame.advance = upwards;
        frame.line_feed = across;
        break;
    default:
        frame.advance = across;
        frame.line_feed = -upwards;
    }
    return frame;
}

void draw_lines(Run& run, const CharacterFrame& frame, const Vec2& corner, const plot::Glyph& lines) {
    for (const auto& line : lines) {
        run.pen.place(frame.at(corner, line.front()));
        for (std::size_t n = 1; n < line.size(); ++n) {
            run.pen.draw(frame.at(corner, line[n]));
        }
    }
}

void note_blank(Run& run, std::int64_t byte) {
    const std::string_view name = "LB";
    for (LeftOut& known : run.plot.left_out) {
        if (known.name == name) {
            ++known.count;
            return;
        }
    }
    run.plot.left_out.push_back({.name = std::string(name),
                                 .why = "characters that are not ASCII are drawn as blanks",
                                 .byte = byte,
                                 .count = 1});
}

/// How far LO moves a line of `count` characters: along the line (which also moves the pen's end), and off
/// it.
struct Justification {
    Vec2 along = Vec2::Zero();
    Vec2 off = Vec2::Zero();
};

Justification justification(const Run& run, const CharacterFrame& frame, std::size_t count) {
    const int origin = run.modes.label.origin;
    const bool apart = origin > 10;
    const int row = (origin % 10 - 1) % 3;    // 0 on the line, 1 centred, 2 hanging
    const int column = (origin % 10 - 1) / 3; // 0 begins, 1 centred, 2 ends here
    Justification shift;
    shift.along = -0.5 * column * static_cast<double>(count) * frame.advance;
    shift.off = -0.5 * row * frame.up;
    if (apart) {
        shift.off += 0.5 * (1 - row) * frame.up + 0.5 * (1 - column) * frame.right;
    }
    return shift;
}

/// Draws labels character by character; the pen's state is as before, its place behind the last one.
class LabelWriter {
public:
    explicit LabelWriter(Run& run) : run_(run), frame_(frame_of(run)), at_(run.pen.at()) {}

    void write(std::string_view text, std::int64_t byte) {
        LabelStyle& style = run_.modes.label;
        if (at_ != style.label_end) {
            style.line_start = at_;
        }
        begin_line(text);
        for (std::size_t n = 0; n < text.size(); ++n) {
            write(text[n], text.substr(n + 1), byte);
        }
        run_.pen.place(at_);
        style.label_end = at_;
    }

private:
    void begin_line(std::string_view rest) {
        const std::size_t end = std::min(rest.find_first_of("\r\n"), rest.size());
        const auto seen = [](char c) { return static_cast<unsigned char>(c) >= ' '; };
        const auto count = std::count_if(rest.begin(), rest.begin() + static_cast<std::ptrdiff_t>(end), seen);
        const Justification shift = justification(run_, frame_, static_cast<std::size_t>(count));
        at_ += shift.along;
        off_ = shift.off;
    }

    void write(char c, std::string_view rest, std::int64_t byte) {
        if (c == '\r') {
            // Back to the start of the line, however many lines below it started.
            const Vec2 along = frame_.advance.normalized();
            at_ += along * along.dot(run_.modes.label.line_start - at_);
            begin_line(rest.substr(0, rest.starts_with('\n') ? 0 : rest.size()));
        } else if (c == '\n') {
            at_ += frame_.line_feed;
            begin_line(rest.substr(0, rest.starts_with('\r') ? 0 : rest.size()));
        } else if (c == '\b') {
            at_ -= frame_.advance;
        } else if (static_cast<unsigned char>(c) >= ' ') {
            const auto lines = plot::glyph(c);
            if (lines) {
                draw_lines(run_, frame_, at_ + off_, *lines);
            } else {
                note_blank(run_, byte);
            }
            at_ += frame_.advance;
        }
    }

    Run& run_;
    CharacterFrame frame_;
    Vec2 at_;
    Vec2 off_ = Vec2::Zero();
};

void set_direction(Run& run, const Given& given, bool relative) {
    const Vec2 direction = given.count() == 0 ? Vec2(1.0, 0.0) : given.point(0);
    if (exactly_equal(direction.x(), 0.0) && exactly_equal(direction.y(), 0.0)) {
        return run.refuse(fmt::format("{}: 0,0 is not a direction", given.command.name));
    }
    run.modes.label.direction = direction;
    run.modes.label.direction_relative = relative;
}

} // namespace

void label(Run& run, const Given& given) {
    if (run.refuses_if_lost()) {
        return;
    }
    if (!given.command.terminated) {
        return run.refuse("the terminator of a label is missing");
    }
    LabelWriter(run).write(given.command.arguments, given.command.byte);
}

void buffer_label(Run& run, const Given& given) {
    if (!given.command.terminated) {
        return run.refuse("the terminator of a label is missing");
    }
    run.buffered_label = given.command.arguments;
}

void print_buffered_label(Run& run, const Given& given) {
    if (run.refuses_if_lost()) {
        return;
    }
    LabelWriter(run).write(run.buffered_label, given.command.byte);
}

void label_terminator(Run& run, const Given& given) {
    const std::string_view text = given.command.arguments;
    const bool printed = given.count() > 0 && exactly_equal(given[0], 0.0);
    run.lexer.end_labels_with(text.empty() ? '\x03' : text.front(), !text.empty() && printed);
}

/// Whether an HP plotter has characters of these sizes; else they are refused.
bool sizes_fit(Run& run, const Given& given, std::string_view command, std::string_view unit) {
    constexpr double most = 128.0;
    for (const double size : given.numbers) {
        if (!(std::abs(size) < most)) {
            run.refuse(
                fmt::format("{}: characters of {} {} are too large, at most {} are allowed: two numbers "
                            "may have run together",
                            command,
                            size,
                            unit,
                            most));
            return false;
        }
    }
    return true;
}

void character_size(Run& run, const Given& given) {
    if (sizes_fit(run, given, "SI", "cm")) {
        run.modes.label.size_relative = false;
        run.modes.label.size = given.count() == 2 ? given.point(0) : LabelStyle().size;
    }
}

void relative_character_size(Run& run, const Given& given) {
    if (sizes_fit(run, given, "SR", "%")) {
        run.modes.label.size_relative = true;
        run.modes.label.size = given.count() == 2 ? given.point(0) : Vec2(0.75, 1.5);
    }
}

void label_direction(Run& run, const Given& given) {
    set_direction(run, given, false);
}

void relative_label_direction(Run& run, const Given& given) {
    set_direction(run, given, true);
}

void label_path(Run& run, const Given& given) {
    const double path = given.value(0, 0.0);
    if (path < 0.0 || path > 3.0) {
        return run.refuse(fmt::format("DV: the path must be 0 to 3, not {}", path));
    }
    run.modes.label.path = static_cast<int>(path);
}

void character_slant(Run& run, const Given& given) {
    run.modes.label.slant = given.value(0, 0.0);
}

void extra_space(Run& run, const Given& given) {
    run.modes.label.extra = {given.value(0, 0.0), given.value(1, 0.0)};
}

void label_origin(Run& run, const Given& given) {
    const double origin = given.value(0, 1.0);
    const bool known = (origin >= 1.0 && origin <= 9.0) || (origin >= 11.0 && origin <= 19.0);
    if (!known) {
        return run.refuse(fmt::format("LO: the origin must be 1 to 9 or 11 to 19, not {}", origin));
    }
    run.modes.label.origin = static_cast<int>(origin);
}

void character_plot(Run& run, const Given& given) {
    if (run.refuses_if_lost()) {
        return;
    }
    const CharacterFrame frame = frame_of(run);
    LabelStyle& style = run.modes.label;
    Vec2 at = run.pen.at();
    if (at != style.label_end) {
        style.line_start = at;
    }
    if (given.count() == 0) {
        const Vec2 along = frame.advance.normalized();
        at += along * along.dot(style.line_start - at) + frame.line_feed;
    } else {
        at += given[0] * frame.advance - given[1] * frame.line_feed;
    }
    run.pen.place(at);
    style.label_end = at;
}

void symbol_mode(Run& run, const Given& given) {
    const std::string_view text = given.command.arguments;
    run.modes.symbol = text.empty() || text.front() == ' ' ? '\0' : text.front();
}

void draw_symbol(Run& run) {
    const char symbol = run.modes.symbol;
    const auto lines =
        symbol == '\0' || run.pen.in_polygon() || run.pen.lost() ? std::nullopt : plot::glyph(symbol);
    if (!lines) {
        return;
    }
    const CharacterFrame frame = frame_of(run);
    const Vec2 at = run.pen.at();
    draw_lines(run, frame, at - 0.5 * frame.right - 0.5 * frame.up, *lines);
    run.pen.place(at);
}

// Steps on a grid of 6 by 18 in a character's cell; 99 lowers the pen and -99 lifts it.
void user_character(Run& run, const Given& given) {
    if (run.refuses_if_lost()) {
        return;
    }
    constexpr double flag = 99.0;
    plot::Glyph lines;
    Vec2 at = Vec2::Zero();
    bool down = false;
    for (std::size_t n = 0; n < given.count();) {
        if (std::abs(given[n]) >= flag) {
            down = given[n] > 0.0;
            ++n;
            continue;
        }
        if (n + 1 == given.count()) {
            return run.refuse("UC: a step has no y");
        }
        if (!down || lines.empty() || lines.back().back() != at) {
            lines.push_back({at});
        }
        at += Vec2(given[n] / 4.0, given[n + 1] / 9.0);
        if (down) {
            lines.back().push_back(at);
        } else {
            lines.pop_back();
        }
        n += 2;
    }
    const CharacterFrame frame = frame_of(run);
    const Vec2 start = run.pen.at();
    draw_lines(run, frame, start, lines);
    run.pen.place(start + frame.advance);
}

} // namespace millwright::hpgl::internal
