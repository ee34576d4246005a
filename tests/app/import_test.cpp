#include "tests/app/scratch_files.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

using ::testing::HasSubstr;

class ImportCommand : public ScratchFiles {
protected:
    /// The dome of the shipped projects as a file of the other kind.
    [[nodiscard]] std::string exported(const std::string& name, const std::string& tolerance = "0.02") const {
        const Ended ended =
            run({"export", "assets/projects/dome.json", "--out", path(name), "--tolerance", tolerance});
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
        return path(name);
    }
};

TEST_F(ImportCommand, AnExportTellsThatOutlinesStayBehind) {
    if (run({"import", "assets/samples/cover.step", "--face", "3", "--out", path("cover.json")}).exit_code !=
        0) {
        GTEST_SKIP() << "built without Open CASCADE";
    }
    const Ended cover = run({"export", path("cover.json"), "--out", path("cover.stl")});
    ASSERT_EQ(cover.exit_code, 0) << cover.err;
    EXPECT_THAT(cover.out, HasSubstr("One patch is trimmed: the file contains the whole patch"));
    const Ended dome = run({"export", "assets/projects/dome.json", "--out", path("dome.stl")});
    EXPECT_EQ(dome.out, path("dome.stl") + "\n");
}

// A round face of the shipped part is several patches: as an exact face all of it is machined.
TEST_F(ImportCommand, AFaceOfSeveralPatchesIsOneExactSurface) {
    const std::string cover = "assets/samples/cover.step";
    const Ended listed = run({"import", cover, "--json"});
    if (listed.exit_code != 0) {
        GTEST_SKIP() << "built without Open CASCADE";
    }
    std::string number;
    int patches = 0;
    const nlohmann::json model = nlohmann::json::parse(listed.out);
    for (const nlohmann::json& face : model.at("faces")) {
        const int count = face.at("patches").at(0).get<int>() * face.at("patches").at(1).get<int>();
        if (count > patches) {
            patches = count;
            number = std::to_string(face.at("number").get<int>());
        }
    }
    ASSERT_GT(patches, 1);
    const std::vector<std::string> import{"import", cover, "--face", number, "--out", path("face.json")};
    const auto with = [&](const std::vector<std::string>& more) {
        std::vector<std::string> all = import;
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    };
    const Ended exact = with({"--exact", "--json"});
    ASSERT_EQ(exact.exit_code, 0) << exact.err;
    const nlohmann::json spans = nlohmann::json::parse(exact.out).at("face").at("spans");
    EXPECT_EQ(spans.at(0).get<int>() * spans.at(1).get<int>(), patches);
    const nlohmann::json surface = nlohmann::json::parse(content_of(path("face.json"))).at("surface");
    EXPECT_TRUE(surface.contains("face"));
    EXPECT_FALSE(surface.contains("patches"));
    EXPECT_THAT(with({"--exact"}).out, HasSubstr("exact face of degree"));
    const Ended stl = run({"export", path("face.json"), "--out", path("face.stl")});
    EXPECT_EQ(stl.exit_code, 0) << stl.err;
    const Ended reshaped =
        run({"reshape", path("face.json"), "--split-u", "0.5", "--out", path("split.json")});
    EXPECT_NE(reshaped.exit_code, 0);
    EXPECT_THAT(reshaped.err, HasSubstr("exact face without patches"));
    EXPECT_THAT(with({"--exact", "--degree", "3"}).err, HasSubstr("--exact and --degree exclude each other"));
    EXPECT_THAT(run({"import", exported("dome.stl"), "--out", path("mesh.json"), "--exact"}).err,
                HasSubstr("--exact applies only to a face of a STEP or IGES file"));
}

// The dome in four faces is planned like the dome.
TEST_F(ImportCommand, SeveralFacesAreJoinedAndPlannedAsOneSurface) {
    const std::string file = "assets/samples/dome-faces.step";
    if (run({"import", file}).exit_code != 0) {
        GTEST_SKIP() << "built without Open CASCADE";
    }
    const std::string joined = path("joined.json");
    const Ended made = run({"import", file, "--exact", "--faces", "1,2,3,4", "--out", joined, "--json"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const nlohmann::json told = nlohmann::json::parse(made.out).at("joined");
    EXPECT_EQ(told.at("faces"), nlohmann::json::array({1, 2, 3, 4}));
    EXPECT_EQ(told.at("flattening"), "own parameters");
    EXPECT_LT(told.at("boundary_off_mm").get<double>(), 0.01);
    const auto figures = [&](const std::string& project, const std::string& out) {
        const Ended planned = run({"plan", project, "--out", path(out)});
        EXPECT_EQ(planned.exit_code, 0) << planned.err;
        return nlohmann::json::parse(content_of(path(out) + "/report.json"));
    };
    const nlohmann::json whole = figures("assets/projects/dome.json", "whole");
    nlohmann::json of_faces = nlohmann::json::parse(content_of("assets/projects/dome.json"));
    of_faces["surface"] = nlohmann::json::parse(content_of(joined)).at("surface");
    (void)written("joined.json", of_faces.dump());
    const nlohmann::json faces = figures(joined, "faces");
    EXPECT_EQ(faces.at("surface").at("faces").size(), 4U);
    const auto uniform = [](const nlohmann::json& report) {
        return report.at("error").at("uniform").at("closest").at("max").get<double>();
    };
    EXPECT_NEAR(uniform(faces), uniform(whole), 0.02 * uniform(whole));
    EXPECT_THAT(run({"import", file, "--exact", "--faces", "1,4", "--out", joined}).err,
                HasSubstr("faces 1 and 4"));
    EXPECT_THAT(run({"import", file, "--exact", "--faces", "1,9", "--out", joined}).err,
                HasSubstr("no usable face 9"));
    EXPECT_THAT(run({"import", file, "--faces", "1,2", "--out", joined}).err, HasSubstr("add --exact"));
    EXPECT_THAT(run({"import", file, "--exact", "--face", "1", "--faces", "1,2", "--out", joined}).err,
                HasSubstr("exclude each other"));
}

TEST_F(ImportCommand, StepComesBackAsItWas) {
    const std::string file = exported("dome.step");
    const Ended ended = run({"import", file, "--out", path("back.json"), "--json"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_EQ(nlohmann::json::parse(ended.out).at("patches"), 1);
    const Ended planned = run({"plan", path("back.json"), "--out", path("plan")});
    EXPECT_EQ(planned.exit_code, 0) << planned.err;
    const auto nets = [](const std::string& project) {
        return nlohmann::json::parse(content_of(project)).at("surface").at("patches");
    };
    ASSERT_EQ(run({"export", path("back.json"), "--out", path("again.step")}).exit_code, 0);
    ASSERT_EQ(run({"import", path("again.step"), "--out", path("again.json")}).exit_code, 0);
    EXPECT_EQ(nets(path("again.json")), nets(path("back.json")));
}

TEST_F(ImportCommand, AHoleThatIsFittedAcrossIsAWarningWithItsOwnExitCode) {
    // A plate of 60 x 60 mm, in cells of 2 mm, with a square hole of 20 mm.
    std::string plate = "solid plate\n";
    const auto corner = [](int x, int y) { return fmt::format("vertex {} {} 0\n", x, y); };
    for (int x = 0; x < 60; x += 2) {
        for (int y = 0; y < 60; y += 2) {
            if (x >= 20 && x < 40 && y >= 20 && y < 40) {
                continue;
            }
            const std::string begin = "facet normal 0 0 1\nouter loop\n", end = "endloop\nendfacet\n";
            plate += begin + corner(x, y) + corner(x + 2, y) + corner(x + 2, y + 2) + end;
            plate += begin + corner(x, y) + corner(x + 2, y + 2) + corner(x, y + 2) + end;
        }
    }
    write_content(path("plate.stl"), plate + "endsolid plate\n");
    const Ended ended = run({"import", path("plate.stl"), "--out", path("plate.json")});
    EXPECT_EQ(ended.exit_code, 3) << ended.err;
    EXPECT_THAT(ended.err,
                HasSubstr("warning: the mesh has a hole, 28.3 mm wide: the patch is fitted across"));
    EXPECT_TRUE(std::filesystem::exists(path("plate.json")));
    const auto told =
        nlohmann::json::parse(run({"import", path("plate.stl"), "--out", path("plate.json"), "--json"}).out);
    EXPECT_EQ(told.at("warnings").size(), 1U);
    ASSERT_EQ(told.at("fit").at("holes_mm").size(), 1U);
    EXPECT_NEAR(told.at("fit").at("holes_mm").at(0).get<double>(), 20.0 * std::sqrt(2.0), 0.01);
    const Ended whole = run({"import", exported("dome.stl"), "--out", path("dome.json"), "--json"});
    EXPECT_EQ(whole.exit_code, 0) << whole.err;
    EXPECT_TRUE(nlohmann::json::parse(whole.out).at("warnings").empty());
}

TEST_F(ImportCommand, PointsInRowsAreMetExactly) {
    std::string text;
    for (const int x : {-30, -10, 10, 30}) {
        for (const int y : {-30, -10, 10, 30}) {
            text += fmt::format("{} {} {}\n", x, y, (x * x < 900 ? 7 : 0) + (y * y < 900 ? 7 : 0));
        }
    }
    write_content(path("probe.txt"), text);
    EXPECT_EQ(run({"import", path("probe.txt")}).out,
              "16 points, 4 rows of 4 points\n60.000 x 60.000 x 14.000 mm\n");
    const Ended made = run(
        {"import", path("probe.txt"), "--out", path("probe.json"), "--deviation", path("off.csv"), "--json"});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    const auto told = nlohmann::json::parse(made.out).at("points");
    EXPECT_EQ(told.at("rows"), 4);
    EXPECT_EQ(told.at("count"), 16);
    EXPECT_LT(told.at("max_mm").get<double>(), 1e-9);
    EXPECT_THAT(
        content_of(path("off.csv")),
        testing::StartsWith("x_mm,y_mm,z_mm,deviation_mm\n-30.000000,-30.000000,0.000000,0.000000\n"));
    const auto project = nlohmann::json::parse(content_of(path("probe.json")));
    for (const auto& row : project.at("surface").at("patches").at(0).at("points")) {
        for (const auto& point : row) {
            EXPECT_LE(std::abs(point.at(0).get<double>()), 30.0 + 1e-9);
            EXPECT_LE(std::abs(point.at(1).get<double>()), 30.0 + 1e-9);
            EXPECT_LE(std::abs(point.at(2).get<double>()), 21.0 + 1e-9);
        }
    }
    const Ended planned = run({"plan", path("probe.json"), "--out", path("plan")});
    EXPECT_EQ(planned.exit_code, 0) << planned.err;
    const Ended cloud = run({"import", path("probe.txt"), "--out", path("cloud.json"), "--cloud"});
    ASSERT_EQ(cloud.exit_code, 0) << cloud.err;
    EXPECT_THAT(cloud.out, HasSubstr("16 points, no rows (point cloud)\npatch of degree 3 x 3\n"));
    EXPECT_THAT(cloud.out,
                testing::ContainsRegex("points to surface: at most [0-9.e-]+ mm \\(line [0-9]+\\), "));
    write_content(path("comma.csv"), "1,5;2,5;3\n");
    const Ended comma = run({"import", path("comma.csv"), "--out", path("comma.json")});
    EXPECT_EQ(comma.exit_code, 1);
    EXPECT_THAT(comma.err, HasSubstr("comma.csv:1: '1,5' has a decimal comma"));
    EXPECT_EQ(run({"import", "assets/samples/cover.step", "--cloud"}).exit_code, 2);
}

// Of more than 6 x 6 points the first of many patches was machined.
TEST_F(ImportCommand, AllOfManyPointsInRowsIsMachined) {
    std::string text;
    for (int x = 0; x < 7; ++x) {
        for (int y = 0; y < 5; ++y) {
            text += fmt::format("{} {} {}\n", 10 * x, 12 * y, x * (6 - x) * 0.5 + y * (4 - y) * 0.5);
        }
    }
    write_content(path("probe.txt"), text);
    const Ended made = run({"import", path("probe.txt"), "--out", path("probe.json")});
    ASSERT_EQ(made.exit_code, 0) << made.err;
    EXPECT_EQ(made.err.find("only the first"), std::string::npos) << made.err;
    EXPECT_THAT(made.out, HasSubstr("35 points, 7 rows of 5 points\npoints to surface: at most "));
    EXPECT_THAT(made.out, HasSubstr("exact face of degree 3 x 4, 4 x 1 spans\n"));
    const std::string tool = "assets/tools/ball-6.json";
    const Ended planned = run({"plan", path("probe.json"), "--tool", tool, "--out", path("plan")});
    EXPECT_EQ(planned.exit_code, 0) << planned.err;
}

TEST_F(ImportCommand, MeshIsFittedAndTheDeviationTold) {
    const std::string file = exported("dome.stl");
    const Ended ended = run({"import",
                             file,
                             "--out",
                             path("fit.json"),
                             "--degree",
                             "3x3",
                             "--deviation",
                             path("deviation.csv"),
                             "--json"});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const nlohmann::json told = nlohmann::json::parse(ended.out);
    EXPECT_EQ(told.at("fit").at("degree"), (nlohmann::json{3, 3}));
    EXPECT_TRUE(told.at("fit").at("follows_outline"));
    EXPECT_LT(told.at("fit").at("max_mm"), 0.06); // the triangles lie up to 0.02 mm below the points
    EXPECT_LT(told.at("fit").at("patch_max_mm"), 0.1);
    EXPECT_GT(told.at("fit").at("patch_max_mm"), told.at("fit").at("patch_mean_mm"));
    EXPECT_THAT(content_of(path("deviation.csv")), ::testing::StartsWith("x_mm,y_mm,z_mm,deviation_mm\n"));
}

TEST_F(ImportCommand, UnitOfAStepFileIsTheFilesOwn) {
    const std::string file = exported("dome.step");
    for (const auto& words :
         {std::vector<std::string>{"import", file, "--unit", "inch"},
          std::vector<std::string>{"import", file, "--face", "1", "--unit", "mm", "--out", path("u.json")}}) {
        const Ended ended = run(words);
        EXPECT_EQ(ended.exit_code, 2);
        EXPECT_THAT(ended.err, HasSubstr("--unit applies only to a mesh"));
    }
    EXPECT_FALSE(std::filesystem::exists(path("u.json")));
}

TEST_F(ImportCommand, WithoutOutItTellsOfTheFile) {
    const Ended faces = run({"import", exported("dome.step")});
    ASSERT_EQ(faces.exit_code, 0) << faces.err;
    EXPECT_THAT(faces.out, HasSubstr("1 x 1"));
    EXPECT_THAT(faces.out, HasSubstr("3 x 3"));
    EXPECT_THAT(faces.out, HasSubstr("unit of the file: mm"));
    const Ended mesh = run({"import", exported("dome.ply", "1"), "--unit", "inch", "--json"});
    ASSERT_EQ(mesh.exit_code, 0) << mesh.err;
    EXPECT_NEAR(nlohmann::json::parse(mesh.out).at("size_mm")[0], 80.0 * 25.4, 0.01);
}

// The last triangles of the file were left out without a word.
TEST_F(ImportCommand, TrianglesBehindThoseThatAMeshCountsAreTold) {
    std::string bytes = content_of(exported("dome.stl"));
    std::uint32_t count = 0;
    std::memcpy(&count, bytes.data() + 80, sizeof count);
    count -= 3;
    std::memcpy(bytes.data() + 80, &count, sizeof count);
    const std::string mesh = written("counted.stl", bytes);
    const auto sentence = fmt::format(
        "150 bytes after the {} triangles declared in the header are ignored: enough for 3 more", count);
    EXPECT_THAT(run({"import", mesh}).err, HasSubstr("note: " + sentence));
    const Ended ended = run({"import", mesh, "--out", path("counted.json"), "--json"});
    EXPECT_THAT(ended.err, HasSubstr("note: " + sentence));
    EXPECT_THAT(nlohmann::json::parse(ended.out).at("notes")[0], HasSubstr(sentence));
}

// A control point was reported, and no file.
TEST_F(ImportCommand, AMeshThatIsTooFarAwayIsRefusedByItsName) {
    const std::string mesh =
        written("big.obj", "v 0 0 0\nv 200000 0 0\nv 0 10 0\nv 200000 10 1\nf 1 2 4\nf 1 4 3\n");
    const Ended ended = run({"import", mesh, "--out", path("p.json")});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(
        ended.err,
        HasSubstr("big.obj: a point of the mesh is 200000 mm from the origin, farther than 100000 mm"));
    EXPECT_FALSE(std::filesystem::exists(path("p.json")));
}

// They were fitted to noise, and cut.
TEST_F(ImportCommand, APartOfAWrongUnitIsToldOrRefusedWithItsSize) {
    const std::string plate = "v 0 0 0\nv 8e-3 0 0\nv 8e-3 5e-3 0\nv 0 5e-3 0\nf 1 2 3 4\n";
    const std::string mesh = written("metres.obj", plate);
    const auto doubt = HasSubstr("note: the whole part is only 0.008 mm in size: check the unit; in inches "
                                 "the size would be 0.203 mm, in metres 8 mm");
    EXPECT_THAT(run({"import", mesh}).err, doubt);
    EXPECT_THAT(run({"import", mesh, "--out", path("p.json")}).err, doubt);
    EXPECT_THAT(run({"import", mesh, "--out", path("m.json"), "--unit", "m"}).err,
                ::testing::Not(HasSubstr("unit")));
    const std::string small =
        written("small.obj", "v 0 0 0\nv 5e-6 0 0\nv 5e-6 5e-6 0\nv 0 5e-6 0\nf 1 2 3 4\n");
    const Ended ended = run({"import", small, "--out", path("s.json")});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(
        ended.err,
        HasSubstr("small.obj: the mesh is 5e-06 mm in size, below the minimum of 0.001 mm (check the unit"));
    EXPECT_FALSE(std::filesystem::exists(path("s.json")));
}

// A file that names its unit was asked whether it was in inches, of each of its faces for itself.
TEST_F(ImportCommand, ASmallModelOfCadIsAskedAboutTheUnitThatItsFileNames) {
    (void)run({"export", "assets/projects/dome.json", "--out", path("dome.step")});
    std::ostringstream read;
    read << std::ifstream(path("dome.step")).rdbuf();
    std::string text = read.str();
    const std::string milli = "SI_UNIT(.MILLI.,.METRE.)";
    ASSERT_NE(text.find(milli), std::string::npos);
    text.replace(text.find(milli), milli.size(), "SI_UNIT(.MICRO.,.METRE.)");
    const std::string small = written("small.step", text);
    const auto doubt = HasSubstr("mm in size: check the unit; the file names micrometre");
    EXPECT_THAT(run({"import", small}).err, doubt);
    EXPECT_THAT(run({"import", small, "--out", path("p.json")}).err, doubt);
}

TEST_F(ImportCommand, SaysWhatIsWrong) {
    const auto refusal = [&](const std::vector<std::string>& arguments) {
        const Ended ended = run(arguments);
        EXPECT_NE(ended.exit_code, 0);
        return ended.err;
    };
    const std::string broken = written("broken.step", "ISO-10303-21;\nHEADER;\n");
    EXPECT_THAT(refusal({"import", broken, "--out", path("p.json")}), HasSubstr("broken.step: "));
    EXPECT_FALSE(std::filesystem::exists(path("p.json")));
    EXPECT_THAT(refusal({"import", written("a.doc", "x")}),
                HasSubstr("a.doc: this type of file cannot be imported"));
    EXPECT_THAT(refusal({"import", exported("d.step"), "--out", path("p.json"), "--face", "7"}),
                HasSubstr("no usable face 7"));
    EXPECT_THAT(refusal({"import", exported("e.step"), "--out", path("p.json"), "--degree", "40"}),
                HasSubstr("'40' is not a degree"));
    EXPECT_THAT(refusal({"export", "assets/projects/dome.json", "--out", path("dome.dwg")}),
                HasSubstr("dome.dwg: a design cannot be written"));
}

} // namespace
} // namespace millwright::test
