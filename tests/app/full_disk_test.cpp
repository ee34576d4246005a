// A disk that is full while a job runs.
#include "tests/app/emulator.h"
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"
#include "tests/support/small_disk.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::test {
namespace {

using testing::AllOf;
using testing::HasSubstr;

TEST(FullDisk, StopsAJobWhoseLogCannotBeWrittenAndJobsSaysSo) {
    const ScratchFolder scratch;
    const SmallDisk disk(scratch / "logs");
    if (!disk.mounted()) {
        GTEST_SKIP() << "needs the right to mount";
    }
    std::string text = "G21 G90 G94\nG1 Z0 F600\n";
    constexpr int lines = 60;
    for (int n = 0; n < lines; ++n) {
        text += n % 2 == 0 ? "X10\n" : "X0\n";
    }
    write_content(scratch / "long.ngc", text + "M30\n");
    const std::string port = scratch / "grbl", logs = scratch / "logs";
    Emulator emulator(port);
    Program sending({"send",
                     scratch / "long.ngc",
                     scratch / "long.ngc",
                     "--driver",
                     "grbl",
                     "--port",
                     port,
                     "--log",
                     logs});
    sending.wait_for_error_text("Block ");
    disk.fill();
    const Ended ended = sending.end();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err,
                AllOf(HasSubstr("the job was stopped at block "),
                      HasSubstr(" of 63 because its log cannot be written: No space left on device; ")));
    const Ended jobs = run({"jobs", logs});
    EXPECT_EQ(jobs.exit_code, 0) << jobs.err;
    EXPECT_THAT(jobs.out, AllOf(HasSubstr("fault after "), HasSubstr(" of 63 because its log cannot be")));
}

} // namespace
} // namespace millwright::test
