// Run is not offered where it would be refused, and says why.
#include "core/base/files.h"
#include "tests/support/scratch_folder.h"
#include "tests/ui/person/person.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace millwright::panels {
namespace {

using test::Person;
using testing::HasSubstr;

TEST(RunOfTheVirtualMachine, IsRefusedForWhatTheMachineCannotDo) {
    Person person;
    const auto refusal = [&](const std::string& program) {
        write_file(person.folder() / "part.ngc", program);
        person.open(person.folder() / "part.ngc");
        person.wait_idle();
        person.app().run("view.machine");
        person.frames(2);
        person.wait_idle();
        person.frames(2);
        return person.refusal("inspector/job/machine_run");
    };
    EXPECT_THAT(refusal("G21 G90\nG1 X10 A30 B5 F100\nM2\n"),
                HasSubstr("part.ngc:2:8: the machine 'XYZ router' has no axis A"));
    EXPECT_THAT(refusal("G21 G90\nG1 X9000 F100\nG0 X0\nM2\n"), HasSubstr("part.ngc:2"));
    EXPECT_THAT(refusal("G21 G90\nG1 X9 F\nG0 X0\nM2\n"), HasSubstr("part.ngc:2:"));
    EXPECT_EQ(refusal("G21 G90\nG1 X9 F100\nG0 X0\nM2\n"), "");
}

TEST(RunOfTheVirtualMachine, TheNoteOfAFailureGoesWithItsProgram) {
    const test::ScratchFolder folder;
    const auto blocked = folder / "jobs";
    write_file(blocked, "a file where the folder of the logs should be");
    Person person({1280, 800}, {}, blocked);
    const auto open = [&](const std::string& name) {
        write_file(person.folder() / name, "G21 G90\nG1 X9 F1000\nG0 X0\nM2\n");
        person.open(person.folder() / name);
        person.wait_idle();
        person.app().run("view.machine");
        person.frames(2);
    };
    const std::string note = "inspector/job/failure";
    open("a.ngc");
    person.click("inspector/job/machine_run");
    person.wait_idle();
    person.frames(2);
    ASSERT_TRUE(person.sees(note));
    open("b.ngc");
    EXPECT_FALSE(person.sees(note));
    EXPECT_FALSE(person.app().look().job.failure);
}

} // namespace
} // namespace millwright::panels
