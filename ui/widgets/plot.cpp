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

constexpr float least_plot_height = 80.0F;
constexpr float line_width = 1.6F;
constexpr float dash_length = 7.0F;
constexpr float marker_size = 4.0F;
constexpr float zeros_height = 22.0F; // the strip of the zeros of a logarithmic plot

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
std::optional<Mapping> plot_mapping(const PlotView& view) {
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
    if (view.y_is_log && view.y_is_fitted) {
        const double more = std::pow(std::max(y.high / y.low, 1.1), 0.08);
        y = {y.low / more, y.high * more};
    } else if (view.y_is_log) {
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
    if (!view.x_ticks.empty()) { // room for the texts at the ends
        const double more = 0.02 * (x.high - x.low);
        x = {x.low - more, x.high + more};
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

using TextTicks = std::vector<std::pair<double, std::string>>;

/// Powers of ten, between them 2 and 5 or all digits where that leaves too few.
TextTicks fitted_log_ticks(const Mapping& mapping, int at_most) {
    const int first = static_cast<int>(std::floor(std::log10(mapping.y_low)));
    const int last = static_cast<int>(std::ceil(std::log10(mapping.y_high)));
    TextTicks found;
    for (const std::vector<int>& digits : {std::vector{1, 2, 3, 4, 5, 6, 7, 8, 9}, {1, 2, 5}, {1}}) {
        TextTicks tried;
        for (int exponent = first; exponent <= last; ++exponent) {
            for (const int digit : digits) {
                const double value = digit * std::pow(10.0, exponent);
                if (value >= mapping.y_low && value <= mapping.y_high) {
                    tried.emplace_back(value, fmt::format("{:g}", value));
                }
            }
        }
        if (found.empty() || tried.size() > 1) {
            found = std::move(tried);
        }
        if (std::ssize(found) <= at_most) {
            break;
        }
    }
    return found;
}

/// Powers of ten, thinned out to what fits.
TextTicks log_ticks(const Mapping& mapping, int at_most) {
    const int first = static_cast<int>(std::lround(std::log10(mapping.y_low)));
    const int last = static_cast<int>(std::lround(std::log10(mapping.y_high)));
    const int step = std::max(1, (last - first + at_most) / std::max(1, at_most));
    TextTicks found;
    for (int exponent = first; exponent <= last; exponent += step) {
        found.emplace_back(std::pow(10.0, exponent), fmt::format("1e{}", exponent));
    }
    return found;
}

TextTicks y_ticks(const Mapping& mapping, int at_most, bool is_fitted) {
    if (mapping.y_is_log) {
        return is_fitted ? fitted_log_ticks(mapping, at_most) : log_ticks(mapping, at_most);
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

std::string key_title(const PlotView& view) {
    const std::string y = axis_title(view.y_label, view.y_unit);
    return view.x_ticks.empty() || view.x_label.empty()
               ? y
               : fmt::format("{} over {}", y, axis_title(view.x_label, view.x_unit));
}

float swatch_width(const Ui& ui, const Series& series) {
    return ui.px(series.marker == Marker::none && series.stroke == Stroke::solid ? 12.0F : 34.0F);
}

float key_entry_width(const Ui& ui, const Series& series) {
    return text_width(ui.look().fonts.small, series.label) + swatch_width(ui, series) + ui.px(19.0F);
}

/// Where each line of the key begins: as many labels as stand beside the title, maybe none, then as many as
/// fit.
std::vector<std::size_t> key_lines(const Ui& ui, const PlotView& view, float width) {
    if (!view.has_key || view.series.empty()) {
        return {};
    }
    std::vector<std::size_t> first{0};
    float rest = width - text_width(ui.look().fonts.small, key_title(view));
    for (std::size_t i = 0; i < view.series.size(); ++i) {
        const float needed = key_entry_width(ui, view.series[i]);
        if (rest < needed) {
            rest = width;
            first.push_back(i);
        }
        rest -= needed;
    }
    return first;
}

void draw_swatch(Ui& ui, const Rect& box, const Series& series) {
    if (series.marker == Marker::none && series.stroke == Stroke::solid) {
        fill({box.x, std::round(box.centre().y) - ui.px(1.5F), box.w, ui.px(3.0F)},
             series.colour,
             ui.px(1.5F));
        return;
    }
    const float y = std::round(box.centre().y);
    draw_stroke(
        {{box.x, y}, {box.right(), y}}, series.stroke, series.colour, ui.px(line_width), ui.px(dash_length));
    draw_marker(series.marker, {box.centre().x, y}, series.colour, ui.px(marker_size));
}

/// Title at the left, the series and their colours at the right, of the lines above the plot.
void draw_plot_key(Ui& ui, Rect line, const PlotView& view, const std::vector<std::size_t>& first) {
    const ImFont* font = ui.look().fonts.small;
    draw_text(ui, font, line, ui.colours().muted, key_title(view));
    for (std::size_t row = 0; row < first.size(); ++row) {
        float right = line.right();
        for (std::size_t i = row + 1 < first.size() ? first[row + 1] : view.series.size();
             i-- > first[row];) {
            const Series& series = view.series[i];
            const float width = text_width(font, series.label);
            draw_text(ui, font, {right - width, line.y, width, line.h}, ui.colours().text, series.label);
            const float swatch = swatch_width(ui, series);
            draw_swatch(ui, {right - width - ui.px(5.0F) - swatch, line.y, swatch, line.h}, series);
            right -= key_entry_width(ui, series);
        }
        line.y += line.h;
    }
}

TextTicks x_ticks(const Ui& ui, const Mapping& mapping, const PlotView& view) {
    TextTicks texts;
    for (const AxisTick& tick : view.x_ticks) {
        texts.emplace_back(tick.at, tick.text);
    }
    if (!texts.empty()) {
        return texts;
    }
    const Ticks found =
        ticks(mapping.x_low, mapping.x_high, std::max(2, static_cast<int>(mapping.box.w / ui.px(70.0F))));
    for (const double value : found.values) {
        texts.emplace_back(value, tick_text(value, found));
    }
    return texts;
}

/// `bottom`: where the label of x is, below everything.
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
    const bool titled = view.x_ticks.empty(); // else the key tells it, and the texts have all the room
    const std::string title = titled ? axis_title(view.x_label, view.x_unit) : std::string();
    const float title_x = box.right() - text_width(font, title);
    for (const auto& [value, text] : x_ticks(ui, mapping, view)) {
        const float half = 0.5F * text_width(font, text);
        const float x = mapping.pixel_x(value);
        fill({std::round(x), bottom, 1.0F, ui.px(4.0F)}, colours.line);
        if (!titled || x + half < title_x - ui.px(8.0F)) {
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
    for (const Series& series : view.series) {
        const Colour colour = series.colour;
        for (const auto& run : runs(mapping, series.x, series.y)) {
            if (series.is_filled) {
                fill_below(run, mapping.box.bottom(), faded(colour, 0.25));
            }
            draw_stroke(run, series.stroke, colour, ui.px(line_width), ui.px(dash_length));
        }
        for (std::size_t n = 0; series.marker != Marker::none && n < series.x.size(); ++n) {
            if (mapping.has_place(series.x[n], series.y[n])) {
                const ImVec2 at{mapping.pixel_x(series.x[n]), mapping.pixel_y(series.y[n])};
                draw_marker(series.marker, at, colour, ui.px(marker_size));
            }
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

void draw_captions(Ui& ui, const Mapping& mapping, const PlotView& view) {
    const ImFont* font = ui.look().fonts.small;
    for (const Series& series : view.series) {
        const auto run = runs(mapping, series.x, series.y);
        if (series.caption.empty() || run.empty()) {
            continue;
        }
        const auto [low, high] = std::ranges::minmax(run.front(), {}, &ImVec2::y);
        const float middle = 0.5F * (run.front().front().x + run.back().back().x);
        const float half = 0.5F * text_width(font, series.caption);
        const float y = std::max(mapping.box.y, low.y - font->FontSize - ui.px(1.0F));
        draw_text(ui,
                  font,
                  {middle - half, y, 2.0F * half + 1.0F, font->FontSize},
                  ui.colours().text,
                  series.caption,
                  Align::centre);
    }
}

/// A cross for each zero of a logarithmic plot, in `strip` below its curves.
void draw_zeros(Ui& ui, const Mapping& mapping, const Rect& strip, float left, const PlotView& view) {
    const ImFont* font = ui.look().fonts.small;
    const float right = strip.x - ui.px(6.0F);
    draw_text(ui, font, {left, strip.y, right - left, strip.h}, ui.colours().muted, "0", Align::right);
    const float middle = strip.centre().y;
    const float arm = ui.px(3.0F);
    ImDrawList& list = *ImGui::GetWindowDrawList();
    for (const Series& series : view.series) {
        const Colour colour = series.colour;
        float last = -std::numeric_limits<float>::infinity();
        for (std::size_t n = 0; n < series.x.size(); ++n) {
            const float x = mapping.pixel_x(series.x[n]);
            if (is_zero_on_log(view, series.x[n], series.y[n]) && x - last >= 1.0F) { // one per column
                list.AddLine({x - arm, middle - arm}, {x + arm, middle + arm}, colour, ui.px(line_width));
                list.AddLine({x - arm, middle + arm}, {x + arm, middle - arm}, colour, ui.px(line_width));
                last = x;
            }
        }
    }
}

/// The values nearest in x, as a tip beside the mouse.
void show_plot_readout(Ui& ui, const std::string& path, const Mapping& mapping, const PlotView& view) {
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

std::optional<double> line_plot(Ui& ui, std::string_view id, const PlotView& asked) {
    const std::string own = ui.path(id);
    PlotView view = asked;
    const std::vector<Series> looks = with_looks(ui.colours(), asked.series);
    view.series = looks;
    const float height = view.height > 0.0F ? view.height : std::max(ui.rest().h, ui.px(least_plot_height));
    const Slot slot(ui, 0.0F, height);
    const Rect& all = slot.rect();
    auto mapping = plot_mapping(view);
    if (!mapping) {
        fill(all, ui.colours().field, ui.px(2.0F));
        record_at(ui, own, all);
        draw_text(ui, ui.look().fonts.text, all, ui.colours().muted, view.when_empty, Align::centre);
        return std::nullopt;
    }
    const float line = ui.look().fonts.small->FontSize;
    const std::vector<std::size_t> key = key_lines(ui, view, all.w);
    draw_plot_key(ui, {all.x, all.y, all.w, line}, view, key);
    const float top = line * static_cast<float>(std::max<std::size_t>(key.size(), 1)) + ui.px(6.0F);
    const float inside = all.h - top - line - ui.px(6.0F);
    const float strip = has_zeros(view) ? ui.px(zeros_height) : 0.0F;
    const TextTicks rows =
        y_ticks(*mapping, std::max(2, static_cast<int>((inside - strip) / (2.2F * line))), view.y_is_fitted);
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
    draw_captions(ui, *mapping, view);
    if (now.hovered) {
        show_plot_readout(ui, own, *mapping, view);
    }
    return now.clicked ? std::optional(mapping->value_x(ImGui::GetIO().MousePos.x)) : std::nullopt;
}

} // namespace millwright::widgets
