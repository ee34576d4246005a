#include "ui/widgets/listing.h"

#include "core/base/error.h"
#include "ui/widgets/internal/imgui_inside.h"
#include "ui/widgets/internal/rows.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::widgets {

namespace {

Colour word_colour(const Palette& colours, std::string_view word) {
    switch (word.front()) {
    case '(':
    case ';':
    case '%':
    case 'N':
        return colours.muted;
    case 'G':
    case 'M':
        return colours.accent;
    case 'F':
    case 'S':
    case 'T':
        return colours.warning;
    default:
        return colours.text;
    }
}

/// The next word with the blanks before it; a comment is one word.
std::pair<std::string_view, std::string_view> split_word(std::string_view text) {
    const std::size_t start = text.find_first_not_of(' ');
    if (start == std::string_view::npos) {
        return {text, {}};
    }
    const char head = text[start];
    std::size_t end = std::string_view::npos;
    if (head == '(') {
        end = text.find(')', start);
        end = end == std::string_view::npos ? end : end + 1;
    } else if (head != ';') {
        end = text.find_first_of(" (;", start + 1);
    }
    end = std::min(end, text.size());
    return {text.substr(0, end), text.substr(end)};
}

void draw_code(const Ui& ui, const Rect& place, std::string_view text) {
    const ImFont* font = ui.look().fonts.mono;
    float x = place.x;
    const float y = std::round(place.y + 0.5F * (place.h - font->FontSize));
    while (!text.empty() && x < place.right()) {
        const auto [word, others] = split_word(text);
        const std::size_t start = std::min(word.find_first_not_of(' '), word.size() - 1);
        const Colour colour = word_colour(ui.colours(), word.substr(start));
        ImGui::GetWindowDrawList()->AddText(
            font, font->FontSize, {std::round(x), y}, colour, word.data(), word.data() + word.size());
        x += text_width(font, word);
        text = others;
    }
}

void follow_current(Ui& ui, const std::string& path, const ListingView& view, float rows_in_sight) {
    const auto [shown, is_new] = ui.state().memory.try_emplace(path + "@current", -1.0);
    const auto current = static_cast<double>(view.current);
    if (view.current >= 0 && std::abs(shown->second - current) > 0.5) {
        bring_into_sight(ui, path, view.current, rows_in_sight);
    }
    shown->second = current;
}

void draw_line(
    Ui& ui, const Rect& row, float gutter, const ListingView& view, std::ptrdiff_t index, bool hovered) {
    const Palette& colours = ui.colours();
    if (index == view.current) {
        fill(row, colours.selection);
    } else if (hovered) {
        fill(row, faded(colours.hover, 0.6));
    }
    const Colour mark = view.mark ? view.mark(index) : 0;
    fill({row.x, row.y, ui.px(3.0F), row.h}, mark);
    const Rect number{row.x + ui.px(6.0F), row.y, gutter - ui.px(14.0F), row.h};
    const Colour number_colour = index == view.current ? colours.text : faded(colours.muted, 0.75);
    draw_text(ui, ui.look().fonts.mono, number, number_colour, std::to_string(index + 1), Align::right);
    draw_code(ui, {row.x + gutter, row.y, row.w - gutter, row.h}, view.line(index));
}

} // namespace

std::optional<std::ptrdiff_t> listing(Ui& ui, std::string_view id, const ListingView& view) {
    expects(view.lines >= 0 && (view.lines == 0 || view.line), "a listing can tell its lines");
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
    follow_current(ui, own, view, box.h / row_height);
    const Rows rows(ui, own, box, view.lines, row_height);
    const Rect inside{box.x, box.y, rows.row(0).w, box.h};
    const Press now = press(ui, own + "/lines", inside);
    if (rows.scrolls()) {
        keep_wheel();
    }
    const float digits = text_width(ui.look().fonts.mono, std::to_string(view.lines));
    std::optional<std::ptrdiff_t> clicked;
    for (std::ptrdiff_t i = rows.first(); i < rows.end(); ++i) {
        const Rect row = rows.row(i);
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        const bool hovered = now.hovered && row.contains({mouse.x, mouse.y});
        draw_line(ui, row, digits + ui.px(20.0F), view, i, hovered);
        clicked = now.clicked && hovered ? std::optional(i) : clicked;
    }
    return clicked;
}

} // namespace millwright::widgets
