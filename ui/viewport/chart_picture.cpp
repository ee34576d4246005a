#include "ui/viewport/chart_picture.h"

#include "core/base/error.h"
#include "ui/viewport/internal/desk.h"
#include "ui/widgets/plot.h"

#include <array>
#include <cstddef>
#include <iterator>
#include <string>

namespace millwright::viewport {

namespace {

constexpr std::size_t colours = std::size(widgets::Palette{}.series);

/// Where the colours come again the lines are dashed, then dotted.
widgets::Stroke stroke_of(std::size_t line) {
    constexpr std::array strokes{widgets::Stroke::solid, widgets::Stroke::dashed, widgets::Stroke::dotted};
    return strokes[line / colours % strokes.size()];
}

/// Five kinds, so that colour and sign come together again after thirty lines only.
widgets::Marker marker_of(std::size_t line) {
    constexpr std::array markers{widgets::Marker::disc,
                                 widgets::Marker::square,
                                 widgets::Marker::triangle,
                                 widgets::Marker::ring,
                                 widgets::Marker::cross};
    return markers[line % markers.size()];
}

void draw_chart(widgets::Ui& ui, const Chart& chart, float height) {
    ui.heading(chart.title);
    std::vector<widgets::Series> series;
    for (std::size_t n = 0; n < chart.lines.size(); ++n) {
        const ChartLine& line = chart.lines[n];
        series.push_back({.label = line.label,
                          .x = line.x,
                          .y = line.y,
                          .is_filled = line.is_filled,
                          .stroke = stroke_of(n),
                          .marker = chart.shows_values ? marker_of(n) : widgets::Marker::none,
                          .caption = line.caption});
    }
    std::vector<widgets::AxisTick> ticks;
    for (const ChartTick& tick : chart.x_ticks) {
        ticks.push_back({tick.at, tick.text});
    }
    widgets::PlotView view;
    view.x_label = chart.x_label;
    view.y_label = chart.y_label;
    view.y_unit = chart.y_unit;
    view.series = series;
    view.y_is_log = chart.y_is_log;
    view.y_from_zero = !chart.y_is_log;
    view.y_is_fitted = chart.shows_values;
    view.x_ticks = ticks;
    view.has_key = chart.has_key;
    view.height = height;
    (void)widgets::line_plot(ui, "lines", view);
}

} // namespace

render::Picture
chart_picture(const std::vector<Chart>& charts, const render::PixelSize& size, render::Theme theme) {
    expects(!charts.empty(), "a picture has a chart");
    constexpr float heading = 44.0F; // px
    constexpr float margin = 20.0F;
    const float height =
        (static_cast<float>(size.height) - 2.0F * margin) / static_cast<float>(charts.size()) - heading;
    Desk desk(size, 1.0, theme);
    return desk.picture(
        [&](widgets::Ui& ui) {
            for (std::size_t n = 0; n < charts.size(); ++n) {
                const auto scope = ui.scope("chart" + std::to_string(n));
                draw_chart(ui, charts[n], height);
            }
        },
        margin);
}

} // namespace millwright::viewport
