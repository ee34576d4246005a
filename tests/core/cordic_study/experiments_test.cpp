#include "core/cordic_study/experiments.h"

#include <gtest/gtest.h>

#include <cstdio>
#include <set>
#include <string>

namespace millwright::cordic {
namespace {

double largest_error_of(const Experiments& all, const std::string& experiment, const std::string& what) {
    for (const Finding& finding : all.findings) {
        if (finding.experiment == experiment && finding.what.find(what) != std::string::npos) {
            return finding.largest_error;
        }
    }
    ADD_FAILURE() << experiment << ' ' << what << " is missing";
    return -1.0;
}

TEST(Experiments, HaveTheLargestErrorsOfTheThesissModel) {
    const Experiments all = run_experiments();
    EXPECT_EQ(largest_error_of(all, "E2", "PostCORDIC"), 0.0);
    EXPECT_NEAR(largest_error_of(all, "E3", "within 97"), 5.97e-8, 0.01e-8);
    EXPECT_NEAR(largest_error_of(all, "E3", "beyond"), 1.313, 0.001);
    EXPECT_NEAR(largest_error_of(all, "E4", "length"), 3.58e-9, 0.01e-9);
    EXPECT_NEAR(largest_error_of(all, "E4", "direction"), 5.96e-8, 0.01e-8);
    EXPECT_NEAR(largest_error_of(all, "E5", "speed"), 2.97e-8, 0.015e-8);
    EXPECT_NEAR(largest_error_of(all, "E5", "acceleration"), 1.785e-8, 0.01e-8);
    EXPECT_NEAR(largest_error_of(all, "E5", "percent"), 2.98e-5, 0.005e-5); // the thesis says 2.5e-5
    EXPECT_NEAR(largest_error_of(all, "E6", "X"), 5.19e-6, 0.005e-6);
    EXPECT_NEAR(largest_error_of(all, "E6", "Y"), 3.86e-6, 0.005e-6);
    EXPECT_NEAR(largest_error_of(all, "E6", "radius"), 8.96e-7, 0.005e-7);
    EXPECT_LE(largest_error_of(all, "E7", "arcs"), 1e-6);
}

TEST(Experiments, DrawAPictureOfEachFigure) {
    const Experiments all = run_experiments();
    std::set<std::string> names;
    for (const Picture& picture : all.pictures) {
        names.insert(picture.name);
        EXPECT_TRUE(picture.svg.starts_with("<svg "));
        EXPECT_TRUE(picture.svg.ends_with("</svg>\n"));
        EXPECT_EQ(picture.svg.find("nan"), std::string::npos) << picture.name;
        EXPECT_EQ(picture.svg.find("inf"), std::string::npos) << picture.name;
    }
    EXPECT_EQ(names.size(), 11U);
}

TEST(Chart, PutsItsPointsWhereTheyBelong) {
    const std::string svg =
        to_svg(Chart{.title = "a < b & c", .series = {{.label = "", .x = {0.0, 1.0}, .y = {0.0, 1.0}}}});
    EXPECT_NE(svg.find("a &lt; b &amp; c"), std::string::npos);
    const auto at = svg.find("points=\"") + 8;
    double x0 = 0.0;
    double y0 = 0.0;
    double x1 = 0.0;
    double y1 = 0.0;
    ASSERT_EQ(std::sscanf(svg.c_str() + at, "%lf,%lf %lf,%lf", &x0, &y0, &x1, &y1), 4);
    EXPECT_LT(x0, x1);
    EXPECT_GT(y0, y1); // pictures count downwards
}

} // namespace
} // namespace millwright::cordic
