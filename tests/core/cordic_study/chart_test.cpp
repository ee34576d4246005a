#include "core/cordic_study/chart.h"

#include <gtest/gtest.h>

#include <regex>
#include <set>
#include <string>
#include <vector>

namespace millwright::cordic {
namespace {

/// The first group of each place where `pattern` is found.
std::vector<std::string> all_of(const std::string& svg, const std::string& pattern) {
    const std::regex wanted(pattern);
    std::vector<std::string> found;
    for (std::sregex_iterator at(svg.begin(), svg.end(), wanted); at != std::sregex_iterator(); ++at) {
        found.push_back((*at)[1]);
    }
    return found;
}

std::vector<std::string> labels_along_y(const std::string& svg) {
    return all_of(svg, "text-anchor=\"end\">([^<]*)<");
}

Chart chart_of(std::vector<double> y) {
    std::vector<double> x;
    for (std::size_t n = 0; n < y.size(); ++n) {
        x.push_back(static_cast<double>(n));
    }
    return {.y_label = "error", .series = {{.label = "a", .x = x, .y = std::move(y)}}};
}

TEST(Chart, TellsNumbersApartThatDifferInTheirLastDigits) {
    const std::string svg = to_svg(chart_of({-3.5821e-9, -3.5821e-9 + 4e-16}));
    const auto labels = labels_along_y(svg);
    EXPECT_GE(labels.size(), 3U);
    EXPECT_EQ(std::set<std::string>(labels.begin(), labels.end()).size(), labels.size());
    EXPECT_NE(svg.find("error, from -3.58"), std::string::npos);
    EXPECT_NE(svg.find(", 1e-16<"), std::string::npos);
}

TEST(Chart, KeepsLabelsShortEnoughForTheTitleBesideThem) {
    constexpr std::size_t longest = 7; // 8 pixels each, and 70 to the title
    for (const double size : {1e-12, 3.7e-9, 0.02, 1.0, 4000.0, 2.3e7}) {
        for (const double offset : {0.0, 1.0, 1e6}) {
            for (const std::string& label :
                 labels_along_y(to_svg(chart_of({size * offset, size * (offset + 1)})))) {
                EXPECT_LE(label.size(), longest) << label << ' ' << size << ' ' << offset;
            }
        }
    }
    EXPECT_EQ(labels_along_y(to_svg(chart_of({0.0, 1.0}))).front(), "0"); // what is short stays as it is
}

TEST(Chart, ShowsALineBehindTheOneThatCoversIt) {
    Chart chart = chart_of({0.0, 1.0, 0.5});
    chart.series.push_back(chart.series[0]);
    chart.series.push_back({.label = "b", .x = chart.series[0].x, .y = {0.0, 0.9, 0.5}});
    const auto widths = all_of(to_svg(chart), "<polyline[^>]*stroke-width=\"([0-9.]*)\"");
    ASSERT_EQ(widths.size(), 3U);
    EXPECT_GT(std::stod(widths[0]), std::stod(widths[1]) + 2.0);
    EXPECT_EQ(widths[1], widths[2]);
}

TEST(HeatMap, KeepsItsCellsInTheFrameAndExplainsItsColours) {
    HeatMap map{.value_label = "error", .x = {-1.0, 0.0, 1.0}, .y = {0.0, 1.0}};
    map.values = {1e-9, 1e-8, 1e-7, 1e-6, 1e-5, 1e-4};
    const std::string svg = to_svg(map);
    const std::regex frame("<rect x=\"([0-9.]*)\" y=\"([0-9.]*)\" width=\"([0-9.]*)\" height=\"([0-9.]*)\" "
                           "fill=\"none\"");
    std::smatch box;
    ASSERT_TRUE(std::regex_search(svg, box, frame));
    const double left = std::stod(box[1]);
    const double top = std::stod(box[2]);
    const double right = left + std::stod(box[3]);
    const double bottom = top + std::stod(box[4]);
    const std::regex cell("<rect x=\"([0-9.]*)\" y=\"([0-9.]*)\" width=\"([0-9.]*)\" height=\"([0-9.]*)\" "
                          "fill=\"#");
    int inside = 0;
    for (std::sregex_iterator at(svg.begin(), svg.end(), cell); at != std::sregex_iterator(); ++at) {
        const double x = std::stod((*at)[1]);
        if (x >= right) {
            continue; // of the bar beside it
        }
        const double y = std::stod((*at)[2]);
        constexpr double rounded = 0.11; // of a place
        EXPECT_GE(x, left - rounded);
        EXPECT_LE(x + std::stod((*at)[3]), right + rounded);
        EXPECT_GE(y, top - rounded);
        EXPECT_LE(y + std::stod((*at)[4]), bottom + rounded);
        ++inside;
    }
    EXPECT_EQ(inside, 6);
    for (const char* power : {">1e-9<", ">1e-6<", ">1e-4<", ">error<"}) {
        EXPECT_NE(svg.find(power), std::string::npos) << power;
    }
}

} // namespace
} // namespace millwright::cordic
