#include "ui/widgets/table.h"

#include "core/base/error.h"
#include "ui/widgets/internal/imgui_inside.h"
#include "ui/widgets/internal/scrolling.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace millwright::widgets {

namespace {

constexpr float cell_pad = gaps::small;
constexpr float widest_text = 420.0F; // that a column of texts claims of a table that is too narrow for all

struct Span {
    float x;
    float w;
};

/// Pixels that each column needs for its header and for all cells seen of it: what a table has shown does not
/// move while it is scrolled.
class ColumnNeeds {
public:
    ColumnNeeds(Ui& ui, const std::string& path, const TableView& view) : ui_(ui), path_(path) {
        double& rows = ui.state().memory[path + "@rows"];
        const bool is_other = std::abs(rows - static_cast<double>(view.rows)) > 0.5;
        rows = static_cast<double>(view.rows);
        for (std::size_t c = 0; c < view.columns.size(); ++c) {
            double& needed = need(c);
            needed = is_other ? 0.0 : needed;
        }
    }

    void take(std::size_t column, const ImFont* font, std::string_view text) {
        const float width = std::ceil(text_width(font, text)) + 2.0F * ui_.px(cell_pad);
        need(column) = std::max(need(column), static_cast<double>(width));
    }
    [[nodiscard]] float of(std::size_t column) const { return static_cast<float>(need(column)); }

private:
    [[nodiscard]] double& need(std::size_t column) const {
        return ui_.state().memory[path_ + "@needed" + std::to_string(column)];
    }

    Ui& ui_;
    std::string path_;
};

/// By their shares, but none narrower than it needs while others have room to spare; where all of them do not
/// have room, as wide as they need. From x = 0.
std::vector<Span> column_spans(const Ui& ui, const TableView& view, const ColumnNeeds& needs, float width) {
    const std::size_t count = view.columns.size();
    std::vector<float> least(count);
    float needed = 0.0F, shares = 0.0F;
    for (std::size_t c = 0; c < count; ++c) {
        least[c] = needs.of(c);
        needed += least[c];
        shares += view.columns[c].share;
    }
    float at_least = 0.0F;
    for (std::size_t c = 0; c < count; ++c) {
        if (needed > width && !view.columns[c].is_number) {
            least[c] = std::min(least[c], ui.px(widest_text));
        }
        at_least += least[c];
    }
    std::vector<float> widths = least;
    if (at_least <= width) {
        float taken = 0.0F;
        for (std::size_t c = 0; c < count; ++c) {
            widths[c] = std::max(least[c], width * view.columns[c].share / shares);
            taken += widths[c];
        }
        const float spare = taken - at_least;
        const float given = spare > 0.0F ? (width - at_least) / spare : 0.0F;
        for (std::size_t c = 0; c < count; ++c) {
            widths[c] = least[c] + (widths[c] - least[c]) * given;
        }
    }
    std::vector<Span> spans;
    float before = 0.0F;
    for (const float wide : widths) {
        const float x = std::round(before);
        before += wide;
        spans.push_back({x, std::round(before) - x});
    }
    return spans;
}

/// Of the row or header `line`, whose content is moved to the left.
Rect cell_place(const Ui& ui, const Span& span, const Rect& line, float shift) {
    const float pad = ui.px(cell_pad);
    return {line.x - shift + span.x + pad, line.y, span.w - 2.0F * pad, line.h};
}

std::string header_text(const Column& column) {
    return column.unit.empty() ? std::string(column.label)
                               : std::string(column.label) + " (" + std::string(column.unit) + ")";
}

struct ColumnPlaces {
    std::vector<Span> spans;
    float shift = 0.0F;
};

void draw_header(
    Ui& ui, const std::string& own, const Rect& bar, const TableView& view, const ColumnPlaces& at) {
    fill(bar, ui.colours().raised);
    ImGui::PushClipRect(upper_left(bar), lower_right(bar), true);
    for (std::size_t c = 0; c < at.spans.size(); ++c) {
        const Column& column = view.columns[c];
        const std::string text = header_text(column);
        const Rect place = cell_place(ui, at.spans[c], bar, at.shift);
        const Align align = column.is_number ? Align::right : Align::left;
        const bool cut = draw_text(ui, ui.look().fonts.small, place, ui.colours().muted, text, align);
        offer_tip(ui, own, place, cut ? std::string_view(text) : std::string_view());
    }
    ImGui::PopClipRect();
}

using RowTexts = std::vector<std::string>;

void draw_row_cells(Ui& ui,
                    const std::string& own,
                    const Rect& row,
                    const TableView& view,
                    const ColumnPlaces& at,
                    std::ptrdiff_t index,
                    const RowTexts& texts) {
    for (std::size_t c = 0; c < at.spans.size(); ++c) {
        const std::string& text = texts[c];
        const Rect place = cell_place(ui, at.spans[c], row, at.shift);
        const Align align = view.columns[c].is_number ? Align::right : Align::left;
        const bool muted = view.is_muted && view.is_muted(index, static_cast<int>(c));
        const Colour colour = muted ? ui.colours().muted : ui.colours().text;
        const bool cut = draw_text(ui, ui.look().fonts.text, place, colour, text, align);
        offer_tip(ui, own, place, cut ? std::string_view(text) : std::string_view());
    }
}

bool draw_table_row(Ui& ui,
                    const std::string& own,
                    const Rows& rows,
                    const TableView& view,
                    const ColumnPlaces& at,
                    std::ptrdiff_t index,
                    const RowTexts& texts) {
    const std::string path = own + "/" + view.row_id(index);
    const Press now = press(ui, path, rows.row_in_sight(index));
    if (rows.scrolls()) {
        keep_wheel();
    }
    const Rect row = rows.row(index);
    if (index == view.chosen || (view.is_chosen && view.is_chosen(index))) {
        fill(row, ui.colours().selection);
    } else if (now.hovered) {
        fill(row, faded(ui.colours().hover, 0.6));
    }
    fill({row.x, row.bottom() - 1.0F, row.w, 1.0F}, faded(ui.colours().line, 0.5));
    draw_row_cells(ui, path, row, view, at, index, texts);
    return now.clicked;
}

/// Of the rows in sight: each cell is asked for once.
std::vector<RowTexts>
texts_in_sight(const Ui& ui, const Rows& rows, const TableView& view, ColumnNeeds& needs) {
    std::vector<RowTexts> all;
    for (std::ptrdiff_t i = rows.first(); i < rows.end(); ++i) {
        RowTexts& texts = all.emplace_back();
        for (std::size_t c = 0; c < view.columns.size(); ++c) {
            texts.push_back(view.cell(i, static_cast<int>(c)));
            needs.take(c, ui.look().fonts.text, texts.back());
        }
    }
    return all;
}

} // namespace

std::optional<std::ptrdiff_t> table(Ui& ui, std::string_view id, const TableView& view) {
    expects(!view.columns.empty() && view.cell && view.row_id, "a table has columns, cells and row ids");
    const std::string own = ui.path(id);
    const float row_height = ui.px(gaps::row - 2.0F);
    const float header = ui.px(gaps::row - 2.0F);
    const auto lines = static_cast<float>(std::max<std::ptrdiff_t>(view.rows, 1));
    const float height =
        view.height > 0.0F ? view.height : header + lines * row_height + Sideways::strip(ui, own);
    const Slot slot(ui, 0.0F, height);
    const Rect& box = slot.rect();
    fill(box, ui.colours().field, ui.px(gaps::rounding));
    record_at(ui, own, box);
    const Rect header_bar{box.x, box.y, box.w, header};
    Rect body{box.x, box.y + header, box.w, box.h - header};
    ColumnNeeds needs(ui, own, view);
    for (std::size_t c = 0; c < view.columns.size(); ++c) {
        needs.take(c, ui.look().fonts.small, header_text(view.columns[c]));
    }
    if (view.rows == 0) {
        draw_header(ui, own, header_bar, view, {column_spans(ui, view, needs, box.w)});
        draw_text(ui, ui.look().fonts.text, body, ui.colours().muted, view.when_empty, Align::centre);
        return std::nullopt;
    }
    Sideways sideways(ui, own, body);
    if (view.wanted >= 0 && view.wanted < view.rows) {
        bring_into_sight(ui, own, view.wanted, body.h / row_height);
    }
    std::optional<std::ptrdiff_t> clicked;
    ColumnPlaces at;
    Rect line = header_bar;
    {
        const Rows rows(ui, own, body, view.rows, row_height);
        line.w = rows.row(0).w;
        const std::vector<RowTexts> texts = texts_in_sight(ui, rows, view, needs);
        at.spans = column_spans(ui, view, needs, line.w);
        sideways.content(at.spans.back().x + at.spans.back().w, line.w);
        at.shift = sideways.shift();
        ui.state().scrolls_sideways = Sideways::strip(ui, own) > 0.0F;
        for (std::ptrdiff_t i = rows.first(); i < rows.end(); ++i) {
            if (draw_table_row(
                    ui, own, rows, view, at, i, texts[static_cast<std::size_t>(i - rows.first())])) {
                clicked = i;
            }
        }
    }
    fill(header_bar, ui.colours().raised);
    draw_header(ui, own, line, view, at);
    ui.state().scrolls_sideways = false;
    return clicked;
}

} // namespace millwright::widgets
