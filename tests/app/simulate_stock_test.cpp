// The stock that a project has, as `millwright simulate` takes it.
#include "tests/app/box_file.h"
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <fstream>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// `project` with a stock of its own.
void take_stock(const fs::path& project, const nlohmann::json& stock) {
    auto json = nlohmann::ordered_json::parse(content_of(project));
    json["stock"] = stock;
    std::ofstream(project) << json.dump();
}

TEST(SimulateStock, CutsAProjectFromItsOwnStock) {
    const ScratchFolder scratch;
    const fs::path project = small_project(scratch.path(), "dome");
    const auto cut = [&](std::vector<std::string> more) {
        std::vector<std::string> all{"simulate",
                                     project,
                                     "--tool",
                                     "assets/tools/ball-6.json",
                                     "--resolution",
                                     "4",
                                     "--out",
                                     scratch / "out"};
        all.insert(all.end(), more.begin(), more.end());
        return run(all);
    };
    take_stock(project, {{"allowance_mm", 5}});
    EXPECT_THAT(cut({}).out, HasSubstr("the box of the surface and 5 mm on every side"));
    take_stock(project, {{"around_part", false}, {"shape", "box:120,120,40@-10,-10,-20"}});
    EXPECT_THAT(cut({}).out, HasSubstr("box 120 x 120 x 40 mm"));
    EXPECT_THAT(cut({"--stock", "box:130,130,40@-10,-10,-20"}).out, HasSubstr("box 130 x 130 x 40 mm"));
    take_stock(project, {{"around_part", false}, {"shape", "brick"}});
    const Ended wrong = cut({});
    EXPECT_EQ(wrong.exit_code, 1);
    EXPECT_THAT(wrong.err, testing::AllOf(HasSubstr("dome"), HasSubstr("stock: "), HasSubstr("brick")));
}

TEST(SimulateStock, TheMeshOfAProjectsStockIsNotReplaced) {
    const ScratchFolder scratch;
    const fs::path out = scratch / "out";
    fs::create_directories(out);
    const fs::path mesh = box_file(out / "cut.stl", {-10.0, -10.0, -20.0}, {110.0, 110.0, 30.0});
    const fs::path project = small_project(scratch.path(), "dome");
    take_stock(project, {{"around_part", false}, {"file", fs::relative(mesh, scratch.path()).string()}});
    const std::string before = content_of(mesh);
    std::vector<std::string> command{
        "simulate", project, "--tool", "assets/tools/ball-6.json", "--resolution", "4", "--out", out};
    const Ended refused = run(command);
    EXPECT_EQ(refused.exit_code, 1);
    EXPECT_THAT(refused.err, HasSubstr("is an input file"));
    EXPECT_EQ(content_of(mesh), before);
    command.back() = scratch / "other";
    const Ended ended = run(command);
    EXPECT_LE(ended.exit_code, 1);
    EXPECT_THAT(ended.out, HasSubstr("of cut.stl")) << ended.err;
}

} // namespace
} // namespace millwright::test
