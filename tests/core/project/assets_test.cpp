#include "core/project/assets.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::project {
namespace {

namespace fs = std::filesystem;
using testing::Contains;
using testing::HasSubstr;

Project on_machine(std::string file) {
    Project project = project_from_preset("dome");
    project.machine.file = std::move(file);
    return project;
}

TEST(Assets, TheSourceTreesAreFoundFromATest) {
    EXPECT_TRUE(fs::is_regular_file(assets_folder() / "machines" / "ac-table.json"));
    EXPECT_THAT(machine_ids(assets_folder()), Contains("rotary-tilt-listing"));
    EXPECT_THAT(arm_ids(assets_folder()), Contains("motoman-l3"));
}

TEST(Assets, AreFoundAboveTheExecutable) {
    const test::ScratchFolder scratch;
    fs::create_directories(scratch / "share/assets/machines");
    EXPECT_EQ(assets_folder({{}, scratch / "share/build/release/millwright", {}}), scratch / "share/assets");
}

TEST(Assets, AreFoundWhereTheProgramIsInstalled) {
    const test::ScratchFolder scratch;
    fs::create_directories(scratch / "usr/share/millwright/assets/machines");
    EXPECT_EQ(assets_folder({{}, scratch / "usr/bin/millwright", {}}),
              scratch / "usr/share/millwright/assets");
}

TEST(Assets, TheUsersFolderComesBeforeAllOthers) {
    const test::ScratchFolder scratch;
    fs::create_directories(scratch / "mine/machines");
    fs::create_directories(scratch / "assets/machines");
    EXPECT_EQ(assets_folder({scratch / "mine", scratch / "millwright", {}}), scratch / "mine");
    EXPECT_THROW((void)assets_folder({scratch / "wrong", scratch / "millwright", scratch / "assets"}), Error);
}

TEST(Assets, MissingOnesAreAnErrorWithTheWayOut) {
    const test::ScratchFolder scratch;
    try {
        (void)assets_folder({{}, scratch / "millwright", scratch / "nothing"});
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.diagnostic().hint, HasSubstr("MILLWRIGHT_ASSETS"));
    }
}

TEST(Assets, AMachineIsAnIdOrAPathBesideTheProject) {
    const test::ScratchFolder scratch;
    write_file(scratch / "own.json", "{}");
    EXPECT_EQ(machine_path(on_machine("ac-table"), scratch.path(), "assets"),
              "assets/machines/ac-table.json");
    EXPECT_EQ(machine_path(on_machine("own.json"), scratch.path(), "assets"), scratch / "own.json");
}

TEST(Assets, AnUnknownMachineIsReportedWithTheKnownOnes) {
    try {
        (void)machine_path(on_machine("ac-tabel"), {}, "assets");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("unknown machine 'ac-tabel'"));
        EXPECT_THAT(error.diagnostic().hint,
                    HasSubstr("ac-table, bc-table-head, ca-head, forming-table, rotary-tilt-chapter3"));
    }
    try {
        (void)machine_path(on_machine("../none.json"), "folder", "assets");
        FAIL();
    } catch (const Error& error) {
        EXPECT_EQ(error.diagnostic().place.file, "folder/../none.json");
    }
}

} // namespace
} // namespace millwright::project
