#include "ui/widgets/listing.h"

#include "core/base/error.h"
#include "core/base/text_search.h"
#include "ui/widgets/internal/imgui_inside.h"
#include "ui/widgets/internal/scrolling.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <cmath>

namespace millwright::widgets {

namespace {

bool is(std::string_view set, char c) {
    return set.find(c) != std::string_view::npos;
}

bool is_gcode_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r';
}

bool is_letter(char c) {
    return std::isalpha(static_cast<unsigned char>(c)) != 0;
}

bool is_number(char c) {
    return std::isdigit(static_cast<unsigned char>(c)) != 0 || is("+-.", c);
}

template <class Wanted> std::size_t run_of(std::string_view text, std::size_t from, Wanted&& wanted) {
    while (from < text.size() && wanted(text[from])) {
        ++from;
    }
    return from;
}

/// Behind the bracket that closes the one at the beginning; the end if none does.
std::size_t behind_bracket(std::string_view text) {
    int depth = 0;
    for (std::size_t n = 0; n < text.size(); ++n) {
        depth += text[n] == '[' ? 1 : text[n] == ']' ? -1 : 0;
        if (depth == 0) {
            return n + 1;
        }
    }
    return text.size();
}

std::size_t behind(std::string_view text, char end) {
    const std::size_t found = text.find(end);
    return found == std::string_view::npos ? text.size() : found + 1;
}

/// `#12`, `##3`, `#<name>`, with a following `=`.
std::size_t parameter_length(std::string_view text) {
    std::size_t n = run_of(text, 0, [](char c) { return c == '#'; });
    if (n < text.size() && text[n] == '<') {
        n += behind(text.substr(n), '>');
    } else if (n < text.size() && text[n] == '[') {
        n += behind_bracket(text.substr(n));
    } else {
        n = run_of(text, n, is_number);
    }
    return n < text.size() && text[n] == '=' ? n + 1 : n;
}

/// `o100 while`, `o<name> call`.
std::size_t o_word_length(std::string_view text) {
    std::size_t n = 1;
    if (n < text.size() && text[n] == '<') {
        n += behind(text.substr(n), '>');
    } else {
        n = run_of(text, n, is_number);
    }
    const std::size_t keyword = run_of(text, n, is_gcode_blank);
    return keyword < text.size() && is_letter(text[keyword]) ? run_of(text, keyword, is_letter) : n;
}

CodeKind kind_of_word(char letter) {
    switch (letter) {
    case 'N':
        return CodeKind::line_number;
    case 'G':
        return CodeKind::g_word;
    case 'M':
        return CodeKind::m_word;
    case 'F':
    case 'S':
    case 'T':
    case 'H':
    case 'D':
    case 'P':
    case 'Q':
    case 'L':
    case 'E':
        return CodeKind::parameter;
    default:
        return CodeKind::axis_word;
    }
}

} // namespace

CodeToken first_token(std::string_view text) {
    if (text.empty()) {
        return {};
    }
    const char head = text.front();
    if (is_gcode_blank(head)) {
        return {run_of(text, 0, is_gcode_blank), CodeKind::blank};
    }
    if (head == '(') {
        return {behind(text, ')'), CodeKind::comment};
    }
    if (head == ';') {
        return {text.size(), CodeKind::comment};
    }
    if (head == '%' || head == '/') {
        return {1, CodeKind::line_number};
    }
    if (head == '[') {
        return {behind_bracket(text), CodeKind::expression};
    }
    if (head == '#') {
        return {parameter_length(text), CodeKind::expression};
    }
    const char letter = static_cast<char>(std::toupper(static_cast<unsigned char>(head)));
    if (letter == 'O') {
        return {o_word_length(text), CodeKind::o_word};
    }
    if (is_letter(head)) {
        return {run_of(text, 1, is_number), kind_of_word(letter)};
    }
    return {is_number(head) ? run_of(text, 0, is_number) : 1, CodeKind::other};
}

namespace {

Colour colour_of(const Palette& colours, CodeKind kind) {
    switch (kind) {
    case CodeKind::blank:
    case CodeKind::comment:
    case CodeKind::line_number:
        return colours.muted;
    case CodeKind::g_word:
    case CodeKind::m_word:
        return colours.accent;
    case CodeKind::parameter:
        return colours.warning;
    case CodeKind::o_word:
    case CodeKind::expression:
        return colours.good;
    case CodeKind::axis_word:
    case CodeKind::other:
        break;
    }
    return colours.text;
}

/// Where the `count` first characters of a line end, in a font whose characters have one width.
float x_after(const Ui& ui, float x, std::string_view text, std::size_t count) {
    return x + text_width(ui.look().fonts.mono, text.substr(0, std::min(count, text.size())));
}

void mark_found(const Ui& ui, const Rect& place, std::string_view text, std::string_view wanted) {
    if (wanted.empty()) {
        return;
    }
    const TextPattern pattern(wanted);
    for (auto at = pattern.next(text, 0); at; at = pattern.next(text, *at + wanted.size())) {
        const float from = x_after(ui, place.x, text, *at);
        const float to = x_after(ui, place.x, text, *at + wanted.size());
        fill({from, place.y + 1.0F, to - from, place.h - 2.0F},
             faded(ui.colours().warning, 0.35),
             ui.px(2.0F));
    }
}

void underline(const Ui& ui, const Rect& place, std::string_view text, const LineFault& fault) {
    const auto first = static_cast<std::size_t>(std::max(fault.column - 1, 0));
    const std::size_t begin = first < text.size() ? first : 0;
    const std::size_t length =
        fault.column > 0 ? std::max<std::size_t>(first_token(text.substr(begin)).length, 1) : text.size();
    const float from = x_after(ui, place.x, text, begin);
    const float to = std::max(x_after(ui, place.x, text, begin + length), from + ui.px(6.0F));
    fill({from, place.bottom() - ui.px(3.0F), to - from, ui.px(2.0F)}, ui.colours().danger);
}

void draw_code(const Ui& ui, const Rect& place, std::string_view text, bool coloured) {
    const ImFont* font = ui.look().fonts.mono;
    float x = place.x;
    const float y = std::round(place.y + 0.5F * (place.h - font->FontSize));
    while (!text.empty()) {
        const CodeToken token = first_token(text);
        const std::string_view word = text.substr(0, token.length);
        ImGui::GetWindowDrawList()->AddText(font,
                                            font->FontSize,
                                            {std::round(x), y},
                                            coloured ? colour_of(ui.colours(), token.kind)
                                                     : ui.colours().text,
                                            word.data(),
                                            word.data() + word.size());
        x += text_width(font, word);
        text.remove_prefix(word.size());
    }
}

/// Brings `line` into sight when it is another one than in the last frame; true then.
bool follow_line(
    Ui& ui, const std::string& path, std::string_view what, std::ptrdiff_t line, float rows_in_sight) {
    const auto [shown, is_new] = ui.state().memory.try_emplace(path + "@" + std::string(what), -1.0);
    const auto wanted = static_cast<double>(line);
    const bool is_other = line >= 0 && std::abs(shown->second - wanted) > 0.5;
    if (is_other) {
        bring_into_sight(ui, path, line, rows_in_sight);
    }
    shown->second = wanted;
    return is_other;
}

/// Pixels of the longest line that was in sight so far; of a shorter text from its beginning.
double& longest_line(Ui& ui, const std::string& path, const ListingView& view) {
    auto& memory = ui.state().memory;
    double& lines = memory[path + "@lines"];
    double& longest = memory[path + "@longest"];
    if (static_cast<double>(view.lines) < lines) { // another text
        longest = 0.0;
    }
    lines = static_cast<double>(view.lines);
    return longest;
}

/// What was looked for, where a long line has it out of sight.
void show_found(const Ui& ui, Sideways& sideways, const ListingView& view) {
    if (view.found.empty()) {
        return;
    }
    const std::string text = view.line(view.wanted);
    if (const auto at = TextPattern(view.found).next(text, 0)) {
        sideways.bring_into_sight(x_after(ui, 0.0F, text, *at),
                                  x_after(ui, 0.0F, text, *at + view.found.size()));
    }
}

struct LinePlace {
    Rect row;
    float gutter = 0.0F;
    float shift = 0.0F; ///< of the text, to the left
};

/// Gives the width of its text.
float draw_line(Ui& ui,
                const std::string& path,
                const LinePlace& place,
                const ListingView& view,
                std::ptrdiff_t index,
                bool hovered) {
    const Palette& colours = ui.colours();
    const Rect& row = place.row;
    if (index == view.current) {
        fill(row, colours.selection);
    } else if (hovered) {
        fill(row, faded(colours.hover, 0.6));
    }
    const auto fault = view.fault ? view.fault(index) : std::nullopt;
    const Colour mark = fault ? colours.danger : view.mark ? view.mark(index) : 0;
    fill({row.x, row.y, ui.px(3.0F), row.h}, mark);
    if (view.numbers) {
        const Rect number{row.x + ui.px(6.0F), row.y, place.gutter - ui.px(14.0F), row.h};
        const Colour colour = index == view.current ? colours.text : faded(colours.muted, 0.75);
        draw_text(ui, ui.look().fonts.mono, number, colour, std::to_string(index + 1), Align::right);
    }
    const std::string text = view.line(index);
    const Rect room{row.x + place.gutter, row.y, row.w - place.gutter, row.h};
    const Rect code{room.x - place.shift, room.y, room.w, room.h};
    ImGui::PushClipRect(upper_left(room), lower_right(room), true);
    mark_found(ui, code, text, view.found);
    draw_code(ui, code, text, view.coloured);
    if (fault) {
        underline(ui, code, text, *fault);
    }
    ImGui::PopClipRect();
    const float width = text_width(ui.look().fonts.mono, text);
    if (hovered && (fault || width > room.w)) {
        offer_tip(ui, fmt::format("{}/{}", path, index), row, fault ? fault->message : text);
    }
    return width;
}

} // namespace

std::optional<std::ptrdiff_t> listing(Ui& ui, std::string_view id, const ListingView& view) {
    expects(view.lines >= 0 && (view.lines == 0 || view.line), "a listing provides its lines");
    const std::string own = ui.path(id);
    const float row_height = std::round(ui.look().fonts.mono->FontSize + ui.px(3.0F));
    const float height = view.height > 0.0F ? view.height : std::max(ui.rest().h, row_height);
    const Slot slot(ui, 0.0F, height);
    const Rect& box = slot.rect();
    fill(box, ui.colours().field);
    record_at(ui, own, box);
    if (view.lines == 0) {
        return std::nullopt;
    }
    Rect inner = box;
    Sideways sideways(ui, own, inner);
    follow_line(ui, own, "current", view.current, inner.h / row_height);
    if (follow_line(ui, own, "wanted", view.wanted, inner.h / row_height)) {
        show_found(ui, sideways, view);
    }
    const Rows rows(ui, own, inner, view.lines, row_height);
    const Rect inside{inner.x, inner.y, rows.row(0).w, inner.h};
    const Press now = press(ui, own + "/lines", inside);
    if (rows.scrolls()) {
        keep_wheel();
    }
    const float digits = text_width(ui.look().fonts.mono, std::to_string(view.lines));
    const float gutter = view.numbers ? digits + ui.px(20.0F) : ui.px(10.0F);
    double& longest = longest_line(ui, own, view);
    const float shift = sideways.shift();
    std::optional<std::ptrdiff_t> clicked;
    for (std::ptrdiff_t i = rows.first(); i < rows.end(); ++i) {
        const Rect row = rows.row(i);
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        const bool hovered = now.hovered && row.contains({mouse.x, mouse.y});
        const float width = draw_line(ui, own, {row, gutter, shift}, view, i, hovered);
        longest = std::max(longest, static_cast<double>(width));
        clicked = now.clicked && hovered ? std::optional(i) : clicked;
    }
    const float room = inside.w - gutter;
    const auto needed = static_cast<float>(longest);
    sideways.content(needed > room ? needed + ui.px(10.0F) : needed, room);
    return clicked;
}

} // namespace millwright::widgets
