#include "core/gcode/internal/control_flow.h"

#include "core/gcode/internal/expression.h"
#include "core/gcode/internal/line_parser.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>

namespace millwright::gcode::internal {

namespace {

struct Keyword {
    std::string_view text;
    OWord word;
};

// ELSEIF before ELSE, which begins it.
constexpr std::array<Keyword, 15> keywords{{
    {"SUB", OWord::sub},
    {"ENDSUB", OWord::endsub},
    {"CALL", OWord::call},
    {"DO", OWord::do_},
    {"WHILE", OWord::while_},
    {"REPEAT", OWord::repeat},
    {"IF", OWord::if_},
    {"ELSEIF", OWord::elseif},
    {"ELSE", OWord::else_},
    {"ENDIF", OWord::endif},
    {"BREAK", OWord::break_},
    {"CONTINUE", OWord::continue_},
    {"ENDWHILE", OWord::endwhile},
    {"ENDREPEAT", OWord::endrepeat},
    {"RETURN", OWord::return_},
}};

void skip_line_number(Cursor& cursor) {
    static_cast<void>(cursor.take('/'));
    if (cursor.take('N')) {
        while (is_digit(cursor.peek()) || cursor.peek() == '.') {
            cursor.advance();
        }
    }
}

/// As std::to_string writes the number: without zeros before it.
std::string plain_number(Cursor& cursor) {
    std::string digits;
    for (char c = cursor.peek(); is_digit(c); c = cursor.peek()) {
        if (!(digits.empty() && c == '0')) {
            digits += c;
        }
        cursor.advance();
    }
    return digits.empty() ? "0" : digits;
}

} // namespace

OWord read_o_keyword(Cursor& cursor) {
    const char c = cursor.peek();
    if (cursor.at_end() || c == '(' || c == ';') {
        return OWord::bare;
    }
    for (const Keyword& keyword : keywords) {
        if (cursor.take_word(keyword.text)) {
            return keyword.word;
        }
    }
    return OWord::unknown;
}

std::optional<OHead> read_plain_o_head(Cursor& cursor) {
    skip_line_number(cursor);
    if (!cursor.take('O')) {
        return std::nullopt;
    }
    OHead head;
    const char c = cursor.peek();
    if (c == '<') {
        head.label = read_name(cursor);
    } else if (is_digit(c)) {
        head.label = plain_number(cursor);
    } else {
        return std::nullopt;
    }
    head.word = read_o_keyword(cursor);
    return head;
}

void expect_end_of_line(Cursor& cursor, std::string_view what) {
    while (cursor.peek() == '(') {
        static_cast<void>(read_comment(cursor));
    }
    if (!cursor.at_end() && cursor.peek() != ';') {
        refuse(cursor.column(), fmt::format("only a comment may follow {}", what));
    }
}

bool is_percent(std::string_view line) {
    Cursor cursor(line);
    return cursor.take('%') && cursor.at_end();
}

namespace {

constexpr std::size_t most_labels = 100'000;
constexpr std::size_t deepest_blocks = 1'000;

} // namespace

void ControlFlow::execute(Cursor& cursor) {
    const Line line = read_head(cursor);
    switch (line.word) {
    case OWord::sub:
        define(line, cursor);
        break;
    case OWord::call:
        call(line, cursor);
        break;
    case OWord::endsub:
    case OWord::return_:
        leave_subroutine(line, cursor);
        break;
    case OWord::if_:
        begin_if(line, cursor);
        break;
    case OWord::elseif:
    case OWord::else_:
    case OWord::endif:
        leave_branch(line, cursor);
        break;
    case OWord::do_:
        open_block(line, cursor, OWord::do_);
        break;
    case OWord::while_:
        while_or_end_of_do(line, cursor);
        break;
    case OWord::repeat:
        begin_repeat(line, cursor);
        break;
    case OWord::endwhile:
        end_loop(line, cursor, OWord::while_);
        break;
    case OWord::endrepeat:
        end_loop(line, cursor, OWord::repeat);
        break;
    case OWord::break_:
    case OWord::continue_:
        break_or_continue(line, cursor);
        break;
    case OWord::bare:
        break; // the beginning of a subprogram that is also run through
    case OWord::unknown:
        refuse(cursor.column(),
               "an O-word must be followed by sub, endsub, call, return, if, while, do, repeat ...");
    }
}

ControlFlow::Line ControlFlow::read_head(Cursor& cursor) const {
    Line line;
    line.column = cursor.column();
    cursor.advance();
    line.label =
        cursor.peek() == '<' ? read_name(cursor) : std::to_string(read_integer(cursor, run_.variables));
    line.word = read_o_keyword(cursor);
    return line;
}

SourcePlace ControlFlow::called_from() const {
    return frames_.empty() ? SourcePlace{} : frames_.back().called_from;
}

// ---- blocks

ControlFlow::Open* ControlFlow::find_open(const std::string& label) {
    const auto found =
        std::find_if(open_.rbegin(), open_.rend(), [&](const Open& open) { return open.label == label; });
    return found == open_.rend() ? nullptr : &*found;
}

/// Ends the block of `label` and whatever was left open inside of it.
void ControlFlow::close(const std::string& label) {
    while (!open_.empty()) {
        const bool found = open_.back().label == label;
        open_.pop_back();
        if (found) {
            return;
        }
    }
}

/// One label opens one block of a subroutine, as in LinuxCNC.
void ControlFlow::note_label(const Line& line) {
    const SourcePlace place = run_.out.place();
    const auto [entry, is_new] = labels_.try_emplace(scope() + "#" + line.label, Label{line.word, place});
    if (!is_new && !(entry->second.place == place)) {
        refuse(line.column,
               fmt::format("label O{} is already used in line {}", line.label, entry->second.place.line));
    }
    if (labels_.size() > most_labels) {
        refuse(line.column, fmt::format("a program may have at most {} labels", most_labels));
    }
}

void ControlFlow::open_block(const Line& line, Cursor& cursor, OWord kind) {
    note_label(line);
    if (open_.size() >= deepest_blocks) {
        refuse(line.column, fmt::format("blocks are nested more than {} deep", deepest_blocks));
    }
    expect_end_of_line(cursor);
    open_.push_back({kind, line.label, files_.here(), run_.out.place()});
}

bool ControlFlow::condition(Cursor& cursor) const {
    const double value = read_bracketed(cursor, run_.variables);
    expect_end_of_line(cursor);
    return value < 0.0 || value > 0.0;
}

void ControlFlow::begin_if(const Line& line, Cursor& cursor) {
    Cursor rest = cursor;
    const bool holds = condition(cursor);
    static_cast<void>(read_bracketed(rest, run_.variables));
    open_block(line, rest, OWord::if_);
    if (!holds) {
        skip_branches(line);
    }
}

/// From a condition that does not hold to the branch that is to be executed, or to the end.
void ControlFlow::skip_branches(const Line& line) {
    const SourcePlace opened = run_.out.place();
    for (;;) {
        Cursor cursor{std::string_view()};
        const OWord word = skip_to(line.label, {OWord::elseif, OWord::else_, OWord::endif}, &cursor, opened);
        if (word == OWord::endif) {
            close(line.label);
            return;
        }
        if (word == OWord::else_ || condition(cursor)) {
            return;
        }
    }
}

/// A branch was executed completely.
void ControlFlow::leave_branch(const Line& line, Cursor& cursor) {
    if (line.word != OWord::elseif) { // whose condition does not matter any more
        expect_end_of_line(cursor);
    }
    const Open* open = find_open(line.label);
    if (open == nullptr || open->kind != OWord::if_) {
        refuse(line.column, fmt::format("O{} has no if", line.label));
    }
    if (line.word != OWord::endif) {
        skip_to(line.label, {OWord::endif}, nullptr, run_.out.place());
    }
    close(line.label);
}

void ControlFlow::while_or_end_of_do(const Line& line, Cursor& cursor) {
    const Open* open = find_open(line.label);
    if (open != nullptr && open->kind == OWord::do_) {
        if (condition(cursor)) {
            go_round(*open);
        } else {
            close(line.label);
        }
        return;
    }
    Cursor rest = cursor;
    const bool holds = condition(cursor);
    static_cast<void>(read_bracketed(rest, run_.variables));
    open_block(line, rest, OWord::while_);
    open_.back().begin = run_.line_begin;
    if (!holds) {
        skip_to(line.label, {OWord::endwhile}, nullptr, run_.out.place());
        close(line.label);
    }
}

void ControlFlow::begin_repeat(const Line& line, Cursor& cursor) {
    const int column = cursor.column();
    const double count = std::nearbyint(read_bracketed(cursor, run_.variables));
    constexpr double most_repeats = 1e9;
    if (!(count <= most_repeats)) {
        refuse(column, "a repeat count must not exceed 1e9");
    }
    open_block(line, cursor, OWord::repeat);
    open_.back().repeats = static_cast<int>(std::max(0.0, count)) - 1;
    if (count < 1.0) {
        skip_to(line.label, {OWord::endrepeat}, nullptr, run_.out.place());
        close(line.label);
    }
}

void ControlFlow::end_loop(const Line& line, Cursor& cursor, OWord kind) {
    expect_end_of_line(cursor);
    Open* open = find_open(line.label);
    if (open == nullptr || open->kind != kind) {
        refuse(line.column,
               fmt::format("O{} has no {}", line.label, kind == OWord::while_ ? "while" : "repeat"));
    }
    if (kind == OWord::repeat && open->repeats-- <= 0) {
        close(line.label);
        return;
    }
    go_round(*open);
    if (kind == OWord::while_) {
        close(line.label); // its line opens it again
    }
}

void ControlFlow::go_round(const Open& open) {
    note_turn(outer_depth() + static_cast<std::size_t>(&open - open_.data()), open.place);
    files_.go_to(open.begin);
}

void ControlFlow::note_turn(std::size_t depth, SourcePlace place) {
    if (!turned_ || depth < turned_->depth) {
        turned_ = {depth, place};
    }
}

std::size_t ControlFlow::outer_depth() const {
    std::size_t depth = 0;
    for (const Frame& frame : frames_) {
        depth += frame.caller_open.size() + 1;
    }
    return depth;
}

std::optional<SourcePlace> ControlFlow::turned() const {
    if (turned_) {
        return turned_->place;
    }
    return frames_.empty() ? std::nullopt : std::optional(frames_.front().called_from);
}

void ControlFlow::break_or_continue(const Line& line, Cursor& line_end) {
    expect_end_of_line(line_end);
    const Open* open = find_open(line.label);
    if (open == nullptr || (open->kind != OWord::while_ && open->kind != OWord::do_)) {
        refuse(line.column, fmt::format("O{} is not an open while or do loop", line.label));
    }
    const bool is_while = open->kind == OWord::while_;
    const SourcePlace place = run_.out.place();
    if (line.word == OWord::continue_ && is_while) {
        go_round(*open);
        close(line.label);
        return;
    }
    Cursor cursor{std::string_view()};
    skip_to(line.label, {is_while ? OWord::endwhile : OWord::while_}, &cursor, place);
    if (line.word == OWord::continue_ && condition(cursor)) {
        go_round(*find_open(line.label));
        return;
    }
    close(line.label);
}

bool ControlFlow::closes_program(std::string_view text) const {
    return run_.in_percents && files_.place().file == 0 && is_percent(text);
}

OWord ControlFlow::skip_to(const std::string& label,
                           std::initializer_list<OWord> words,
                           Cursor* cursor,
                           SourcePlace opened) {
    const bool defines = std::ranges::find(words, OWord::endsub) != words.end();
    std::string_view text;
    while (files_.next(text) && !closes_program(text)) {
        Cursor here(text);
        const auto head = read_plain_o_head(here);
        if (head && head->label == label &&
            std::find(words.begin(), words.end(), head->word) != words.end()) {
            if (cursor != nullptr) {
                *cursor = here;
            }
            const bool has_value =
                head->word == OWord::elseif || head->word == OWord::while_ || head->word == OWord::endsub;
            if (!has_value) {
                expect_end_of_line(here);
            }
            return head->word;
        }
        if (head && head->word == OWord::sub && defines) {
            refuse(1, "a subroutine definition must not contain another one");
        }
    }
    refuse(1, fmt::format("O{} of line {} is not closed", label, opened.line));
}

} // namespace millwright::gcode::internal
