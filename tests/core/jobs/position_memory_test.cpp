#include "core/jobs/position_memory.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "tests/core/drivers/grbl/wire_driver.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::jobs {
namespace {

using testing::HasSubstr;
using testing::IsEmpty;

class PositionMemoryOf : public testing::Test {
protected:
    test::ScratchFolder scratch;
    std::filesystem::path folder = scratch / "jobs";
    test::GrblWire wire;
    test::WireDriver driver{wire};

    [[nodiscard]] std::string doubt() const { return wire.session.status().position_doubt; }
    /// As a program that has just been started.
    [[nodiscard]] PositionMemory memory(const std::string& controller = "grbl /dev/ttyUSB0") const {
        return {folder, controller};
    }
    void trust() {
        driver.trust_position();
        ASSERT_THAT(doubt(), IsEmpty());
    }
};

TEST_F(PositionMemoryOf, AnEmptyFolderKnowsOfNoDoubtAndStaysEmptyWithoutOne) {
    trust();
    PositionMemory now = memory();
    now.remind(driver);
    now.keep(driver.status());
    EXPECT_THAT(doubt(), IsEmpty());
    EXPECT_FALSE(std::filesystem::exists(folder));
}

TEST_F(PositionMemoryOf, AControllerIsRemindedOfWhatWasInDoubt) {
    driver.doubt_position("the controller was reset", true);
    memory().keep(driver.status());
    trust(); // as a session that knows nothing of it
    memory("grbl /dev/ttyUSB1").remind(driver);
    EXPECT_THAT(doubt(), IsEmpty());
    memory().remind(driver);
    EXPECT_EQ(doubt(), "the controller was reset");
}

TEST_F(PositionMemoryOf, WhatHappenedIsToldAndNotHowTheControllerWasFound) {
    driver.doubt_position("the controller was reset", true);
    memory().keep(driver.status());
    driver.doubt_position("Grbl was found locked", true);
    memory().remind(driver);
    EXPECT_EQ(doubt(), "the controller was reset");
}

TEST_F(PositionMemoryOf, ADoubtThatHasEndedIsForgotten) {
    driver.doubt_position("the controller was reset", true);
    PositionMemory now = memory();
    now.keep(driver.status());
    trust();
    now.keep(driver.status());
    memory().remind(driver);
    EXPECT_THAT(doubt(), IsEmpty());
    EXPECT_TRUE(std::filesystem::is_empty(folder));
}

/// Nothing is known of a machine then, and certainly not that all is well.
TEST_F(PositionMemoryOf, ADisconnectedDriverEndsNoDoubt) {
    driver.doubt_position("the controller was reset", true);
    PositionMemory now = memory();
    now.keep(driver.status());
    now.keep(drivers::DriverStatus{});
    trust();
    memory().remind(driver);
    EXPECT_EQ(doubt(), "the controller was reset");
}

TEST_F(PositionMemoryOf, AFileThatCannotBeReadIsADoubt) {
    driver.doubt_position("the controller was reset", true);
    memory().keep(driver.status());
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        write_file(entry.path(), R"({"format": "millwright-position-doubt", "version": 1)");
    }
    trust();
    PositionMemory now = memory();
    now.remind(driver);
    EXPECT_THAT(doubt(), HasSubstr("cannot be read"));
    trust();
    now.keep(driver.status());
    EXPECT_TRUE(std::filesystem::is_empty(folder));
}

TEST_F(PositionMemoryOf, WhatCannotBeWrittenIsToldOnce) {
    write_file(folder, "a file where the folder should be");
    driver.doubt_position("the controller was reset", true);
    PositionMemory now = memory();
    EXPECT_THROW(now.keep(driver.status()), Error);
    EXPECT_NO_THROW(now.keep(driver.status()));
    EXPECT_EQ(doubt(), "the controller was reset");
}

TEST_F(PositionMemoryOf, ADoubtIsRememberedAsWhatItWas) {
    for (const bool lost : {true, false}) {
        driver.doubt_position("not confirmed since Grbl was at zero", lost);
        memory().keep(driver.status());
        trust();
        memory().remind(driver);
        EXPECT_EQ(wire.session.status().position_lost, lost);
    }
}

/// As after a broken link or a kill: the program that ran there has no end.
TEST_F(PositionMemoryOf, AControllerThatWasResetWhileAProgramRanHasLostItsPosition) {
    trust();
    wire.start("G1 X50 F100\n");
    PositionMemory before = memory();
    before.keep(driver.status());
    wire.cut();
    wire.run_until([] { return false; }, 0.5);
    before.keep(driver.status()); // the link is lost
    test::GrblWire fresh;         // at zero, as after it was switched on
    test::WireDriver found(fresh);
    ASSERT_FALSE(fresh.session.status().position_lost);
    memory().remind(found);
    EXPECT_THAT(fresh.session.status().position_doubt,
                HasSubstr("the machine was running when it was last connected"));
    EXPECT_TRUE(fresh.session.status().position_lost);
}

TEST_F(PositionMemoryOf, AProgramThatCameToItsEndLeavesNothing) {
    trust();
    PositionMemory now = memory();
    wire.start("G1 X5 F1000\n");
    now.keep(driver.status());
    EXPECT_FALSE(std::filesystem::is_empty(folder));
    wire.run_to_end();
    now.keep(driver.status());
    EXPECT_TRUE(std::filesystem::is_empty(folder));
    wire.start("G1 X9 F100\n");
    now.keep(driver.status());
    memory().remind(driver); // it is found where it was, and its position is right
    EXPECT_THAT(doubt(), IsEmpty());
}

} // namespace
} // namespace millwright::jobs
