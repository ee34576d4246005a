// V-carving on the command line.
#include "tests/app/program.h"
#include "tests/support/bmp_shape.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <filesystem>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

using nlohmann::json;
using testing::HasSubstr;

/// Of 20 mm.
constexpr const char* square = "IN;SP1;PU0,0;PD800,0,800,800,0,800,0,0;PU;";

class CarveCommand : public testing::Test {
protected:
    Ended carve(const std::vector<std::string>& more, const std::string& command = "plot") {
        std::vector<std::string> words{command, "carve", drawing.string(), "--out", program.string()};
        words.insert(words.end(), more.begin(), more.end());
        return run(words);
    }

    ScratchFolder folder;
    std::filesystem::path drawing = folder / "logo.plt";
    std::filesystem::path program = folder / "logo.ngc";
};

TEST_F(CarveCommand, ASquareBecomesAPyramidWithItsReport) {
    write_content(drawing, square);
    const Ended ended = carve({"--tool", "v:90:40", "--json"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const json answer = json::parse(ended.out);
    EXPECT_EQ(answer.at("parts"), 1);
    EXPECT_NEAR(answer.at("area_mm2").get<double>(), 400.0, 1e-6);
    EXPECT_NEAR(answer.at("depth_mm").get<double>(), 10.0, 1e-4);
    EXPECT_EQ(answer.at("lifts"), 2);
    EXPECT_LT(answer.at("deviation_mm").get<double>(), 1e-4);
    EXPECT_EQ(answer.at("floor_mm2"), 0.0);
    EXPECT_GT(answer.at("time_s").get<double>(), 5.0);
    EXPECT_TRUE(answer.at("diagnostics").empty());
    const std::string text = content_of(program);
    EXPECT_THAT(text, HasSubstr("Z-10.0000"));
    EXPECT_THAT(text, HasSubstr("(carved: logo.plt)"));
    EXPECT_EQ(run({"gcode", "check", program.string()}).exit_code, 0);
    const Ended told = carve({"--tool", "v:90:40"});
    EXPECT_THAT(told.out, HasSubstr("1 part of 400 mm2 carved up to 10.000 mm deep, at most 0.0000 mm"));
    EXPECT_THAT(told.out, HasSubstr(" on forming table"));
}

TEST_F(CarveCommand, AFloorIsClearedOrLeft) {
    write_content(drawing, square);
    const Ended cleared =
        carve({"--tool", "v:90:40", "--largest-depth", "2", "--step-over", "0.5", "--json"});
    ASSERT_EQ(cleared.exit_code, 0) << cleared.err;
    const json floor = json::parse(cleared.out);
    EXPECT_NEAR(floor.at("floor_mm2").get<double>(), 256.0, 1e-3);
    EXPECT_EQ(floor.at("floor_left_mm2"), 0.0);
    EXPECT_NEAR(floor.at("ridge_mm").get<double>(), 0.25, 1e-6);
    EXPECT_THAT(cleared.err, HasSubstr("the bit clears 256 mm2 of floor"));
    const Ended left = carve({"--tool", "v:90:40", "--largest-depth", "2", "--leave-floor", "--json"});
    EXPECT_NEAR(json::parse(left.out).at("floor_left_mm2").get<double>(), 256.0, 1e-3);
    EXPECT_LT(json::parse(left.out).at("cut_mm"), floor.at("cut_mm"));
    const Ended passes = carve({"--tool", "v:90:40", "--depth-per-pass", "4", "--json"});
    ASSERT_EQ(passes.exit_code, 0) << passes.err;
    EXPECT_THAT(content_of(program), HasSubstr("Z-3.3333")); // three of 10 / 3
}

TEST_F(CarveCommand, APictureIsCarvedWhereItIsDark) {
    drawing = folder / "logo.bmp";
    write_bmp(drawing, 64, 64, 10'000, 10'000);                            // pixels of 0.1 mm
    const Ended ended = carve({"--tool", "v:60:20", "--json"}, "picture"); // a triangle of 6.4 x 6.4 mm
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const json answer = json::parse(ended.out);
    const double clearance = 6.4 * (1.0 - std::sqrt(0.5));
    EXPECT_NEAR(answer.at("depth_mm").get<double>(), clearance * std::sqrt(3.0), 0.3); // to a pixel
    EXPECT_LT(answer.at("deviation_mm").get<double>(), 0.01);
}

// Its 72 chords had a branch each up to the corner between them, and a lift.
TEST_F(CarveCommand, ACircleOfAPlotIsOneCone) {
    write_content(drawing, "IN;SP1;PU1000,1000;CI400;PU;");
    const Ended ended = carve({"--tool", "v:90:40", "--json"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const json answer = json::parse(ended.out);
    EXPECT_EQ(answer.at("lifts"), 1);
    EXPECT_NEAR(answer.at("depth_mm").get<double>(), 10.0, 0.01);
}

TEST_F(CarveCommand, AGCodeProgramIsCarvedByItsClosedCuts) {
    drawing = folder / "outline.ngc";
    write_content(drawing,
                  "G21 G90\nG0 Z5\nG0 X10 Y10\nG1 Z-1 F300\nG1 X30\nG1 Y30\nG1 X10\nG1 Y10\nG0 Z5\nM2\n");
    const Ended ended = carve({"--tool", "v:90:40", "--json"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_NEAR(json::parse(ended.out).at("depth_mm").get<double>(), 10.0, 1e-3);
}

// It went across 5 mm above the work, whatever stands there.
TEST_F(CarveCommand, AGCodeProgramIsCarvedFromTheHeightAtWhichItTravels) {
    drawing = folder / "outline.ngc";
    write_content(drawing,
                  "G21 G90\nG0 Z20\nG0 X10 Y10\nG1 Z-1 F300\nG1 X30\nG1 Y30\nG1 X10\nG1 Y10\nG0 Z20\nM2\n");
    const Ended ended = carve({"--tool", "v:90:40"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.err, HasSubstr("the tool travels at 20.000 mm, as high as in the program"));
    EXPECT_THAT(content_of(program), HasSubstr("G0 Z20.0000"));
    const Ended lower = carve({"--tool", "v:90:40", "--safe-height", "8"});
    ASSERT_EQ(lower.exit_code, 0) << lower.err;
    EXPECT_THAT(content_of(program), HasSubstr("G0 Z8.0000"));
    EXPECT_THAT(content_of(program), testing::Not(HasSubstr("Z20.0000")));
}

TEST_F(CarveCommand, SaysWhatIsWrongWithItsPlace) {
    write_content(drawing, "IN;SP1;PU0,0;PD800,0,800,800,0,800;PU;");
    const Ended open = carve({});
    EXPECT_EQ(open.exit_code, 1);
    EXPECT_THAT(open.err, HasSubstr("logo.plt"));
    EXPECT_THAT(open.err,
                HasSubstr("no outline is closed, so there is nothing to carve: 1 open stroke is skipped, the "
                          "first from (0.000, 0.000) to (0.000, 20.000) mm, with its ends 20.000 mm apart"));
    EXPECT_EQ(carve({"--close-gaps", "21"}).exit_code, 0);
    write_content(drawing, "IN;SP1;PU0,0;PD800,800,800,0,0,800,0,0;PU;");
    const Ended bow = carve({});
    EXPECT_EQ(bow.exit_code, 0) << bow.err;
    EXPECT_THAT(bow.err, HasSubstr("outlines cross or overlap 1 time, at (10.000, 10.000) mm"));
    write_content(drawing, square);
    for (const char* tool : {"v:0", "v:180", "v:60:6:6", "v:nan"}) {
        const Ended refused = carve({"--tool", tool});
        EXPECT_NE(refused.exit_code, 0) << tool;
        EXPECT_THAT(refused.err, HasSubstr(tool));
    }
    EXPECT_THAT(carve({"--tool", "flat:3"}).err, HasSubstr("flat:3 cannot carve"));
    EXPECT_THAT(carve({"--accuracy", "1e-6"}).err, HasSubstr("the tolerance must be 0.0001 mm or more"));
    EXPECT_NE(carve({"--largest-depth", "0"}).exit_code, 0);
}

} // namespace
} // namespace millwright::test
