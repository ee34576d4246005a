#include "core/cordic_study/chart.h"

#include "core/base/error.h"
#include "core/base/numbers.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <iterator>
#include <limits>
#include <string_view>

namespace millwright::cordic {
namespace {

constexpr double chart_width = 760.0;
constexpr double chart_height = 460.0;
constexpr double chart_left = 90.0;
constexpr double right_margin = 30.0;
constexpr double bar_margin = 110.0; // of a heat map, for its colour bar
constexpr double chart_top = 66.0;   // title and legend
constexpr double chart_bottom = 60.0;
constexpr double faintest = 1e-18; // what a logarithmic scale shows of a smaller value

constexpr std::array<std::string_view, 6> colours = {
    "#0b6bb8", "#d1541e", "#2b8a3e", "#8a3ea8", "#b8860b", "#555555"};

std::string escaped(std::string_view text) {
    std::string safe;
    for (const char c : text) {
        switch (c) {
        case '<':
            safe += "&lt;";
            break;
        case '&':
            safe += "&amp;";
            break;
        default:
            safe += c;
        }
    }
    return safe;
}

struct Range {
    double from = std::numeric_limits<double>::max();
    double to = std::numeric_limits<double>::lowest();

    void include(double value) {
        expects(std::isfinite(value), "a chart shows finite numbers");
        from = std::min(from, value);
        to = std::max(to, value);
    }
    [[nodiscard]] double size() const { return to - from; }
};

/// Never empty, with room at both ends.
Range widened(const Range& range) {
    if (range.from > range.to) {
        return {0.0, 1.0};
    }
    const double margin =
        range.size() > 0.0 ? 0.04 * range.size() : std::max(1e-12, 0.1 * std::abs(range.from));
    return {range.from - margin, range.to + margin};
}

/// 1, 2 or 5 times a power of ten, about a sixth of `size`.
double tick_step(double size) {
    const double raw = size / 6.0;
    const double power = std::pow(10.0, std::floor(std::log10(raw)));
    for (const double factor : {1.0, 2.0, 5.0}) {
        if (factor * power >= raw) {
            return factor * power;
        }
    }
    return 10.0 * power;
}

/// Round numbers of an axis, and how they are written: in short numbers, beside a base and a power of ten
/// that the axis's title names.
class Ticks {
public:
    Ticks(const Range& range, bool powers) : powers_(powers) {
        const double step = tick_step(range.size());
        for (double n = std::ceil(range.from / step); n * step <= range.to; n += 1.0) {
            values_.push_back(n * step + 0.0);
        }
        if (powers || values_.empty()) {
            return;
        }
        constexpr double most_digits = 1e4; // of a label
        if (largest() > most_digits * step) {
            base_ = values_[values_.size() / 2];
        }
        const double power = std::floor(std::log10(std::max(largest(), step)));
        constexpr double shortest = -3.0; // 0.001 to 99999 are written as they are
        constexpr double longest = 4.0;
        exponent_ = power < shortest || power > longest ? power : 0.0;
    }

    [[nodiscard]] const std::vector<double>& values() const { return values_; }
    [[nodiscard]] std::string label(double value) const {
        return powers_ ? fmt::format("1e{:.3g}", value)
                       : fmt::format("{:.4g}", (value - base_) / std::pow(10.0, exponent_) + 0.0);
    }
    [[nodiscard]] std::string title(std::string_view of_axis) const {
        std::string all(of_axis);
        all += exactly_equal(base_, 0.0) ? "" : fmt::format(", from {:.9g}", base_);
        return all + (exactly_equal(exponent_, 0.0) ? "" : fmt::format(", 1e{:.0f}", exponent_));
    }

private:
    [[nodiscard]] double largest() const {
        return std::max(std::abs(values_.front() - base_), std::abs(values_.back() - base_));
    }

    std::vector<double> values_;
    bool powers_;
    double base_ = 0.0;
    double exponent_ = 0.0;
};

/// The picture under construction: axes in data coordinates.
class Canvas {
public:
    Canvas(const Range& x, const Range& y, bool powers_along_y = false, double right = right_margin)
        : x_(x), y_(y), right_(right), x_ticks_(x, false), y_ticks_(y, powers_along_y) {
        out_ = fmt::format("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0}\" height=\"{1}\" "
                           "viewBox=\"0 0 {0} {1}\" font-family=\"sans-serif\" font-size=\"13\">\n"
                           "<rect width=\"{0}\" height=\"{1}\" fill=\"white\"/>\n",
                           chart_width,
                           chart_height);
    }

    [[nodiscard]] double across(double x) const {
        return chart_left + (x - x_.from) / x_.size() * (chart_width - chart_left - right_);
    }
    [[nodiscard]] double down(double y) const {
        return chart_height - chart_bottom -
               (y - y_.from) / y_.size() * (chart_height - chart_top - chart_bottom);
    }

    template <class... Values> void add(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(out_), format, std::forward<Values>(values)...);
    }
    void text(double x, double y, std::string_view anchor, std::string_view text) {
        add("<text x=\"{:.1f}\" y=\"{:.1f}\" text-anchor=\"{}\">{}</text>\n", x, y, anchor, escaped(text));
    }
    void titles(std::string_view title, std::string_view x_label, std::string_view y_label) {
        add("<text x=\"{}\" y=\"26\" text-anchor=\"middle\" font-size=\"16\">{}</text>\n",
            chart_width / 2,
            escaped(title));
        text(chart_width / 2, chart_height - 14, "middle", x_ticks_.title(x_label));
        add("<text x=\"20\" y=\"{0}\" text-anchor=\"middle\" transform=\"rotate(-90 20 {0})\">{1}</text>\n",
            (chart_height - chart_bottom + chart_top) / 2,
            escaped(y_ticks_.title(y_label)));
    }
    void axes() {
        add("<g stroke=\"#dddddd\">\n");
        for (const double x : x_ticks_.values()) {
            add("<line x1=\"{0:.1f}\" x2=\"{0:.1f}\" y1=\"{1}\" y2=\"{2}\"/>\n",
                across(x),
                chart_top,
                chart_height - chart_bottom);
        }
        for (const double y : y_ticks_.values()) {
            add("<line x1=\"{0}\" x2=\"{1}\" y1=\"{2:.1f}\" y2=\"{2:.1f}\"/>\n",
                chart_left,
                chart_width - right_,
                down(y));
        }
        add("</g>\n");
        for (const double x : x_ticks_.values()) {
            text(across(x), chart_height - chart_bottom + 18, "middle", x_ticks_.label(x));
        }
        for (const double y : y_ticks_.values()) {
            text(chart_left - 8, down(y) + 4, "end", y_ticks_.label(y));
        }
        add("<rect x=\"{}\" y=\"{}\" width=\"{}\" height=\"{}\" fill=\"none\" stroke=\"#333333\"/>\n",
            chart_left,
            chart_top,
            chart_width - chart_left - right_,
            chart_height - chart_top - chart_bottom);
    }
    [[nodiscard]] std::string done() { return out_ + "</svg>\n"; }

private:
    Range x_, y_;
    double right_;
    Ticks x_ticks_, y_ticks_;
    std::string out_;
};

void keep_scale(Range& x, Range& y) {
    const double across = x.size() / (chart_width - chart_left - right_margin);
    const double down = y.size() / (chart_height - chart_top - chart_bottom);
    Range& narrow = across < down ? x : y;
    const double wanted = across < down ? down * (chart_width - chart_left - right_margin)
                                        : across * (chart_height - chart_top - chart_bottom);
    const double more = 0.5 * (wanted - narrow.size());
    narrow.from -= more;
    narrow.to += more;
}

/// How many later lines lie upon one, on a linear scale.
std::size_t hidden_behind(const Canvas& canvas, const Chart& chart, std::size_t series) {
    constexpr double apart = 1.0; // pixels
    const Series& mine = chart.series[series];
    const auto covers = [&](const Series& other) {
        return mine.mark == Mark::line && other.mark == Mark::line && !chart.logarithmic &&
               other.x == mine.x && std::ranges::equal(mine.y, other.y, [&](double a, double b) {
                   return std::abs(canvas.down(a) - canvas.down(b)) < apart;
               });
    };
    const auto later = chart.series.begin() + static_cast<std::ptrdiff_t>(series) + 1;
    return static_cast<std::size_t>(std::count_if(later, chart.series.end(), covers));
}

void draw(Canvas& canvas, const Chart& chart, const Series& series, double line, std::string_view colour) {
    std::string points;
    for (std::size_t n = 0; n < series.x.size(); ++n) {
        if (chart.logarithmic && !(series.y[n] > 0.0)) {
            continue;
        }
        const double x = canvas.across(series.x[n]);
        const double y = canvas.down(chart.logarithmic ? std::log10(series.y[n]) : series.y[n]);
        if (series.mark == Mark::dots) {
            canvas.add("<circle cx=\"{:.1f}\" cy=\"{:.1f}\" r=\"2\" fill=\"{}\"/>\n", x, y, colour);
        } else {
            points += fmt::format("{:.1f},{:.1f} ", x, y);
        }
    }
    if (!points.empty()) {
        canvas.add("<polyline fill=\"none\" stroke=\"{}\" stroke-width=\"{}\" points=\"{}\"/>\n",
                   colour,
                   line,
                   points);
    }
}

std::string_view colour_of(std::size_t series) {
    return colours[series % colours.size()];
}

/// Side by side between the title and the drawing.
void draw_legend(Canvas& canvas, const std::vector<Series>& series) {
    constexpr double widest = 180.0;
    constexpr double mark = 14.0;
    const double share =
        std::min(widest, (chart_width - chart_left - right_margin) / static_cast<double>(series.size()));
    double x = chart_left;
    for (std::size_t n = 0; n < series.size(); ++n) {
        if (!series[n].label.empty()) {
            canvas.add("<rect x=\"{:.1f}\" y=\"{}\" width=\"{}\" height=\"3\" fill=\"{}\"/>\n",
                       x,
                       chart_top - 17,
                       mark,
                       colour_of(n));
            canvas.text(x + mark + 5, chart_top - 11, "start", series[n].label);
            x += share;
        }
    }
}

/// From blue (small) over yellow to red.
std::string colour_at(double fraction) {
    const double f = std::clamp(fraction, 0.0, 1.0);
    const auto channel = [](double v) {
        return static_cast<int>(std::lround(255.0 * std::clamp(v, 0.0, 1.0)));
    };
    return fmt::format("#{:02x}{:02x}{:02x}",
                       channel(2.0 * f),
                       channel(f < 0.5 ? 0.3 + 1.2 * f : 1.8 * (1.0 - f)),
                       channel(1.0 - 1.6 * f));
}

/// Even steps, half a one beyond the first and the last.
Range around_cells(const std::vector<double>& middles) {
    const double half = 0.5 * (middles.back() - middles.front()) / static_cast<double>(middles.size() - 1);
    return {middles.front() - half, middles.back() + half};
}

/// What the colours of the powers of ten from `value.from` to `value.to` mean.
void draw_bar(Canvas& canvas, const Range& value, std::string_view label) {
    constexpr int parts = 64;
    constexpr double x = chart_width - bar_margin + 16.0;
    constexpr double wide = 16.0;
    constexpr double high = chart_height - chart_top - chart_bottom;
    for (int n = 0; n < parts; ++n) {
        canvas.add("<rect x=\"{:.1f}\" y=\"{:.2f}\" width=\"{}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
                   x,
                   chart_top + high * n / parts,
                   wide,
                   high / parts,
                   colour_at(1.0 - (n + 0.5) / parts));
    }
    canvas.text(x, chart_top - 11, "start", label);
    if (!(value.size() > 0.0)) {
        return canvas.text(
            x + wide + 6, chart_top + 0.5 * high + 4, "start", fmt::format("1e{:.3g}", value.from));
    }
    const Ticks powers(value, true);
    for (const double power : powers.values()) {
        const double y = chart_top + high * (value.to - power) / value.size();
        canvas.text(x + wide + 6, y + 4, "start", powers.label(power));
    }
}

} // namespace

std::string to_svg(const Chart& chart) {
    Range x;
    Range y;
    for (const Series& series : chart.series) {
        expects(series.x.size() == series.y.size(), "a series has as many x as y");
        for (std::size_t n = 0; n < series.x.size(); ++n) {
            x.include(series.x[n]);
            if (!chart.logarithmic || series.y[n] > 0.0) {
                y.include(chart.logarithmic ? std::log10(series.y[n]) : series.y[n]);
            }
        }
    }
    x = widened(x);
    y = widened(y);
    if (chart.same_scale) {
        keep_scale(x, y);
    }
    Canvas canvas(x, y, chart.logarithmic);
    canvas.titles(chart.title, chart.x_label, chart.y_label);
    canvas.axes();
    for (std::size_t n = 0; n < chart.series.size(); ++n) {
        constexpr double line = 1.5;
        const double border =
            3.0 * static_cast<double>(hidden_behind(canvas, chart, n)); // beside what covers it
        draw(canvas, chart, chart.series[n], line + border, colour_of(n));
    }
    draw_legend(canvas, chart.series);
    return canvas.done();
}

std::string to_svg(const HeatMap& map) {
    expects(map.x.size() > 1 && map.y.size() > 1 && map.values.size() == map.x.size() * map.y.size(),
            "a heat map has a value for each of its points");
    const Range x = around_cells(map.x);
    const Range y = around_cells(map.y);
    Range value;
    const auto power = [](double v) { return std::log10(std::max(v, faintest)); };
    for (const double v : map.values) {
        value.include(power(v));
    }
    Canvas canvas(x, y, false, bar_margin);
    const double cell_width = (chart_width - chart_left - bar_margin) / static_cast<double>(map.x.size());
    const double cell_height = (chart_height - chart_top - chart_bottom) / static_cast<double>(map.y.size());
    for (std::size_t row = 0; row < map.y.size(); ++row) {
        for (std::size_t column = 0; column < map.x.size(); ++column) {
            const double v = power(map.values[row * map.x.size() + column]);
            canvas.add("<rect x=\"{:.1f}\" y=\"{:.1f}\" width=\"{:.2f}\" height=\"{:.2f}\" fill=\"{}\"/>\n",
                       canvas.across(map.x[column]) - 0.5 * cell_width,
                       canvas.down(map.y[row]) - 0.5 * cell_height,
                       cell_width,
                       cell_height,
                       colour_at((v - value.from) / std::max(value.size(), 1e-9)));
        }
    }
    canvas.titles(map.title, map.x_label, map.y_label);
    canvas.axes();
    draw_bar(canvas, value, map.value_label);
    return canvas.done();
}

} // namespace millwright::cordic
