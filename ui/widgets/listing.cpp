#include "ui/widgets/listing.h"

#include "core/base/error.h"
#include "core/base/text_search.h"
#include "ui/widgets/gcode_tokens.h"
#include "ui/widgets/internal/imgui_inside.h"
#include "ui/widgets/internal/rows.h"
#include "ui/widgets/internal/sideways.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>

namespace millwright::widgets {

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
