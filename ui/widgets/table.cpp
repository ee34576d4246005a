#include "ui/widgets/table.h"

#include "core/base/error.h"
#include "ui/widgets/internal/imgui_inside.h"
#include "ui/widgets/internal/rows.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace millwright::widgets {

namespace {

struct Span {
    float x;
    float w;
};

std::vector<Span> column_spans(const Rect& row, std::span<const Column> columns) {
    float shares = 0.0F;
    for (const Column& column : columns) {
        shares += column.share;
    }
    std::vector<Span> spans;
    float before = 0.0F;
    for (const Column& column : columns) {
        const float x = std::round(row.x + row.w * before / shares);
        before += column.share;
        spans.push_back({x, std::round(row.x + row.w * before / shares) - x});
    }
    return spans;
}

Rect padded(const Ui& ui, const Span& span, const Rect& row) {
    const float pad = ui.px(8.0F);
    return {span.x + pad, row.y, span.w - 2.0F * pad, row.h};
}

std::string header_text(const Column& column) {
    return column.unit.empty() ? std::string(column.label)
                               : std::string(column.label) + " (" + std::string(column.unit) + ")";
}

void draw_header(Ui& ui, const std::string& own, const Rect& bar, const TableView& view, float width) {
    fill(bar, ui.colours().raised);
    const auto spans = column_spans({bar.x, bar.y, width, bar.h}, view.columns);
    for (std::size_t c = 0; c < spans.size(); ++c) {
        const Column& column = view.columns[c];
        const std::string text = header_text(column);
        const Rect place = padded(ui, spans[c], bar);
        const Align align = column.is_number ? Align::right : Align::left;
        const bool cut = draw_text(ui, ui.look().fonts.small, place, ui.colours().muted, text, align);
        offer_tip(ui, own, place, cut ? std::string_view(text) : std::string_view());
    }
}

void draw_row_cells(
    Ui& ui, const std::string& own, const Rect& row, const TableView& view, std::ptrdiff_t index) {
    const auto spans = column_spans(row, view.columns);
    for (std::size_t c = 0; c < spans.size(); ++c) {
        const std::string text = view.cell(index, static_cast<int>(c));
        const Rect place = padded(ui, spans[c], row);
        const Align align = view.columns[c].is_number ? Align::right : Align::left;
        const bool muted = view.is_muted && view.is_muted(index, static_cast<int>(c));
        const Colour colour = muted ? ui.colours().muted : ui.colours().text;
        const bool cut = draw_text(ui, ui.look().fonts.text, place, colour, text, align);
        offer_tip(ui, own, place, cut ? std::string_view(text) : std::string_view());
    }
}

bool draw_table_row(
    Ui& ui, const std::string& own, const Rows& rows, const TableView& view, std::ptrdiff_t index) {
    const std::string path = own + "/" + view.row_id(index);
    const Press now = press(ui, path, rows.row_in_sight(index));
    if (rows.scrolls()) {
        keep_wheel();
    }
    const Rect row = rows.row(index);
    if (index == view.chosen) {
        fill(row, ui.colours().selection);
    } else if (now.hovered) {
        fill(row, faded(ui.colours().hover, 0.6));
    }
    fill({row.x, row.bottom() - 1.0F, row.w, 1.0F}, faded(ui.colours().line, 0.5));
    draw_row_cells(ui, path, row, view, index);
    return now.clicked;
}

} // namespace

std::optional<std::ptrdiff_t> table(Ui& ui, std::string_view id, const TableView& view) {
    expects(!view.columns.empty() && view.cell && view.row_id, "a table has columns, cells and row ids");
    const std::string own = ui.path(id);
    const float row_height = ui.px(gaps::row - 2.0F);
    const float header = ui.px(gaps::row - 2.0F);
    const auto lines = static_cast<float>(std::max<std::ptrdiff_t>(view.rows, 1));
    const float height = view.height > 0.0F ? view.height : header + lines * row_height;
    const Slot slot(ui, 0.0F, height);
    const Rect& box = slot.rect();
    fill(box, ui.colours().field, ui.px(gaps::rounding));
    record_at(ui, own, box);
    const Rect body{box.x, box.y + header, box.w, box.h - header};
    if (view.rows == 0) {
        draw_header(ui, own, {box.x, box.y, box.w, header}, view, box.w);
        draw_text(ui, ui.look().fonts.text, body, ui.colours().muted, view.when_empty, Align::centre);
        return std::nullopt;
    }
    if (view.wanted >= 0 && view.wanted < view.rows) {
        bring_into_sight(ui, own, view.wanted, body.h / row_height);
    }
    std::optional<std::ptrdiff_t> clicked;
    float width = box.w;
    {
        const Rows rows(ui, own, body, view.rows, row_height);
        width = rows.row(0).w;
        for (std::ptrdiff_t i = rows.first(); i < rows.end(); ++i) {
            if (draw_table_row(ui, own, rows, view, i)) {
                clicked = i;
            }
        }
    }
    draw_header(ui, own, {box.x, box.y, box.w, header}, view, width);
    return clicked;
}

} // namespace millwright::widgets
