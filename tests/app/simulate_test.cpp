#include "tests/app/box_file.h"
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <array>
#include <cmath>
#include <fstream>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;
using testing::IsEmpty;
using testing::Not;
using testing::StartsWith;

constexpr const char* slot_program = "G21 G90 G17\n"
                                     "T1 M6\n"
                                     "M3 S8000\n"
                                     "G0 Z5\n"
                                     "G0 X-10 Y20\n"
                                     "G0 Z-2\n"
                                     "G1 X70 F300\n"
                                     "G0 Z5\n";

fs::path program_in(const ScratchFolder& scratch, const std::string& text) {
    const fs::path file = scratch / "part.ngc";
    std::ofstream(file) << text;
    return file;
}

/// On the plate 60 x 40 x 10 with its top at Z 0.
Ended simulate(const fs::path& program, const fs::path& out, std::vector<std::string> more) {
    std::vector<std::string> arguments{"simulate",
                                       program.string(),
                                       "--machine",
                                       "router-xyz",
                                       "--stock",
                                       "box:60,40,10",
                                       "--resolution",
                                       "0.5",
                                       "--out",
                                       out.string()};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return run(arguments);
}

TEST(SimulateCommand, LeavesVolumesMeshesAndAPicture) {
    const ScratchFolder scratch;
    const Ended ended = simulate(
        program_in(scratch, std::string(slot_program) + "M2\n"), scratch / "out", {"--tool", "flat:6"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("tool: T1: flat:6"));
    EXPECT_THAT(ended.out, HasSubstr("removed 720.0 of 24000.0 mm^3"));
    EXPECT_THAT(ended.out, HasSubstr("no rapid move meets any"));
    const auto report = nlohmann::json::parse(content_of(scratch / "out/simulation.json"));
    EXPECT_EQ(report.at("format"), "millwright-simulation");
    EXPECT_NEAR(report.at("volume_mm3").at("removed").get<double>(), 720.0, 0.1);
    EXPECT_EQ(report.at("rapid_in_stock"), 0);
    EXPECT_THAT(report.at("findings"), IsEmpty());
    EXPECT_EQ(content_of(scratch / "out/cut.stl").size(),
              84 + 50 * report.at("mesh").at("triangles").get<std::size_t>());
    EXPECT_THAT(content_of(scratch / "out/cut.ply"), StartsWith("ply\n"));
    EXPECT_THAT(content_of(scratch / "out/cut.png"), StartsWith("\x89PNG"));
}

TEST(SimulateCommand, EndsWithCodeOneForARapidThroughMaterial) {
    const ScratchFolder scratch;
    const fs::path program =
        program_in(scratch, std::string(slot_program) + "G0 X30 Y10\nG1 Z-1\nG0 X50\nM2\n");
    const Ended ended = simulate(program, scratch / "out", {"--tool", "1=flat:6"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("part.ngc:11: a rapid move goes through material at"));
    const auto report = nlohmann::json::parse(content_of(scratch / "out/simulation.json"));
    ASSERT_EQ(report.at("findings").size(), 1U);
    EXPECT_EQ(report.at("findings")[0].at("line"), 11);
    EXPECT_EQ(report.at("findings")[0].at("kind"), "rapid-in-stock");
    EXPECT_NEAR(report.at("findings")[0].at("removed_mm3").get<double>(), 120.0, 12.0);
}

TEST(SimulateCommand, NamesACollisionWithAFixtureAndItsLine) {
    const ScratchFolder scratch;
    const fs::path clamp = box_file(scratch / "clamp.stl", {40, 15, -5}, {50, 25, 3});
    const fs::path program = program_in(scratch, std::string(slot_program) + "M2\n");
    const Ended ended = simulate(
        program, scratch / "out", {"--tool", "flat:6", "--fixture", clamp.string(), "--flutes", "20"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("part.ngc:7: cutter collides with fixture clamp.stl at 40.0"));
    EXPECT_THAT(ended.out, HasSubstr("not checked: the tool has no holder"));
    const auto report = nlohmann::json::parse(content_of(scratch / "out/simulation.json"));
    const auto& contacts = report.at("collisions").at("contacts");
    ASSERT_EQ(contacts.size(), 1U);
    EXPECT_EQ(contacts[0].at("line"), 7);
    EXPECT_EQ(contacts[0].at("bodies")[1], "fixture clamp.stl");
    EXPECT_NEAR(contacts[0].at("time").get<double>() * 80.0, 47.0, 0.01);
    EXPECT_NEAR(contacts[0].at("depth_mm").get<double>(), 4.0, 0.1); // half way between top and bottom
    const Ended beside =
        simulate(program, scratch / "beside", {"--tool", "flat:6", "--fixture", clamp.string() + "@0,8.5,0"});
    EXPECT_EQ(beside.exit_code, 0) << beside.err;
    EXPECT_THAT(beside.out,
                HasSubstr("no collisions, 1 near miss, the nearest 0.500 mm: cutter and fixture"));
}

TEST(SimulateCommand, ChecksTheHolderOfAToolFile) {
    const ScratchFolder scratch;
    std::ofstream(scratch / "short.json")
        << R"({"format": "millwright-tool", "version": 1, "tool": {"cutter": "flat", "diameter_mm": 6,
               "length_mm": 1.5, "holder_diameter_mm": 20, "holder_length_mm": 40}})";
    const fs::path program = program_in(scratch, std::string(slot_program) + "M2\n");
    const Ended ended = simulate(program, scratch / "out", {"--tool", (scratch / "short.json").string()});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("part.ngc:7: holder collides with stock at"));
}

TEST(SimulateCommand, RefusesFixturesThatAreOpenOrInTheTable) {
    const ScratchFolder scratch;
    const fs::path program = program_in(scratch, std::string(slot_program) + "M2\n");
    const fs::path clamp = box_file(scratch / "clamp.stl", {40, 15, -5}, {50, 25, 3});
    const Ended sunk =
        simulate(program, scratch / "out", {"--tool", "flat:6", "--fixture", clamp.string() + "@0,0,-67"});
    EXPECT_EQ(sunk.exit_code, 1);
    EXPECT_THAT(sunk.err, HasSubstr("fixture clamp.stl lies 2.00 mm deep in the machine's body \"base\""));
    EXPECT_FALSE(fs::exists(scratch / "out"));
    std::ofstream(scratch / "open.stl")
        << "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 9 0 0\n"
           "vertex 0 9 0\nendloop\nendfacet\nendsolid a\n";
    const Ended open = simulate(
        program, scratch / "out", {"--tool", "flat:6", "--fixture", (scratch / "open.stl").string()});
    EXPECT_THAT(open.err, HasSubstr("is open: 3 edges"));
    const Ended box = simulate(program, scratch / "out", {"--tool", "flat:6", "--fixture", "box:1,2,3"});
    EXPECT_THAT(box.err, HasSubstr("is no mesh file"));
    const Ended flutes = simulate(program, scratch / "out", {"--tool", "flat:6", "--flutes", "2=9"});
    EXPECT_EQ(flutes.exit_code, 2);
    EXPECT_THAT(flutes.err, HasSubstr("no tool of that number is named"));
}

TEST(SimulateCommand, RefusesACallOfAToolThatIsNotNamed) {
    const ScratchFolder scratch;
    const fs::path program =
        program_in(scratch, std::string(slot_program) + "T2 M6\nG0 X30 Y10\nG1 Z-1\nG0 Z5\nM2\n");
    const Ended numbered = simulate(program, scratch / "out", {"--tool", "1=flat:6"});
    EXPECT_EQ(numbered.exit_code, 1);
    EXPECT_THAT(numbered.err,
                HasSubstr("part.ngc:9: the program calls tool 2, and no tool 2 is named (add "
                          "--tool 2=SPEC"));
    const Ended alone = simulate(program, scratch / "out", {"--tool", "flat:6"});
    EXPECT_EQ(alone.exit_code, 1);
    EXPECT_THAT(alone.err, HasSubstr("the program calls tool"));
    const Ended both = simulate(program, scratch / "out", {"--tool", "1=flat:6", "--tool", "2=drill:5"});
    EXPECT_EQ(both.exit_code, 0) << both.err;
    EXPECT_THAT(both.out, HasSubstr("tool: T2: 2=drill:5"));
}

TEST(SimulateCommand, SaysWhatIsWrongWithItsInput) {
    const ScratchFolder scratch;
    const fs::path program = program_in(scratch, std::string(slot_program) + "M2\n");
    const auto refused = [&](const std::vector<std::string>& arguments) {
        std::vector<std::string> all{"simulate", program.string(), "--out", scratch / "out"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        const Ended ended = run(all);
        EXPECT_NE(ended.exit_code, 0);
        EXPECT_FALSE(fs::exists(scratch / "out"));
        return ended.err;
    };
    EXPECT_THAT(refused({}), HasSubstr("add --machine NAME, --stock SPEC and --tool SPEC"));
    const auto with =
        [&](const std::string& stock, const std::string& tool, std::vector<std::string> more = {}) {
            std::vector<std::string> all{"--machine", "router-xyz", "--stock", stock, "--tool", tool};
            all.insert(all.end(), more.begin(), more.end());
            return refused(all);
        };
    EXPECT_THAT(with("box:60,-4,10", "flat:6"), HasSubstr("column 8: \"-4\" is not above 0"));
    EXPECT_THAT(with("box:60,40,10", "flat"), HasSubstr("\"flat\" is no tool"));
    EXPECT_THAT(with("missing.stl", "flat:6"), HasSubstr("missing.stl"));
    EXPECT_THAT(with("box:60,40,10", "flat:6", {"--resolution", "0.001"}), HasSubstr("mm fits"));
    EXPECT_THAT(with("box:60,40,10", "missing.json"), HasSubstr("missing.json"));
    std::ofstream(scratch / "open.stl")
        << "solid a\nfacet normal 0 0 1\nouter loop\nvertex 0 0 0\nvertex 9 0 0\n"
           "vertex 0 9 0\nendloop\nendfacet\nendsolid a\n";
    EXPECT_THAT(with(scratch / "open.stl", "flat:6"), HasSubstr("is open: 3 edges"));
}

TEST(SimulateCommand, SaysWhenNothingIsMetAndWhenTheSpindleIsOff) {
    const ScratchFolder scratch;
    const fs::path program = program_in(scratch, std::string(slot_program) + "M2\n");
    const Ended beside = run({"simulate",
                              program,
                              "--machine",
                              "router-xyz",
                              "--stock",
                              "box:9,9,9@200,200,0",
                              "--tool",
                              "flat:6",
                              "--out",
                              scratch / "out"});
    EXPECT_EQ(beside.exit_code, 0);
    EXPECT_THAT(beside.err, HasSubstr("no move meets the stock"));
    std::string text = slot_program;
    text.erase(text.find("M3 S8000\n"), 9);
    const Ended still = simulate(program_in(scratch, text + "M2\n"), scratch / "out", {"--tool", "flat:6"});
    EXPECT_EQ(still.exit_code, 0);
    EXPECT_THAT(still.err, HasSubstr("part.ngc:6: 1 move cuts material while the spindle is off"));
}

TEST(SimulateCommand, CutsAProjectWithItsMachineAndTool) {
    const ScratchFolder scratch;
    const fs::path project = small_project(scratch.path(), "dome");
    const Ended point = run({"simulate", project, "--out", scratch / "out"});
    EXPECT_EQ(point.exit_code, 1);
    EXPECT_THAT(point.err, HasSubstr("the project's tool is a point"));
    const Ended ended = run({"simulate",
                             project,
                             "--tool",
                             "assets/tools/ball-6.json",
                             "--resolution",
                             "2",
                             "--out",
                             scratch / "out"});
    EXPECT_LE(ended.exit_code, 1) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("the box of the surface and 2 mm on every side"));
    EXPECT_THAT(content_of(scratch / "out/program.ngc"), HasSubstr("G93"));
    const auto report = nlohmann::json::parse(content_of(scratch / "out/simulation.json"));
    EXPECT_GT(report.at("volume_mm3").at("removed").get<double>(), 1000.0);
    for (const auto& finding : report.at("findings")) {
        EXPECT_GT(finding.at("line").get<int>(), 10);
    }
}

TEST(SimulateCommand, ComparesWithAPartAndEndsWithCodeOneForAGouge) {
    const ScratchFolder scratch;
    const fs::path program = program_in(scratch, std::string(slot_program) + "M2\n");
    ASSERT_EQ(simulate(program, scratch / "part", {"--tool", "flat:6"}).exit_code, 0);
    const std::string part = scratch / "part/cut.stl";
    const Ended same =
        simulate(program, scratch / "same", {"--tool", "flat:6", "--part", part, "--tolerance", "0.3"});
    EXPECT_EQ(same.exit_code, 0) << same.err;
    EXPECT_THAT(same.out, HasSubstr("compared with cut.stl"));
    EXPECT_THAT(content_of(scratch / "same/part.ply"), StartsWith("ply\n"));
    EXPECT_THAT(content_of(scratch / "same/part.png"), StartsWith("\x89PNG"));
    std::string deeper = slot_program;
    deeper.replace(deeper.find("G0 Z-2"), 6, "G0 Z-3");
    const Ended gouged = simulate(program_in(scratch, deeper + "M2\n"),
                                  scratch / "gouged",
                                  {"--tool", "flat:6", "--part", part, "--tolerance", "0.3"});
    EXPECT_EQ(gouged.exit_code, 1);
    const auto report = nlohmann::json::parse(content_of(scratch / "gouged/simulation.json"));
    const auto& worst = report.at("comparison").at("largest_gouge");
    EXPECT_NEAR(worst.at("deviation_mm").get<double>(), -1.0, 0.05); // broken edges lean
    EXPECT_EQ(worst.at("line"), 7);
    EXPECT_NEAR(report.at("comparison").at("gouged_percent").get<double>(),
                100.0 * 60.0 * 6.0 / report.at("comparison").at("area_mm2").get<double>(),
                1.5);
}

TEST(SimulateCommand, CutsAClosedMeshOfAFile) {
    const ScratchFolder scratch;
    const fs::path first = program_in(scratch, std::string(slot_program) + "M2\n");
    ASSERT_EQ(simulate(first, scratch / "first", {"--tool", "flat:6"}).exit_code, 0);
    // What is left of the first simulation, at another place, is the stock of the next.
    const Ended ended = run({"simulate",
                             first,
                             "--machine",
                             "router-xyz",
                             "--stock",
                             (scratch / "first/cut.stl").string() + "@0,-8,0",
                             "--tool",
                             "ball:4",
                             "--resolution",
                             "0.5",
                             "--out",
                             scratch / "second"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    const auto report = nlohmann::json::parse(content_of(scratch / "second/simulation.json"));
    EXPECT_NEAR(report.at("volume_mm3").at("stock").get<double>(), 24000.0 - 720.0, 60.0);
    EXPECT_NEAR(report.at("volume_mm3").at("removed").get<double>(),
                60.0 * 2.0 * 3.14159,
                12.0); // edges of the mesh are broken
}

TEST(SimulateCommand, APartThatIsMilledAwayIsGouged) {
    const ScratchFolder scratch;
    std::string text = "G21 G90 G17\nT1 M6\nM3 S8000\nG0 X-10 Y-10 Z5\nG1 Z-12 F600\n";
    for (int row = 0; row <= 12; ++row) {
        text += "G1 Y" + std::to_string(5 * row - 10) + "\nG1 X" + (row % 2 == 0 ? "70" : "-10") + "\n";
    }
    const fs::path part = box_file(scratch / "wanted.stl", {0, 0, -10}, {60, 40, -2});
    const Ended ended = simulate(
        program_in(scratch, text + "G0 Z5\nM2\n"), scratch / "out", {"--tool", "flat:6", "--part", part});
    EXPECT_EQ(ended.exit_code, 1) << ended.out;
    EXPECT_THAT(ended.out, HasSubstr("0.0 mm^3 left"));
    EXPECT_THAT(ended.out, HasSubstr("0.0 % within 0.1 mm, 100.0 % gouged, 0.0 % in excess"));
    EXPECT_THAT(ended.out, HasSubstr("largest gouge (all material removed) at least"));
    const auto report = nlohmann::json::parse(content_of(scratch / "out/simulation.json"));
    EXPECT_EQ(report.at("comparison").at("largest_gouge").at("at_least"), true);
}

TEST(SimulateCommand, NeverReplacesOrRemovesWhatItReads) {
    const ScratchFolder scratch;
    const fs::path out = scratch / "out";
    const fs::path program = program_in(scratch, std::string(slot_program) + "M2\n");
    ASSERT_EQ(simulate(program, out, {"--tool", "flat:6"}).exit_code, 0);
    const auto refuses = [&](const fs::path& file, const std::vector<std::string>& arguments) {
        const std::string before = content_of(file);
        std::vector<std::string> all{"simulate"};
        all.insert(all.end(), arguments.begin(), arguments.end());
        all.insert(all.end(), {"--resolution", "1", "--out", out});
        const Ended ended = run(all);
        EXPECT_EQ(ended.exit_code, 1);
        EXPECT_THAT(ended.err, HasSubstr(file.filename().string()));
        EXPECT_THAT(ended.err, HasSubstr("is an input file"));
        EXPECT_EQ(content_of(file), before);
        EXPECT_THAT(ended.out, IsEmpty());
    };
    const std::vector<std::string> usual{program, "--machine", "router-xyz", "--tool", "flat:6"};
    const auto with = [&](std::vector<std::string> more) {
        more.insert(more.begin(), usual.begin(), usual.end());
        return more;
    };
    refuses(out / "cut.stl", with({"--stock", (out / "cut.stl").string() + "@0,-8,0"}));
    refuses(out / "cut.ply", with({"--stock", "box:60,40,10", "--part", out / "cut.ply"}));
    fs::copy_file("assets/tools/ball-6.json", out / "part.ply");
    fs::copy_file("assets/machines/router-xyz.json", out / "part.png");
    refuses(out / "part.png",
            {program, "--machine", out / "part.png", "--tool", "flat:6", "--stock", "box:60,40,10"});
    fs::remove(out / "part.ply");
    fs::remove(out / "part.png");
    fs::copy_file("assets/tools/ball-6.json", out / "simulation.json", fs::copy_options::overwrite_existing);
    // The program of a project belongs to the files of its simulation.
    const fs::path project = small_project(scratch.path(), "dome");
    const Ended first =
        run({"simulate", project, "--tool", "assets/tools/ball-6.json", "--resolution", "4", "--out", out});
    ASSERT_LE(first.exit_code, 1) << first.err;
    refuses(out / "program.ngc",
            {out / "program.ngc",
             "--machine",
             "rotary-tilt-listing",
             "--tool",
             "flat:6",
             "--stock",
             "box:60,40,10"});
}

TEST(SimulateCommand, ChangesToolsAtM6Only) {
    const ScratchFolder scratch;
    const std::string two = "G21 G90\nT1\nM3 S8000\nG0 X-10 Y20 Z5\nG0 Z-2\nG1 X70 F600\nG0 Z5\n"
                            "T2\nG0 X-10 Y10\nG0 Z-2\nG1 X70\nG0 Z5\nM2\n";
    const Ended refused =
        simulate(program_in(scratch, two), scratch / "out", {"--tool", "1=flat:6", "--tool", "2=flat:2"});
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, HasSubstr("part.ngc:8: T2 is selected after T1, and no M6 changes to it"));
    // One T: in the spindle from the start. After an M6 a T alone changes nothing.
    std::string one = two;
    one.erase(one.find("T2\n"), 3);
    const Ended alone = simulate(program_in(scratch, one), scratch / "out", {"--tool", "1=flat:6"});
    EXPECT_THAT(alone.out, HasSubstr("removed 1440.0 of"));
    std::string preselected = two;
    preselected.replace(preselected.find("T1\n"), 3, "T1 M6\n");
    const Ended kept = simulate(
        program_in(scratch, preselected), scratch / "out", {"--tool", "1=flat:6", "--tool", "2=flat:2"});
    EXPECT_EQ(kept.exit_code, 0) << kept.err;
    EXPECT_THAT(kept.out, HasSubstr("removed 1440.0 of"));
}

TEST(SimulateCommand, WarnsOfToolsThatAreTooNarrowOrNeverUsedAndRefusesTwoOfANumber) {
    const ScratchFolder scratch;
    const fs::path program = program_in(scratch, std::string(slot_program) + "M2\n");
    const Ended narrow = simulate(
        program, scratch / "out", {"--tool", "1=flat:0.9", "--tool", "7=flat:3", "--memory", "1e300"});
    EXPECT_EQ(narrow.exit_code, 0) << narrow.err;
    EXPECT_THAT(narrow.err, HasSubstr("a tool of 0.9 mm is narrower than two lines"));
    EXPECT_THAT(narrow.err, HasSubstr("the program never changes to tool 7"));
    const Ended wide = simulate(program, scratch / "out", {"--tool", "1=flat:6"});
    EXPECT_THAT(wide.err, Not(HasSubstr("narrower")));
    EXPECT_THAT(wide.err, Not(HasSubstr("never changes")));
    const Ended twice = simulate(program, scratch / "out", {"--tool", "1=flat:6", "--tool", "1=flat:4"});
    EXPECT_NE(twice.exit_code, 0);
    EXPECT_THAT(twice.err, HasSubstr("tool 1 is named twice"));
}

TEST(SimulateCommand, EndsWithCodeOneForFeedsThatAreNotSimulated) {
    const ScratchFolder scratch;
    const fs::path program = program_in(
        scratch, "G21 G90\nT1 M6\nM3 S8000\nG0 Z5\nG1 X10 F300\nG1 X20\nG0 Y20\nG1 Z-2\nG0 Z5\nM2\n");
    const Ended ended = simulate(program, scratch / "out", {"--tool", "flat:6"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err,
                HasSubstr("part.ngc:5: not simulated: 2 feeds before the program has positioned every axis "
                          "that it uses, lines 5 to 6"));
    const auto report = nlohmann::json::parse(content_of(scratch / "out/simulation.json"));
    EXPECT_EQ(report.at("moves").at("skipped_feeds"), 2);
    EXPECT_EQ(report.at("moves").at("skipped"), 4);
}

// A head that tilts swings the tip about the gauge line: a longer tool cuts elsewhere.
TEST(SimulateCommand, ReportsRateDepthWidthAndTimeInAir) {
    const ScratchFolder scratch;
    const Ended ended = simulate(program_in(scratch, std::string(slot_program) + "G1 X-10 F800\nM2\n"),
                                 scratch / "out",
                                 {"--tool", "flat:6"});
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("2700 mm^3/min (line 7), 2.00 mm deep, 6.00 mm wide"));
    const auto engagement =
        nlohmann::json::parse(content_of(scratch / "out/simulation.json")).at("engagement");
    EXPECT_EQ(engagement.at("feeds"), 2);
    EXPECT_EQ(engagement.at("feeds_in_air"), 1);
    EXPECT_NEAR(engagement.at("feed_time_s").get<double>(), 16.0 + 6.0, 1e-6);
    EXPECT_NEAR(engagement.at("air_time_s").get<double>(), 6.0, 1e-6);
    EXPECT_EQ(engagement.at("deepest").at("line"), 7);
    EXPECT_THAT(content_of(scratch / "out/engagement.csv"), HasSubstr("\n7,"));
}

TEST(SimulateCommand, RefusesOptionsOfGcodeWithAProject) {
    const ScratchFolder scratch;
    const fs::path project = scratch / "DOME.JSON";
    fs::copy_file("assets/projects/dome.json", project);
    const std::vector<std::vector<std::string>> given{{"--origin", "0,0,0"},
                                                      {"--dialect", "linuxcnc"},
                                                      {"--subroutines", scratch.path().string()},
                                                      {"--block-delete"}};
    for (const std::vector<std::string>& option : given) {
        std::vector<std::string> arguments{"simulate", project.string(), "--out", (scratch / "out").string()};
        arguments.insert(arguments.end(), option.begin(), option.end());
        const Ended ended = run(arguments);
        EXPECT_NE(ended.exit_code, 0);
        EXPECT_THAT(ended.err, HasSubstr(option.front() + " is for G-code files"));
    }
}

TEST(SimulateCommand, TiltsAToolOfAFileByItsGaugeLength) {
    const ScratchFolder scratch;
    const fs::path program =
        program_in(scratch, "G21 G90\nT1 M6\nM3 S8000\nG0 X0 Y0 Z0 B30 C0\nG1 X1 F300\nM2\n");
    const auto removed_by = [&](const std::string& length) {
        const fs::path file = scratch / "long.json";
        const std::string text = content_of("assets/tools/ball-6.json");
        auto tool = nlohmann::json::parse(text);
        tool["tool"]["gauge_length_mm"] = std::stod(length);
        std::ofstream(file) << tool.dump();
        const Ended ended = run({"simulate",
                                 program,
                                 "--machine",
                                 "bc-table-head",
                                 "--stock",
                                 "box:400,400,400@-200,-200,-200",
                                 "--tool",
                                 file,
                                 "--resolution",
                                 "4",
                                 "--out",
                                 scratch / "out"});
        EXPECT_THAT(ended.err, Not(HasSubstr("gauge length"))) << ended.err;
        return content_of(scratch / "out/cut.stl");
    };
    EXPECT_NE(removed_by("80"), removed_by("140"));
    const Ended spec = run({"simulate",
                            program,
                            "--machine",
                            "bc-table-head",
                            "--stock",
                            "box:40,40,40",
                            "--tool",
                            "flat:6",
                            "--out",
                            scratch / "spec"});
    EXPECT_THAT(spec.err, HasSubstr("flat:6: the head tilts the tool"));
}

} // namespace
} // namespace millwright::test
