#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

namespace millwright::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

TEST(Arm, SimulatesTheFileOfTheThesis) {
    const ScratchFolder scratch;
    const std::string file = (scratch / "three-lines.mot").string(), out = (scratch / "result.txt").string();
    write_content(file, "G1 X300 Y0 Z0 ;\nG1 X0 Y0 Z-100 ;\nG1 X-300 Y0 Z100 ;\n");
    const Ended ended = run({"arm", "simulate", file, "--step", "10", "--out", out});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("3 blocks, 75 points"));
    EXPECT_THAT(content_of(out),
                testing::StartsWith("next position 800.00000 0.00000 650.00000 \n\n 1 := 0.00000 \n"
                                    " 2 := -90.00000 \n 3 := 90.00000 \n"));
    const Ended gcode = run({"arm", "simulate", "assets/samples/gcode/arcs-xy.ngc", "--out", out});
    EXPECT_EQ(gcode.exit_code, 1);
    EXPECT_THAT(gcode.err,
                HasSubstr("arcs-xy.ngc: this is not a motion file: none of its blocks ends with ;"));
    write_content(file, "X300 ;\nX3000 ;");
    EXPECT_THAT(run({"arm", "simulate", file, "--out", out}).err,
                HasSubstr("three-lines.mot:2: the arm cannot"));
}

/// A UR5 by its classical table, straight out at rest: motion begins where --start says.
TEST(Arm, SimulatesAnyArmFromWhereItIsToldToBegin) {
    const ScratchFolder scratch;
    const std::string arm = (scratch / "ur5.json").string(), file = (scratch / "square.mot").string(),
                      out = (scratch / "result.txt").string();
    std::string rows;
    for (const char* row : {R"("1", "alpha": 90, "a": 0, "d": 89.2)",
                            R"("2", "alpha": 0, "a": -425, "d": 0)",
                            R"("3", "alpha": 0, "a": -392, "d": 0)",
                            R"("4", "alpha": 90, "a": 0, "d": 109.3)",
                            R"("5", "alpha": -90, "a": 0, "d": 94.75)",
                            R"("6", "alpha": 0, "a": 0, "d": 82.5)"}) {
        rows += std::string(rows.empty() ? "" : ",") +
                R"({"kind": "revolute", "theta": 0, "limits": [-360, 360],)" +
                R"( "max_velocity": 180, "max_acceleration": 600, "name": )" + row + "}";
    }
    write_content(arm,
                  R"({"format": "millwright-arm", "version": 1, "name": "UR5", "source": "catalogue",)"
                  R"( "convention": "classical", "tool_tip": [0, 0, 0], "joints": [)" +
                      rows + "]}");
    // At rest its tip is at x = -(425 + 392), y = -(109.3 + 82.5), z = 89.2 - 94.75.
    const auto rest =
        nlohmann::json::parse(run({"arm", "fk", "0", "0", "0", "0", "0", "0", "--arm", arm, "--json"}).out);
    EXPECT_NEAR(rest.at("x").get<double>(), -817.0, 1e-6);
    EXPECT_NEAR(rest.at("y").get<double>(), -191.8, 1e-6);
    EXPECT_NEAR(rest.at("z").get<double>(), -5.55, 1e-6);
    write_content(file, "X40 ;\nY40 ;\nX-40 Z20 ;\nY-40 Z-20 ;\n");
    const Ended ended =
        run({"arm", "simulate", file, "--out", out, "--arm", arm, "--start", "10,-80,100,-110,-90,20"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("4 blocks, "));
    EXPECT_THAT(ended.out, HasSubstr("tool axis turned by at most 0.000 deg"));
    EXPECT_THAT(content_of(out), HasSubstr("\n 6 := 20.00000 \n"));
    EXPECT_THAT(run({"arm", "simulate", file, "--out", out, "--arm", arm, "--start", "1,2,3"}).err,
                HasSubstr("UR5 has 6 joints, but 3 positions were given"));
    EXPECT_THAT(run({"arm", "simulate", file, "--out", out, "--arm", arm, "--start", "400,0,0,0,0,0"}).err,
                HasSubstr("--start is outside the limits of joint 1"));
    // Outwards from the stretched arm: the answer names the point, and how far it is off.
    write_content(file, "X-50 ;");
    const Ended far = run({"arm", "simulate", file, "--out", out, "--arm", arm, "--start", "0,-1,2,0,-90,0"});
    EXPECT_EQ(far.exit_code, 1);
    EXPECT_THAT(far.err, HasSubstr("square.mot:1: the arm cannot reach "));
    EXPECT_THAT(far.err, HasSubstr(" mm off"));
}

TEST(Arm, StreamsAMotionFileThroughTheDualPortedRam) {
    const ScratchFolder scratch;
    const std::string file = (scratch / "line.mot").string(), watch = (scratch / "buffer.csv").string();
    write_content(file, "G1 X0 Y100 Z-50 ;\n");
    const Ended ended = run({"arm", "stream", file, "--step", "10", "--watch", watch});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("13 points, 13 interrupts of EQU1"));
    EXPECT_EQ(ended.err, "");
    const std::string rows = content_of(watch);
    EXPECT_THAT(rows, testing::StartsWith("time_s,m151,m152,m153,m154,m155,sent,equ1,x_deg,y_deg,z_deg\n"));
    EXPECT_THAT(rows, HasSubstr(",1,1,1,0,")); // running, a point waits, the first one, not yet taken
    EXPECT_THAT(rows, HasSubstr(",1,0,13,13,"));
    write_content(file, "G1 X0 Y100 Z-50 F2 ;\n");
    const Ended with_feed = run({"arm", "stream", file, "--step", "10"});
    EXPECT_EQ(with_feed.out, ended.out);
    EXPECT_THAT(with_feed.err, testing::ContainsRegex("note: F is ignored: each move takes [0-9]+ ms"));
    write_content(file, "X3000 ;");
    EXPECT_EQ(run({"arm", "stream", file}).exit_code, 1);
}

TEST(Arm, SaysHowMuchOfAProgramItReaches) {
    const ScratchFolder scratch;
    write_content((scratch / "part.ngc").string(),
                  "G21 G90 F600\nG0 X0 Y0 Z5\nG1 Z0\nG1 X200\nG1 X900\nG1 X0\nM2\n");
    const auto asked = [&](const std::string& frame) {
        return run({"arm", "reach", (scratch / "part.ngc").string(), "--frame", frame, "--json"});
    };
    const Ended near = asked("700,0,-200,0,0,90");
    ASSERT_EQ(near.exit_code, 0) << near.err;
    const auto whole = nlohmann::json::parse(near.out);
    EXPECT_TRUE(whole.at("whole").get<bool>());
    EXPECT_NEAR(whole.at("length_mm").get<double>(), 1805.0, 1e-6);
    EXPECT_NEAR(whole.at("programmed_time_s").get<double>(), 180.5, 1e-6);
    EXPECT_GE(whole.at("planned_time_s").get<double>(), 180.5);
    EXPECT_LE(whole.at("planned_time_s").get<double>(), 190.0);
    // Along x the arm ends at 1450 mm from its shoulder.
    const Ended far = asked("700,0,-200,0,0,0");
    ASSERT_EQ(far.exit_code, 1);
    const auto part = nlohmann::json::parse(far.out);
    EXPECT_TRUE(part.at("planned_time_s").is_null());
    ASSERT_EQ(part.at("findings").size(), 1U);
    const auto& finding = part.at("findings").at(0);
    EXPECT_EQ(finding.at("first_line"), 5);
    EXPECT_EQ(finding.at("last_line"), 6);
    const double reached = std::sqrt(1450.0 * 1450.0 - 200.0 * 200.0) - 700.0;
    EXPECT_NEAR(part.at("reached_mm").get<double>(), 5.0 + 2.0 * reached, 1.0);
    // Each point by number, line, place on the part and in the base's frame, and how far it is off.
    const auto& points = finding.at("points");
    EXPECT_EQ(points.size(),
              finding.at("last_point").get<std::size_t>() - finding.at("first_point").get<std::size_t>() + 1);
    EXPECT_NEAR(points.at(0).at("part_mm").at(0).get<double>(), reached, 0.5);
    EXPECT_NEAR(points.at(0).at("along_mm").get<double>(), 5.0 + reached, 0.5);
    for (const auto& point : points) {
        const auto base = point.at("base_mm").get<std::vector<double>>();
        EXPECT_NEAR(base.at(0), point.at("part_mm").at(0).get<double>() + 700.0, 1e-6);
        EXPECT_NEAR(point.at("off_mm").get<double>(), std::hypot(base.at(0), base.at(2)) - 1450.0, 1e-6);
    }
    const std::string text =
        run({"arm", "reach", (scratch / "part.ngc").string(), "--frame", "700,0,-200,0,0,0"}).out;
    EXPECT_THAT(text,
                testing::ContainsRegex("lines 5 to 6, points [0-9]+ to [0-9]+, [0-9.]+ mm, out of reach: "));
    EXPECT_THAT(text, testing::ContainsRegex("first point [0-9]+, line 5, X736[.][0-9]+ Y0.000 Z0.000, "));
    EXPECT_THAT(
        text,
        testing::ContainsRegex("worst point [0-9]+, line [56], X900.000 Y0.000 Z0.000, 905.0 mm along "
                               "the path: 162.452 mm off"));
}

TEST(Arm, RefusesProgramsThatItCannotRead) {
    const ScratchFolder scratch;
    write_content((scratch / "five.ngc").string(), "G21 G90 F600\nG1 X1 A10\nM2\n");
    EXPECT_THAT(run({"arm", "reach", "assets/samples/plot/hatched-sign.plt"}).err,
                HasSubstr("hatched-sign.plt: a plot is not a program"));
    EXPECT_THAT(run({"arm", "reach", (scratch / "nofile.plt").string()}).err,
                AllOf(HasSubstr("nofile.plt: cannot read: No such file"), Not(HasSubstr("not a program"))));
    const Ended rotary = run({"arm", "reach", (scratch / "five.ngc").string()});
    EXPECT_EQ(rotary.exit_code, 1);
    EXPECT_THAT(rotary.err, HasSubstr("five.ngc:2"));
    EXPECT_THAT(rotary.err, HasSubstr("--machine"));
    write_content((scratch / "still.ngc").string(), "M2\n");
    EXPECT_THAT(run({"arm", "reach", (scratch / "still.ngc").string()}).err, HasSubstr("contains no motion"));
    EXPECT_THAT(run({"arm", "reach", (scratch / "five.ngc").string(), "--frame", "1,2,nan,0,0,0"}).err,
                HasSubstr("is not a finite number"));
}

} // namespace
} // namespace millwright::test
