#include "ui/widgets/plot.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/text.h"
#include "ui/widgets/internal/curve.h"
#include "ui/widgets/ticks.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <vector>

namespace millwright::widgets {

namespace {

constexpr float least_height = 80.0F;
constexpr float line_width = 1.6F;
constexpr float zeros_height = 22.0F; // the strip of the zeros of a logarithmic plot

Colour series_colour(const Palette& colours, std::span<const Series> series, std::size_t index) {
    const Colour own = series[index].colour;
    return own != 0 ? own : colours.series[index % std::size(colours.series)];
}

struct Range {
    double low = std::numeric_limits<double>::infinity();
    double high = -std::numeric_limits<double>::infinity();

    void add(double value) {
        low = std::min(low, value);
        high = std::max(high, value);
    }
    [[nodiscard]] bool is_empty() const { return !(low <= high); }
    void widen(double share) {
        const double span = high - low;
        const double more = span > 0.0 ? share * span : std::max(1.0, std::abs(high)) * 0.5;
        high += more;
        low -= span > 0.0 ? 0.0 : more;
    }
};

/// A value that a logarithmic axis has no place for, though it is the best that there is.
bool is_zero_on_log(const PlotView& view, double x, double y) {
    return view.y_is_log && std::isfinite(x) && exactly_equal(y, 0.0);
}

bool has_zeros(const PlotView& view) {
    for (const Series& series : view.series) {
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            if (is_zero_on_log(view, series.x[i], series.y[i])) {
                return true;
            }
        }
    }
    return false;
}

/// Empty when no point has a place.
std::optional<Mapping> mapping_of(const PlotView& view) {
    Mapping mapping;
    mapping.y_is_log = view.y_is_log;
    Range x;
    Range y;
    for (const Series& series : view.series) {
        expects(series.x.size() == series.y.size(), "a series has as many x as y");
        for (std::size_t i = 0; i < series.x.size(); ++i) {
            if (mapping.has_place(series.x[i], series.y[i])) {
                x.add(series.x[i]);
                y.add(series.y[i]);
            } else if (is_zero_on_log(view, series.x[i], series.y[i])) {
                x.add(series.x[i]);
            }
        }
    }
    if (x.is_empty()) {
        return std::nullopt;
    }
    if (y.is_empty()) { // nothing but zeros
        y.add(1.0);
    }
    if (view.limit_y && mapping.has_place(0.0, *view.limit_y)) {
        y.add(*view.limit_y);
    }
    if (view.y_is_log) {
        y.low = std::pow(10.0, std::floor(std::log10(y.low)));
        y.high = std::pow(10.0, std::floor(std::log10(y.high)) + 1.0);
    } else {
        if (view.y_from_zero) {
            y.add(0.0);
        }
        y.widen(0.06);
    }
    if (!(x.high > x.low)) {
        x = {x.low - 0.5, x.low + 0.5};
    }
    if (!std::isfinite(x.high - x.low) || !std::isfinite(y.high - y.low)) {
        return std::nullopt; // wider than numbers go
    }
    mapping.x_low = x.low;
    mapping.x_high = x.high;
    mapping.y_low = y.low;
    mapping.y_high = y.high;
    return mapping;
}

std::string axis_title(std::string_view label, std::string_view unit) {
    return unit.empty() ? std::string(label) : fmt::format("{} ({})", label, unit);
}

/// Powers of ten, thinned out to what fits.
std::vector<std::pair<double, std::string>> log_ticks(const Mapping& mapping, int at_most) {
    const int first = static_cast<int>(std::lround(std::log10(mapping.y_low)));
    const int last = static_cast<int>(std::lround(std::log10(mapping.y_high)));
    const int step = std::max(1, (last - first + at_most) / std::max(1, at_most));
    std::vector<std::pair<double, std::string>> found;
    for (int exponent = first; exponent <= last; exponent += step) {
        found.emplace_back(std::pow(10.0, exponent), fmt::format("1e{}", exponent));
    }
    return found;
}

using TextTicks = std::vector<std::pair<double, std::string>>;

TextTicks y_ticks(const Mapping& mapping, int at_most) {
    if (mapping.y_is_log) {
        return log_ticks(mapping, at_most);
    }
    const Ticks found = scale_ticks(mapping.y_low, mapping.y_high, at_most);
    TextTicks texts;
    for (const double value : found.values) {
        texts.emplace_back(value, tick_text(value, found));
    }
    return texts;
}

/// Left of the plot: as wide as its longest number, but plots of usual numbers stand below each other.
float gutter_of(const Ui& ui, const TextTicks& ticks) {
    float width = ui.px(52.0F);
    for (const auto& [value, text] : ticks) {
        width = std::max(width, text_width(ui.look().fonts.small, text) + ui.px(8.0F));
    }
    return width;
}

/// Title at the left, the series and their colours at the right, of the line above the plot.
void draw_key(Ui& ui, const Rect& line, const PlotView& view) {
    const ImFont* font = ui.look().fonts.small;
    const std::string title = axis_title(view.y_label, view.y_unit);
    draw_text(ui, font, line, ui.colours().muted, title);
    float right = line.right();
    for (std::size_t i = view.series.size(); i-- > 0;) {
        const std::string_view label = view.series[i].label;
        const float width = text_width(font, label);
        draw_text(ui, font, {right - width, line.y, width, line.h}, ui.colours().text, label);
        const float swatch = ui.px(12.0F);
        const float x = right - width - swatch - ui.px(5.0F);
        fill({x, std::round(line.centre().y) - ui.px(1.5F), swatch, ui.px(3.0F)},
             series_colour(ui.colours(), view.series, i),
             ui.px(1.5F));
        right = x - ui.px(14.0F);
    }
}

/// `bottom`: where x is told, below everything.
void draw_axes(
    Ui& ui, const Mapping& mapping, const TextTicks& rows, float left, float bottom, const PlotView& view) {
    const ImFont* font = ui.look().fonts.small;
    const Palette& colours = ui.colours();
    const Rect& box = mapping.box;
    const float line = font->FontSize;
    for (const auto& [value, text] : rows) {
        const float y = std::round(mapping.pixel_y(value));
        fill({box.x, y, box.w, 1.0F}, faded(colours.line, 0.5));
        const float right = box.x - ui.px(6.0F);
        draw_text(ui, font, {left, y - 0.5F * line, right - left, line}, colours.muted, text, Align::right);
    }
    const Ticks found =
        ticks(mapping.x_low, mapping.x_high, std::max(2, static_cast<int>(box.w / ui.px(70.0F))));
    const std::string title = axis_title(view.x_label, view.x_unit);
    const float title_x = box.right() - text_width(font, title);
    for (const double value : found.values) {
        const std::string text = tick_text(value, found);
        const float half = 0.5F * text_width(font, text);
        const float x = mapping.pixel_x(value);
        fill({std::round(x), bottom, 1.0F, ui.px(4.0F)}, colours.line);
        if (x + half < title_x - ui.px(8.0F)) {
            const Rect place{x - half, bottom + ui.px(5.0F), 2.0F * half + 1.0F, line};
            draw_text(ui, font, place, colours.muted, text, Align::centre);
        }
    }
    fill({box.x, bottom, box.w, 1.0F}, colours.line);
    const Rect place{title_x, bottom + ui.px(5.0F), box.right() - title_x + 1.0F, line};
    draw_text(ui, font, place, colours.muted, title, Align::right);
}

void draw_series(Ui& ui, const Mapping& mapping, const PlotView& view) {
    ImGui::PushClipRect(upper_left(mapping.box), {mapping.box.right(), mapping.box.bottom() + 1.0F}, true);
    for (std::size_t i = 0; i < view.series.size(); ++i) {
        const Series& series = view.series[i];
        const Colour colour = series_colour(ui.colours(), view.series, i);
        for (const auto& run : runs(mapping, series.x, series.y)) {
            if (series.is_filled) {
                fill_below(run, mapping.box.bottom(), faded(colour, 0.25));
            }
            draw_run(run, colour, ui.px(line_width));
        }
    }
    if (view.limit_y && mapping.has_place(0.0, *view.limit_y)) {
        const float y = std::round(mapping.pixel_y(*view.limit_y));
        const float dash = ui.px(6.0F);
        for (float x = mapping.box.x; x < mapping.box.right(); x += 2.0F * dash) {
            fill({x, y, dash, 1.0F}, ui.colours().warning);
        }
    }
    if (view.cursor_x && std::isfinite(*view.cursor_x)) {
        const float x = std::round(mapping.pixel_x(*view.cursor_x));
        fill({x - 0.5F, mapping.box.y, ui.px(1.5F), mapping.box.h}, ui.colours().accent);
    }
    ImGui::PopClipRect();
}

/// A cross for each zero of a logarithmic plot, in `strip` below its curves.
void draw_zeros(Ui& ui, const Mapping& mapping, const Rect& strip, float left, const PlotView& view) {
    const ImFont* font = ui.look().fonts.small;
    const float right = strip.x - ui.px(6.0F);
    draw_text(ui, font, {left, strip.y, right - left, strip.h}, ui.colours().muted, "0", Align::right);
    const float middle = strip.centre().y;
    const float arm = ui.px(3.0F);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (std::size_t i = 0; i < view.series.size(); ++i) {
        const Series& series = view.series[i];
        const Colour colour = series_colour(ui.colours(), view.series, i);
        float last = -std::numeric_limits<float>::infinity();
        for (std::size_t n = 0; n < series.x.size(); ++n) {
            const float x = mapping.pixel_x(series.x[n]);
            if (is_zero_on_log(view, series.x[n], series.y[n]) && x - last >= 1.0F) { // one a column
                list.AddLine({x - arm, middle - arm}, {x + arm, middle + arm}, colour, ui.px(line_width));
                list.AddLine({x - arm, middle + arm}, {x + arm, middle - arm}, colour, ui.px(line_width));
                last = x;
            }
        }
    }
}

/// The values nearest in x, as a tip beside the mouse.
void read_out(Ui& ui, const std::string& path, const Mapping& mapping, const PlotView& view) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const double x = mapping.value_x(mouse.x);
    std::string text;
    for (const Series& series : view.series) {
        if (series.x.empty()) {
            continue;
        }
        auto at = std::lower_bound(series.x.begin(), series.x.end(), x);
        const bool before_is_nearer =
            at == series.x.end() || (at != series.x.begin() && x - *(at - 1) < *at - x);
        at = before_is_nearer ? at - 1 : at;
        const double value = series.y[static_cast<std::size_t>(at - series.x.begin())];
        text += text.empty() ? fmt::format("{} {:.6g} {}", view.x_label, *at, view.x_unit) : "";
        text += std::isfinite(value) ? fmt::format("\n{}: {:.5g} {}", series.label, value, view.y_unit)
                                     : fmt::format("\n{}: –", series.label);
    }
    fill({std::round(mouse.x), mapping.box.y, 1.0F, mapping.box.h}, ui.colours().muted);
    show_at_mouse(ui, path, text);
}

} // namespace

std::optional<double> line_plot(Ui& ui, std::string_view id, const PlotView& view) {
    const std::string own = ui.path(id);
    const float height = view.height > 0.0F ? view.height : std::max(ui.rest().h, ui.px(least_height));
    const Slot slot(ui, 0.0F, height);
    const Rect& all = slot.rect();
    auto mapping = mapping_of(view);
    if (!mapping) {
        fill(all, ui.colours().field, ui.px(2.0F));
        record_at(ui, own, all);
        draw_text(ui, ui.look().fonts.text, all, ui.colours().muted, view.when_empty, Align::centre);
        return std::nullopt;
    }
    const float line = ui.look().fonts.small->FontSize;
    draw_key(ui, {all.x, all.y, all.w, line}, view);
    const float top = line + ui.px(6.0F);
    const float inside = all.h - top - line - ui.px(6.0F);
    const float strip = has_zeros(view) ? ui.px(zeros_height) : 0.0F;
    const TextTicks rows = y_ticks(*mapping, std::max(2, static_cast<int>((inside - strip) / (2.2F * line))));
    const float left = gutter_of(ui, rows);
    const Rect box{all.x + left, all.y + top, all.w - left - ui.px(4.0F), inside};
    fill(box, ui.colours().field, ui.px(2.0F));
    const Press now = press(ui, own, box);
    mapping->box = box;
    mapping->box.h -= strip;
    draw_axes(ui, *mapping, rows, all.x, box.bottom(), view);
    if (strip > 0.0F) {
        const Rect zeros{box.x, mapping->box.bottom(), box.w, strip};
        draw_zeros(ui, *mapping, zeros, all.x, view);
        record_at(ui, own + "/zeros", zeros);
    }
    draw_series(ui, *mapping, view);
    if (now.hovered) {
        read_out(ui, own, *mapping, view);
    }
    return now.clicked ? std::optional(mapping->value_x(ImGui::GetIO().MousePos.x)) : std::nullopt;
}

} // namespace millwright::widgets
