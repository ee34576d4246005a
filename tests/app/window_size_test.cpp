// The real program on a display, twice.
#include "tests/app/program.h"
#include "tests/app/shell.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

namespace millwright::test {
namespace {

/// Opens the workbench, does `what` with its window $id, and quits it by Ctrl+Q.
std::string one_run(const std::string& what) {
    return "'" + program_file().string() +
           "' & program=$!; "
           "id=$(timeout 60 xdotool search --sync --onlyvisible --name ' - Millwright$' | tail -1); " +
           what +
           "; xdotool windowfocus --sync $id; xdotool key ctrl+q; "
           "for n in $(seq 300); do kill -0 $program 2>/dev/null || break; sleep 0.1; done; "
           "kill -9 $program 2>/dev/null && echo still open; wait $program; ";
}

TEST(WindowOnDisplay, OpensAsLargeAsItWasClosed) {
    if (std::getenv("DISPLAY") == nullptr) {
        GTEST_SKIP() << "NOT TESTED: there is no DISPLAY; run the tests under xvfb-run";
    }
    const ScratchFolder scratch;
    const std::string size = "xdotool getwindowgeometry $id | grep Geometry";
    const ShellRun run =
        shell(scratch.path(), one_run("xdotool windowsize --sync $id 1100 650; sleep 1") + one_run(size));
    EXPECT_NE(run.output.find("Geometry: 1100x650"), std::string::npos) << run.output;
    EXPECT_EQ(run.output.find("still open"), std::string::npos) << run.output;
}

} // namespace
} // namespace millwright::test
