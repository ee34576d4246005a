#include "core/project/recovery.h"

#include "core/base/files.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <optional>

namespace millwright::project {
namespace {

namespace fs = std::filesystem;

UnsavedWork unsaved_two_bell(std::string name, std::int64_t time_s = 1'000'000) {
    UnsavedWork result{project_from_preset("two-bell"), "/home/a \"b\"/part.json", time_s};
    result.project.name = std::move(name);
    result.project.grid.nu = 33;
    return result;
}

TEST(Recovery, ACopyReadsBackAsItWas) {
    const test::ScratchFolder scratch;
    write_file(scratch / "1.json", recovery_text(unsaved_two_bell("mine")));
    EXPECT_EQ(read_recovery(scratch / "1.json"), unsaved_two_bell("mine"));
}

TEST(Recovery, ACopyThatIsCutShortIsAnErrorWithItsPlace) {
    const test::ScratchFolder scratch;
    const std::string whole = recovery_text(unsaved_two_bell("mine"));
    for (const std::size_t size : {std::size_t{0}, whole.size() / 2, whole.size() - 3}) {
        write_file(scratch / "1.json", whole.substr(0, size));
        try {
            (void)read_recovery(scratch / "1.json");
            FAIL() << size;
        } catch (const Error& error) {
            EXPECT_EQ(error.diagnostic().place.file, scratch / "1.json");
        }
    }
}

TEST(Recovery, TheCopyOfARunningProgramIsNotOffered) {
    const test::ScratchFolder scratch;
    std::optional<RecoveryCopy> running(scratch.path());
    running->write(unsaved_two_bell("mine"));
    EXPECT_TRUE(left_behind(scratch.path()).empty());
    running.reset(); // the system takes the lock back, the copy stays
    const auto found = left_behind(scratch.path());
    ASSERT_EQ(found.size(), 1U);
    EXPECT_EQ(found.front().work(), unsaved_two_bell("mine"));
}

TEST(Recovery, TwoProgramsKeepACopyEach) {
    const test::ScratchFolder scratch;
    const RecoveryCopy one(scratch.path());
    const RecoveryCopy two(scratch.path());
    one.write(unsaved_two_bell("one"));
    two.write(unsaved_two_bell("two"));
    EXPECT_EQ(read_recovery(one.file()).project.name, "one");
    EXPECT_EQ(read_recovery(two.file()).project.name, "two");
}

TEST(Recovery, ANewProgramDoesNotWriteOverWhatWasLeftBehind) {
    const test::ScratchFolder scratch;
    const fs::path left = [&] {
        const RecoveryCopy crashed(scratch.path());
        crashed.write(unsaved_two_bell("left"));
        return crashed.file();
    }();
    const RecoveryCopy next(scratch.path());
    next.write(unsaved_two_bell("next"));
    EXPECT_EQ(read_recovery(left).project.name, "left");
}

TEST(Recovery, IsOfferedToOneProgramAtATime) {
    const test::ScratchFolder scratch;
    write_file(scratch / "1.json", recovery_text(unsaved_two_bell("mine")));
    const auto first = left_behind(scratch.path());
    EXPECT_EQ(first.size(), 1U);
    EXPECT_TRUE(left_behind(scratch.path()).empty());
}

TEST(Recovery, TheNewestComesFirstAndABrokenOneLastWithItsFault) {
    const test::ScratchFolder scratch;
    write_file(scratch / "1.json", "{ \"format\": ");
    write_file(scratch / "2.json", recovery_text(unsaved_two_bell("old", 10)));
    write_file(scratch / "3.json", recovery_text(unsaved_two_bell("new", 20)));
    const auto found = left_behind(scratch.path());
    ASSERT_EQ(found.size(), 3U);
    EXPECT_EQ(found[0].work()->project.name, "new");
    EXPECT_EQ(found[1].work()->project.name, "old");
    EXPECT_FALSE(found[2].work().has_value());
    ASSERT_TRUE(found[2].fault().has_value());
    EXPECT_EQ(found[2].fault()->place.file, scratch / "1.json");
}

TEST(Recovery, WhatIsDiscardedDoesNotComeBack) {
    const test::ScratchFolder scratch;
    write_file(scratch / "1.json", recovery_text(unsaved_two_bell("mine")));
    left_behind(scratch.path()).front().discard();
    EXPECT_TRUE(left_behind(scratch.path()).empty());
}

TEST(Recovery, AFolderThatIsNotThereHoldsNothing) {
    const test::ScratchFolder scratch;
    EXPECT_TRUE(left_behind(scratch / "none").empty());
}

TEST(Recovery, AFolderThatCannotBeMadeIsAnError) {
    const test::ScratchFolder scratch;
    write_file(scratch / "file", "");
    EXPECT_THROW(RecoveryCopy(scratch / "file" / "recovery"), Error);
}

} // namespace
} // namespace millwright::project
