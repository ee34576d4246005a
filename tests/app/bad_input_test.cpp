#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace millwright::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::StartsWith;

/// Planning into a folder with an old program: it must fail with one line and leave the old one.
class BadInput : public testing::Test {
protected:
    ScratchFolder scratch;

    void SetUp() override {
        fs::create_directories(scratch / "out");
        write_content(scratch / "out/program.ngc", "old");
    }

    [[nodiscard]] std::string failure_of(const fs::path& project, const fs::path& out) const {
        const Ended ended = run({"plan", project, "--out", out});
        EXPECT_EQ(ended.exit_code, 1) << ended.err;
        EXPECT_EQ(ended.out, "");
        EXPECT_EQ(content_of(scratch / "out/program.ngc"), "old");
        EXPECT_FALSE(fs::exists(scratch / "out/report.json"));
        const auto begin = ended.err.find("millwright: ");
        EXPECT_NE(begin, std::string::npos) << ended.err;
        const std::string said = begin == std::string::npos ? ended.err : ended.err.substr(begin);
        EXPECT_EQ(std::count(said.begin(), said.end(), '\n'), 1) << said;
        return said;
    }
    [[nodiscard]] std::string failure_of(const fs::path& project) const {
        return failure_of(project, scratch / "out");
    }
    /// Of the dome's project with `from` replaced by `to`.
    [[nodiscard]] std::string failure_with(const std::string& from, const std::string& to) const {
        return failure_of(small_project(scratch.path(), "dome", from, to));
    }
    [[nodiscard]] std::string place() const { return "millwright: " + (scratch / "dome.json").string(); }
};

TEST_F(BadInput, AMissingProject) {
    EXPECT_EQ(failure_of("no/such.json"),
              "millwright: no/such.json: cannot read: No such file or directory\n");
    EXPECT_THAT(failure_of(scratch.path()), HasSubstr("Is a directory"));
}

TEST_F(BadInput, ABrokenProject) {
    write_content(scratch / "dome.json", "{\n  \"format\": \"millwright-project\",\n  nonsense\n}");
    EXPECT_THAT(failure_of(scratch / "dome.json"), StartsWith(place() + ":3:"));
    write_content(scratch / "dome.json", "");
    EXPECT_THAT(failure_of(scratch / "dome.json"), StartsWith(place() + ":1:1"));
    write_content(scratch / "dome.json", std::string("\x89PNG\r\n\0\0", 8));
    EXPECT_THAT(failure_of(scratch / "dome.json"), StartsWith(place() + ":1:"));
    write_content(scratch / "dome.json", content_of("assets/machines/ac-table.json"));
    EXPECT_THAT(failure_of(scratch / "dome.json"), StartsWith(place() + ":"));
}

TEST_F(BadInput, WrongTypes) {
    EXPECT_THAT(failure_with("\"nu\": 20", "\"nu\": \"20\""),
                AllOf(StartsWith(place() + ":"), HasSubstr("grid/nu: expected a number, found a text")));
    EXPECT_THAT(failure_with("\"flipped\": false", "\"flipped\": []"),
                HasSubstr("surface/flipped: expected true"));
    EXPECT_THAT(failure_with("[10, 10, 1]", "{}"),
                HasSubstr("surface/patches[0]/points[0][0]: expected a list"));
    EXPECT_THAT(failure_with("\"name\"", "\"nama\""), HasSubstr("the field \"nama\" is not known here"));
}

TEST_F(BadInput, ARegionInALine) {
    EXPECT_THAT(failure_with("\"adaptation\": 100",
                             "\"region\": {\"outline\": [[0, 0], [0.5, 0.5], [1, 1]]}, \"adaptation\": 100"),
                AllOf(StartsWith(place() + ":"),
                      HasSubstr("grid/elliptic/region/outline: the outline encloses no area")));
}

TEST_F(BadInput, NumbersThatAreNone) {
    EXPECT_THAT(failure_with("[10, 10, 1]", "[NaN, 10, 1]"), HasSubstr("not valid JSON near"));
    EXPECT_THAT(failure_with("[10, 10, 1]", "[1e999, 10, 1]"), HasSubstr("too large"));
    EXPECT_THAT(failure_with("[10, 10, 1]", "[1e30, 10, 1]"), HasSubstr("is not between"));
    EXPECT_THAT(failure_with("\"feed_mm_per_min\": 600", "\"feed_mm_per_min\": -1"),
                HasSubstr("program/feed_mm_per_min: -1 is not between"));
    EXPECT_THAT(failure_with("\"nu\": 20", "\"nu\": 1e9"), HasSubstr("grid/nu"));
}

TEST_F(BadInput, AnUnknownPreset) {
    EXPECT_THAT(failure_with("\"preset\": \"dome\"", "\"preset\": \"doom\""),
                AllOf(StartsWith(place() + ":6:"),
                      HasSubstr("unknown surface preset 'doom'"),
                      HasSubstr("two-bell")));
}

TEST_F(BadInput, AnUnknownMachine) {
    EXPECT_THAT(
        failure_with("rotary-tilt-listing", "lathe"),
        AllOf(StartsWith(place() + ": "), HasSubstr("unknown machine 'lathe'"), HasSubstr("ac-table")));
}

TEST_F(BadInput, AMissingOrBrokenMachineFile) {
    EXPECT_THAT(failure_with("rotary-tilt-listing", "own.json"), HasSubstr("no such machine file"));
    write_content(scratch / "own.json", "{\n \"format\": 5\n}");
    EXPECT_THAT(failure_with("rotary-tilt-listing", "own.json"),
                StartsWith("millwright: " + (scratch / "own.json").string() + ":2:"));
}

TEST_F(BadInput, ADegenerateNet) {
    write_content(scratch / "dome.json", R"({"format": "millwright-project", "version": 1, "name": "Point",
        "surface": {"patches": [{"points": [[[1,1,1],[1,1,1]],[[1,1,1],[1,1,1]]]}]},
        "machine": {"file": "ac-table"}})");
    EXPECT_THAT(
        failure_of(scratch / "dome.json"),
        AllOf(StartsWith(place() + ": "), HasSubstr("no normal at u = 0, v = 0"), HasSubstr("coincide")));
}

TEST_F(BadInput, APartOutOfReach) {
    EXPECT_THAT(failure_with("\"file\": \"rotary-tilt-listing\"",
                             "\"file\": \"ac-table\", \"workpiece_offset\": [0, 0, 5000]"),
                AllOf(StartsWith(place() + ": "), HasSubstr("cannot be reached"), HasSubstr("outside")));
}

TEST_F(BadInput, AFormulaWithoutSense) {
    EXPECT_THAT(failure_with("\"method\": \"tracks\",\n        \"elliptic\": {\n            \"weight\": "
                             "\"error\",\n            \"expression\": \"1 +",
                             "\"method\": \"elliptic\",\n        \"elliptic\": {\n            \"weight\": "
                             "\"expression\",\n            \"expression\": \"1 + * "),
                StartsWith(place() + ": grid/elliptic/expression, character 5: "));
}

TEST_F(BadInput, AFolderThatCannotBeWritten) {
    const fs::path project = small_project(scratch.path(), "dome");
    EXPECT_THAT(failure_of(project, scratch / "dome.json/out"),
                HasSubstr("dome.json/out: cannot create the folder"));
    EXPECT_THAT(failure_of(project, "/proc/millwright"),
                HasSubstr("/proc/millwright: cannot create the folder"));
    EXPECT_THAT(failure_of(project, "/proc"), HasSubstr("/proc: cannot write"));
}

TEST_F(BadInput, APlaceThatIsTaken) {
    fs::create_directories(scratch / "taken/report.json");
    write_content(scratch / "taken/program.ngc", "old too");
    const fs::path project = small_project(scratch.path(), "dome");
    EXPECT_THAT(failure_of(project, scratch / "taken"),
                HasSubstr("report.json: cannot write: Is a directory"));
    EXPECT_EQ(content_of(scratch / "taken/program.ngc"), "old too");
}

TEST_F(BadInput, NoDisplayForTheWorkbench) {
    const Ended ended = run({"assets/projects/dome.json"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, AllOf(StartsWith("millwright: "), HasSubstr("display")));
}

TEST_F(BadInput, TheWorkbenchNamesABrokenProjectToo) {
    const Ended ended = run({"no/such.json"});
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, StartsWith("millwright: no/such.json: "));
}

} // namespace
} // namespace millwright::test
