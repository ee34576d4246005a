// The emulated controllers as programs of their own, at the other end of a pseudo-terminal.
#include "tests/app/emulator.h"
#include "tests/app/program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <csignal>

namespace millwright::test {
namespace {

using testing::HasSubstr;

constexpr const char* square = "G21 G90 G94\nG1 X20 F3000\nY20\nX0\nY0\nM2\n";

struct Emulate : testing::Test {
    ScratchFolder scratch;
    std::string port = (scratch / "port").string();
    std::string logs = (scratch / "logs").string();

    [[nodiscard]] Ended send_square() const {
        write_content(scratch / "square.ngc", square);
        return run({"send",
                    (scratch / "square.ngc").string(),
                    "--driver",
                    "linuxcnc",
                    "--port",
                    port,
                    "--log",
                    logs});
    }
};

TEST_F(Emulate, ALinuxCncRunsWhatIsSent) {
    Emulator emulator(port, {"--homed", "--speed", "10"}, "linuxcnc");
    const Ended ended = send_square();
    EXPECT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, HasSubstr("Connected to LinuxCNC at " + port));
    EXPECT_THAT(ended.out, HasSubstr("All 6 blocks were executed"));
    const Ended emulated = emulator.stop();
    EXPECT_EQ(emulated.exit_code, 0);
    EXPECT_THAT(emulated.out, HasSubstr("LinuxCNC at " + port));
}

TEST_F(Emulate, ALinuxCncInItsEmergencyStopTakesNothing) {
    Emulator emulator(port, {}, "linuxcnc");
    const Ended ended = send_square();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("emergency stop"));
}

TEST_F(Emulate, ALinuxCncWhoseEmergencyStopIsPressedEndsTheJob) {
    Emulator emulator(port, {"--homed", "--faults", "alarm=6000"}, "linuxcnc");
    const Ended ended = send_square();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.out, HasSubstr("Fault: emergency stop"));
}

TEST_F(Emulate, AMachineGoesWhereACoordinateStreamSaysAndTellsAtItsEnd) {
    Emulator emulator(port, {}, "stream");
    const auto project = small_project(scratch.path(), "two-bell");
    Program runner({"run", project, "--driver", "stream", "--port", port, "--log", logs, "--period", "0.02"});
    runner.wait_for_error_text("Block "); // the whole program would take minutes
    runner.send(SIGINT);
    const Ended ended = runner.end();
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.out, HasSubstr("The job was cancelled"));
    const Ended emulated = emulator.stop();
    EXPECT_EQ(emulated.exit_code, 0);
    EXPECT_THAT(emulated.out, HasSubstr(" samples\n"));
    EXPECT_THAT(emulated.out, HasSubstr(", at most "));
    EXPECT_THAT(emulated.out, testing::Not(HasSubstr("were no samples")));
}

} // namespace
} // namespace millwright::test
