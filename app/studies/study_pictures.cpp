#include "app/studies/study_pictures.h"

#include "core/base/counted.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "ui/render/picture.h"
#include "ui/viewport/chart_picture.h"

#include <fmt/format.h>

#include <array>
#include <span>
#include <string>
#include <utility>

namespace millwright::app {

namespace {

using studies::StudyRow;

struct Figure {
    const char* title;
    const char* axis;
    const char* unit;
    int decimals;
    double (*of)(const grid::ErrorSummary&);
};

constexpr std::array figures{
    Figure{"largest error", "error", "mm", 3, [](const grid::ErrorSummary& error) { return error.max; }},
    Figure{"mean error", "error", "mm", 4, [](const grid::ErrorSummary& error) { return error.mean; }},
    Figure{"largest angle between tool axis and surface normal",
           "angle",
           "deg",
           1,
           [](const grid::ErrorSummary& error) { return to_degrees(error.axis_max); }}};

viewport::Chart chart_of(std::span<const StudyRow> rows, const Figure& figure) {
    const studies::StudyCase& of = rows.front().of;
    viewport::Chart chart;
    chart.title =
        fmt::format("{} on {}, {}: {}", of.surface, of.machine, counted(of.tracks, "track"), figure.title);
    chart.y_label = figure.axis;
    chart.y_unit = figure.unit;
    return chart;
}

/// A curve a method over the numbers of points.
viewport::Chart curves_of(std::span<const StudyRow> rows, const Figure& figure) {
    viewport::Chart chart = chart_of(rows, figure);
    chart.x_label = "points per track";
    chart.y_is_log = true;
    chart.shows_values = true;
    for (const studies::StudyMethod method : studies::every_study_method) {
        viewport::ChartLine line{std::string(studies::label(method)), {}, {}};
        for (const StudyRow& row : rows) {
            if (row.method == method && row.figures) {
                line.x.push_back(row.of.points);
                line.y.push_back(figure.of(row.figures->error));
            }
        }
        chart.lines.push_back(std::move(line));
    }
    for (const StudyRow& row : rows) {
        if (row.method == studies::StudyMethod::uniform) {
            chart.x_ticks.push_back({static_cast<double>(row.of.points), fmt::format("{}", row.of.points)});
        }
    }
    return chart;
}

/// A bar a method, for one number of points.
viewport::Chart bars_of(std::span<const StudyRow> rows, const Figure& figure) {
    constexpr double half_width = 0.4;
    viewport::Chart chart = chart_of(rows, figure);
    chart.title += fmt::format(", {} per track", counted(rows.front().of.points, "point"));
    chart.has_key = false;
    for (std::size_t n = 0; n < rows.size(); ++n) {
        const double x = static_cast<double>(n) + 1.0;
        const std::string method(studies::label(rows[n].method));
        viewport::ChartLine bar{method, {}, {}, true};
        if (rows[n].figures) {
            const double y = figure.of(rows[n].figures->error);
            bar.x = {x - half_width, x + half_width};
            bar.y = {y, y};
            bar.caption = fixed(y, figure.decimals) + (rows[n].no_gain ? ", no gain" : "");
        }
        chart.lines.push_back(std::move(bar));
        chart.x_ticks.push_back({x, method});
    }
    return chart;
}

} // namespace

std::string study_picture_name(const studies::StudyCase& of) {
    return fmt::format("{}-{}.png", of.surface, of.machine);
}

std::vector<OutputFile> study_pictures(const std::vector<StudyRow>& rows) {
    constexpr render::PixelSize size{1300, 1200};
    std::vector<OutputFile> files;
    for (std::size_t from = 0; from < rows.size();) {
        std::size_t to = from;
        while (to < rows.size() && rows[to].of.surface == rows[from].of.surface &&
               rows[to].of.machine == rows[from].of.machine) {
            ++to;
        }
        const auto of = std::span(rows).subspan(from, to - from);
        std::vector<viewport::Chart> charts;
        for (const Figure& figure : figures) {
            charts.push_back(of.size() > studies::every_study_method.size() ? curves_of(of, figure)
                                                                            : bars_of(of, figure));
        }
        files.push_back({study_picture_name(of.front().of),
                         to_png(viewport::chart_picture(charts, size, render::Theme::light))});
        from = to;
    }
    return files;
}

} // namespace millwright::app
