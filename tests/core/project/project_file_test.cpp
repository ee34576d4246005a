#include "core/project/project_file.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/project/assets.h"
#include "core/project/setting_tables.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/without_traps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

namespace millwright::project {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const auto place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return text.replace(place, from.size(), to);
}

std::string fault_in(const std::string& text) {
    try {
        (void)project_from_text(text, "part.json");
    } catch (const Error& error) {
        return to_text(error.diagnostic());
    }
    return "no fault";
}

/// What reading says of the dome's project with `from` replaced by `to`.
std::string project_fault(const std::string& from, const std::string& to) {
    return fault_in(replaced(project_text(project_from_preset("dome")), from, to));
}

// T1.
TEST(ProjectFile, WhatIsWrittenIsRead) {
    std::mt19937 random(1997);
    std::uniform_real_distribution<double> coordinate(-1e4, 1e4);
    Project project = project_from_preset("two-bell");
    project.name = "A \"quoted\" näme\n";
    for (Vec3& p : project.surface.patches[0].points) {
        p = {coordinate(random), coordinate(random), coordinate(random)};
    }
    project.surface.patches.push_back(project.surface.patches[0]);
    project.surface.patches[1].weight(1, 1) = 1.0 / 3.0;
    project.surface.machined_patch = 1;
    project.surface.flipped = true;
    project.machine = {"../ours.json",
                       Vec3(0.1, 1e-9, -3.0),
                       ToolSetInput{.e = 0.1, .OF = 1e-9, .AB = 250.0, .B4 = 1.0 / 3.0},
                       kinematics::AngleMode::faulty_text};
    project.grid.direction = grid::TrackDirection::along_u;
    project.grid.method = GridMethod::elliptic;
    project.grid.elliptic.weight = WeightSource::expression;
    project.grid.elliptic.expression = "1 + u*v";
    project.grid.elliptic.sliding_boundary = false;
    project.grid.elliptic.any_memory = true;
    project.grid.elliptic.mix = {.error = 0.5,
                                 .curvature = 2.0,
                                 .painted = 3.0,
                                 .expression = 0.25,
                                 .combination = grid::Combination::largest,
                                 .smoothing_passes = 7,
                                 .low = 0.125,
                                 .high = 50.0};
    project.grid.elliptic.painted = grid::Field{2, 3, {0.0, 0.25, 1.0, 0.001, 0.5, 0.75}};
    project.grid.elliptic.solver = grid::EllipticMethod::multigrid;
    project.program.link = LinkInput::on_surface;
    for (const auto& setting : program_numbers()) {
        setting.set(project.program, 0.5 * (setting.min + setting.default_value()));
    }
    EXPECT_EQ(project_from_text(project_text(project), "x"), project);
}

TEST(ProjectFile, ToolAndSequencingComeBack) {
    Project project = project_from_preset("dome");
    EXPECT_EQ(project_text(project).find("\"tool\""), std::string::npos);
    EXPECT_EQ(project_text(project).find("\"sequencing\""), std::string::npos);
    project.tool = {.cutter = toolpath::CutterKind::cone,
                    .diameter_mm = 5.0,
                    .corner_radius_mm = 0.75,
                    .half_angle_deg = 8.0,
                    .length_mm = 31.0,
                    .holder_diameter_mm = 18.0,
                    .holder_length_mm = 44.0,
                    .lead_deg = -3.0,
                    .tilt_deg = 7.0,
                    .lead_change_deg = 1.0,
                    .tilt_change_deg = -2.0,
                    .scallop_mm = 0.02,
                    .gouge_limit_mm = 0.3};
    project.sequencing = {toolpath::SequencingGoal::time, 12.5};
    EXPECT_EQ(project_from_text(project_text(project), "x"), project);
}

TEST(ProjectFile, AToolThatCannotBeIsRefusedAtItsPlace) {
    Project project = project_from_preset("dome");
    project.tool.cutter = toolpath::CutterKind::bull_nose;
    project.tool.corner_radius_mm = 1.25;
    const std::string text = project_text(project);
    const std::string told = fault_in(replaced(text, "1.25", "4.25"));
    EXPECT_THAT(told, AllOf(StartsWith("part.json:"), HasSubstr("tool"), HasSubstr("does not fit into")));
    EXPECT_THAT(fault_in(replaced(text, "bull-nose", "drill")), HasSubstr("tool/cutter"));
}

TEST(ProjectFile, WhatIsWrongWithAMixOrThePaintIsSaidWithItsPlace) {
    Project project = project_from_preset("dome");
    project.grid.elliptic.mix.high = 50.0;
    project.grid.elliptic.painted = grid::Field{2, 2, {0.0, 0.25, 1.0, 0.5}};
    const std::string sound = project_text(project);
    const auto fault = [&](const std::string& from, const std::string& to) {
        std::string text = sound;
        text.replace(text.find(from), from.size(), to);
        try {
            (void)project_from_text(text, "x.json");
        } catch (const Error& error) {
            EXPECT_GT(error.diagnostic().place.line, 0);
            return error.diagnostic().message;
        }
        return std::string("nothing");
    };
    EXPECT_THAT(fault("[0, 0.25]", "[0, 1.25]"), HasSubstr("grid/elliptic/painted"));
    EXPECT_THAT(fault("[0, 0.25]", "[0]"), HasSubstr("grid/elliptic/painted"));
    EXPECT_THAT(fault("\"high\": 50", "\"high\": 0.001"), HasSubstr("maximum weight is below"));
    EXPECT_THAT(fault("\"sum\"", "\"difference\""), HasSubstr("difference"));
}

TEST(ProjectFile, TheSameProjectGivesTheSameBytes) {
    const Project project = project_from_preset("sine");
    EXPECT_EQ(project_text(project), project_text(project_from_text(project_text(project), "x")));
}

TEST(ProjectFile, SampleProjectsReadAndAreWrittenAsTheyStand) {
    for (const fs::path& file : sample_projects("assets")) {
        const Project project = read_project(file);
        EXPECT_EQ(project_text(project), read_file(file)) << file;
        EXPECT_NO_THROW((void)machine_path(project, file.parent_path(), "assets")) << file;
    }
    EXPECT_EQ(read_project("assets/projects/dome.json").machine.file, "rotary-tilt-listing");
    EXPECT_EQ(read_project("assets/projects/two-bell.json").machine.file, "ac-table");
    EXPECT_EQ(read_project("assets/projects/sine.json").machine.file, "rotary-tilt-listing");
}

TEST(ProjectFile, APresetAloneIsEnoughOfASurface) {
    const Project project =
        project_from_text(R"({"format": "millwright-project", "version": 1, "name": "Dome",
        "surface": {"preset": "dome"}, "machine": {"file": "rotary-tilt-listing"}})",
                          "x");
    EXPECT_EQ(project, project_from_preset("dome"));
}

TEST(ProjectFile, FaultsComeWithLineColumnAndField) {
    EXPECT_EQ(fault_in("{\n  \"format\": 3\n}"), "part.json:2:13: format: expected a text, found a number");
    EXPECT_THAT(project_fault("\"nu\": 20", "\"nu\": \"20\""),
                HasSubstr("grid/nu: expected a number, found a text"));
    EXPECT_THAT(project_fault("\"nu\": 20", "\"nu\": 1"), HasSubstr("grid/nu: 1 is not between 2 and 1000"));
    EXPECT_THAT(project_fault("\"nu\": 20", "\"nu\": 20.5"), HasSubstr("grid/nu: expected a whole number"));
    EXPECT_THAT(project_fault("\"nu\": 20", "\"nx\": 20"),
                HasSubstr("grid/nx: the field \"nx\" is not known here"));
    EXPECT_THAT(project_fault("\"flipped\": false", "\"flipped\": 0"),
                HasSubstr("surface/flipped: expected true or"));
    EXPECT_THAT(project_fault("\"along-v\"", "\"along-w\""),
                AllOf(HasSubstr("grid/direction: 'along-w'"), HasSubstr("known: along-u, along-v")));
    EXPECT_THAT(
        project_fault("\"preset\": \"dome\"", "\"preset\": \"doom\""),
        AllOf(HasSubstr("surface/preset: unknown surface preset 'doom'"), HasSubstr("use one of: dome")));
    EXPECT_THAT(project_fault("\"version\": 1", "\"version\": 2"),
                HasSubstr("version: 2 is not between 1 and 1"));
    EXPECT_THAT(project_fault("millwright-project", "millwright-machine"),
                HasSubstr("format: not a project file"));
    EXPECT_THAT(project_fault("\"rotary-tilt-listing\"", "\"\""),
                HasSubstr("machine/file: no machine is specified"));
    EXPECT_THAT(project_fault("\"machined_patch\": 0", "\"machined_patch\": 1"),
                HasSubstr("surface/machined_patch: 1"));
}

TEST(ProjectFile, NetsMustBeRectangularAndFinite) {
    const test::WithoutTraps numbers_that_are_none;
    EXPECT_THAT(project_fault("[10, 10, 1]", "[10, 10]"),
                HasSubstr("surface/patches[0]/points[0][0]: expected a list of 3, found 2"));
    EXPECT_THAT(project_fault("[10, 10, 1], ", ""), HasSubstr("expected a list of 3, found 4"));
    EXPECT_THAT(project_fault("[10, 10, 1]", "[1e300, 10, 1]"),
                HasSubstr("is not between -100000 and 100000"));
    EXPECT_THAT(project_fault("[10, 10, 1]", "[1e400, 10, 1]"), HasSubstr("the number 1e400 is too large"));
    EXPECT_THAT(project_fault("[10, 10, 1]", "[NaN, 10, 1]"), HasSubstr("not valid JSON near"));
    EXPECT_THAT(
        fault_in(R"({"format": "millwright-project", "version": 1, "name": "", "machine": {"file": "m"},
        "surface": {"patches": [{"points": [[[0,0,0],[1,0,0]],[[0,1,0],[1,1,0]]], "weights": [[1,1,1],[1,1,1]]}]}})"),
        HasSubstr("surface/patches[0]/weights: expected 2 x 2 weights"));
    EXPECT_THAT(
        fault_in(R"({"format": "millwright-project", "version": 1, "name": "", "machine": {"file": "m"},
        "surface": {"patches": []}})"),
        HasSubstr("surface: a surface needs"));
}

// T20.
TEST(ProjectFile, ARegionOfAdaptationComesBackAndAFaultyOneIsRefused) {
    Project project = project_from_preset("dome");
    project.grid.elliptic.region = {{{0.1, 0.2}, {0.9, 0.25}, {0.5, 0.75}}, 7.5};
    EXPECT_EQ(project_from_text(project_text(project), "p.json"), project);
    project.grid.elliptic.region.outline.pop_back();
    EXPECT_THROW((void)project_text(project), Error) << "two corners";
    const auto with = [](const std::string& region) {
        return R"({"format": "millwright-project", "version": 1, "name": "", "machine": {"file": "m"},
        "surface": {"preset": "dome"}, "grid": {"elliptic": {"region": )" +
               region + "}}}";
    };
    EXPECT_THAT(fault_in(with(R"({"outline": [[0, 0], [1, 1]]})")), HasSubstr("3 to 200 corners"));
    EXPECT_THAT(fault_in(with(R"({"outline": [[0, 0], [1, 1], [2, 0]]})")), HasSubstr("outline[2]"));
    EXPECT_THAT(fault_in(with(R"({"outline": [[0, 0], [1, 1], [0.5, 0.5]]})")),
                HasSubstr("grid/elliptic/region/outline: the outline encloses no area"));
    EXPECT_THAT(fault_in(with(R"({"outline": [[0, 0], [1, 1], [1, 0]], "border_mm": -1})")),
                HasSubstr("border_mm"));
}

TEST(ProjectFile, APartOfNanometresIsRefusedAtItsPatch) {
    const std::string text =
        R"({"format": "millwright-project", "version": 1, "name": "", "machine": {"file": "m"},
        "surface": {"patches": [{"points": [[[0, 0, 0], [0, 5e-6, 0]], [[5e-6, 0, 0], [5e-6, 5e-6, 0]]]}]}})";
    EXPECT_THAT(fault_in(text),
                HasSubstr("part.json:2:33: surface/patches[0]: the part is 5e-06 mm in size, below the "
                          "minimum of 0.001 mm"));
}

TEST(ProjectFile, AStockComesBackAndTheUsualOneIsNotWritten) {
    Project project = project_from_preset("dome");
    EXPECT_EQ(project_text(project).find("\"stock\""), std::string::npos);
    project.stock = {false, 0.5, "tube:90,20,40@0,0,-30", {}, Vec3::Zero()};
    EXPECT_EQ(project_from_text(project_text(project), "part.json"), project);
    project.stock.around_part = true;
    EXPECT_EQ(project_from_text(project_text(project), "part.json"), project);
}

TEST(ProjectFile, TheMeshOfAStockIsNamedFromTheFolderOfTheProject) {
    const test::ScratchFolder scratch;
    Project project = project_from_preset("dome");
    project.stock = {false, 2.0, "box:9,9,9", scratch / "meshes/block.stl", {1.0, -2.0, 0.1}};
    const std::string text = write_project(project, scratch / "part.json");
    EXPECT_THAT(text, HasSubstr("\"file\": \"meshes/block.stl\""));
    EXPECT_EQ(read_project(scratch / "part.json"), project);
    fs::create_directories(scratch / "elsewhere");
    EXPECT_THAT(write_project(project, scratch / "elsewhere/part.json"),
                HasSubstr((scratch / "meshes/block.stl").string()));
}

TEST(ProjectFile, AMeshNamedFromTheCurrentFolderIsFoundFromAnotherOne) {
    const test::ScratchFolder scratch;
    fs::create_directories(scratch / "elsewhere");
    Project project = project_from_preset("dome");
    project.stock = {false, 2.0, "box:9,9,9", fs::path("meshes") / "block.stl", Vec3::Zero()};
    write_project(project, scratch / "elsewhere/part.json");
    const fs::path found = read_project(scratch / "elsewhere/part.json").stock.file;
    EXPECT_EQ(found, (fs::current_path() / "meshes/block.stl").lexically_normal());
}

TEST(ProjectFile, AFaultyStockIsRefusedAtItsPlace) {
    Project project = project_from_preset("dome");
    project.stock = {false, 3.25, "box:100,100,20@-50,-50,-20", "block.stl", Vec3::Zero()};
    const std::string text = project_text(project);
    const auto fault = [&](const std::string& from, const std::string& to) {
        return fault_in(replaced(text, from, to));
    };
    EXPECT_THAT(fault("3.25", "-1"), AllOf(StartsWith("part.json:"), HasSubstr("stock/allowance_mm")));
    EXPECT_THAT(fault("3.25", "\"thick\""), HasSubstr("stock/allowance_mm"));
    EXPECT_THAT(fault("block.stl", ""), AllOf(HasSubstr("stock/file"), HasSubstr("empty")));
    EXPECT_THAT(fault("box:100,100,20@-50,-50,-20", ""),
                AllOf(HasSubstr("stock/shape"), HasSubstr("no stock is named")));
    EXPECT_THAT(fault("\"shape\"", "\"form\""), HasSubstr("stock"));
    project.stock.allowance_mm = -1.0;
    EXPECT_THROW((void)project_text(project), Error);
}

TEST(ProjectFile, AMissingFileIsNamed) {
    try {
        (void)read_project("no/such.json");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(to_text(error.diagnostic()), StartsWith("no/such.json: cannot read: No such file"));
    }
}

TEST(ProjectFile, AFaultyProjectIsNotWrittenAndTheOldFileStays) {
    const test::ScratchFolder scratch;
    Project project = project_from_preset("dome");
    write_project(project, scratch / "part.json");
    const std::string before = read_file(scratch / "part.json");
    project.grid.nv = 0;
    EXPECT_THROW(write_project(project, scratch / "part.json"), Error);
    project.grid.nv = 20;
    project.name = "\xff";
    EXPECT_THROW(write_project(project, scratch / "part.json"), Error);
    EXPECT_EQ(read_file(scratch / "part.json"), before);
}

TEST(ProjectFile, TheConstantsOfTheThesissMachineAreKept) {
    Project project = project_from_preset("dome");
    EXPECT_EQ(project_text(project).find("tool_set"), std::string::npos);
    project.machine.tool_set = ToolSetInput{.e = 0.5, .OF = 119.0, .AB = 240.0, .B4 = 360.25};
    project.grid.elliptic.relaxation = 0.5;
    project.grid.elliptic.error_change = 0.01;
    project.grid.elliptic.iterations_per_step = 3;
    const std::string text = project_text(project);
    EXPECT_EQ(project_from_text(text, "part.json"), project);
    std::string without = text;
    without.replace(without.find("\"AB\""), 4, "\"AC\"");
    EXPECT_THAT(fault_in(without), HasSubstr("machine/tool_set"));
    project.machine.tool_set->B4 = 1e7;
    EXPECT_THAT(faults_of(project), testing::Contains(HasSubstr("machine/tool_set/B4")));
}

TEST(ProjectFile, OutlinesOfTrimmedPatchesAreKept) {
    Project project = project_from_preset("dome");
    project.surface.patches.push_back(project.surface.patches.front());
    project.surface.trims = {{},
                             {{{{0.1, 0.2}, {0.9, 0.2}, {0.5, 0.75}}, {{0.4, 0.3}, {0.5, 0.3}, {0.5, 0.4}}}}};
    const std::string text = project_text(project);
    EXPECT_EQ(project_from_text(text, "part.json").surface, project.surface);
    EXPECT_EQ(project_text(project_from_text(text, "part.json")), text);
    EXPECT_EQ(project_text(project_from_preset("dome")).find("trim"), std::string::npos)
        << "files without outlines look as before";
}

Project with_face() {
    Project project = project_from_preset("dome");
    geometry::BsplineNet net;
    net.degree_u = 2;
    net.degree_v = 1;
    net.knots_u = {0, 0, 0, 1.0 / 3.0, 1, 1, 1};
    net.knots_v = {0, 0, 1, 1};
    net.rows = 4;
    net.columns = 2;
    for (int i = 0; i < net.rows; ++i) {
        for (int j = 0; j < net.columns; ++j) {
            net.points.emplace_back(10.0 * i, 20.0 * j, 1.0 / (3.0 + i));
            net.weights.push_back(1.0);
        }
    }
    project.surface = {};
    project.surface.flipped = true;
    project.surface.face = FaceInput{net, {}};
    return project;
}

TEST(ProjectFile, AnExactFaceComesBackToTheLastBit) {
    Project project = with_face();
    EXPECT_EQ(faults_of(project), std::vector<std::string>());
    EXPECT_EQ(project_from_text(project_text(project), "part.json"), project);
    project.surface.face->net.weights[3] = 0.7;
    project.surface.face->trim.loops = {{{0.1, 0.1}, {0.9, 0.1}, {1.0 / 3.0, 0.9}}};
    EXPECT_EQ(project_from_text(project_text(project), "part.json"), project);
}

TEST(ProjectFile, AFaceThatCannotBeIsRefusedAtItsPlace) {
    const std::string text = project_text(with_face());
    const auto fault = [&](const std::string& from, const std::string& to) {
        return fault_in(replaced(text, from, to));
    };
    EXPECT_THAT(fault("\"degree\"", "\"degrees\""), HasSubstr("degree"));
    EXPECT_THAT(fault("0.3333333333333333", "1.5"), HasSubstr("knots_u"));
    EXPECT_THAT(fault("0.3333333333333333", "0"), HasSubstr("surface/face: knot 0 along u is repeated"));
    EXPECT_THAT(fault("\"flipped\"", "\"machined_patch\": 0, \"flipped\""), HasSubstr("machined_patch"));
    Project both = with_face();
    both.surface.patches = project_from_preset("dome").surface.patches;
    EXPECT_THAT(faults_of(both), testing::ElementsAre(HasSubstr("takes the place of preset and patches")));
    Project far = with_face();
    far.surface.face->net.points[0].x() = 2e5;
    EXPECT_THAT(faults_of(far), testing::ElementsAre(HasSubstr("surface/face: a control point is farther")));
    Project small = with_face();
    for (Vec3& point : small.surface.face->net.points) {
        point *= 1e-6;
    }
    EXPECT_THAT(faults_of(small), testing::ElementsAre(HasSubstr("surface/face: the part")));
    Project odd = with_face();
    odd.surface.face->trim.loops = {{{0.1, 0.1}, {0.9, 0.1}}};
    EXPECT_THAT(faults_of(odd), testing::ElementsAre(HasSubstr("surface/face/trim")));
}

TEST(ProjectFile, RefusesOutlinesThatAreNone) {
    const auto fault_of_trim = [](const std::string& trim) {
        return fault_in("{\"format\": \"millwright-project\", \"version\": 1, \"name\": \"a\", \"machine\": "
                        "{\"file\": \"ac-table\"}, \"surface\": {\"patches\": [{\"points\": "
                        "[[[0,0,0],[0,9,0]],[[9,0,0],[9,9,0]]], \"trim\": " +
                        trim + "}]}}");
    };
    EXPECT_EQ(fault_of_trim("[[[0,0],[1,0],[1,1]]]"), "no fault");
    EXPECT_EQ(fault_of_trim("[]"), "no fault");
    EXPECT_THAT(fault_of_trim("[[[0,0],[1,0]]]"), HasSubstr("three corners"));
    EXPECT_THAT(fault_of_trim("[[[0,0],[1.5,0],[1,1]]]"), HasSubstr("part.json:1:"));
    EXPECT_THAT(fault_of_trim("[[[0,0],[1,0],[1]]]"), HasSubstr("part.json:1:"));
    EXPECT_THAT(fault_of_trim("[[[0,0],[1,0],[1,1]], [[0,0]]]"), HasSubstr("three corners"));
}

} // namespace
} // namespace millwright::project
