// Every command that the README shows is run as it stands there.
#include "tests/app/emulator.h"
#include "tests/app/program.h"
#include "tests/app/shell.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cstdlib>
#include <filesystem>
#include <set>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

/// Those that install or build: scripts/try-package and .ci/run run them on bare machines.
const std::set<std::string> for_bare_machines = {
    "sudo apt install ./millwright_0.1.0-1~bookworm_amd64.deb",
    "millwright",
    "tar -xf millwright-0.1.0-x86_64.tar.gz",
    "millwright-0.1.0/bin/millwright",
    "scripts/run",
    "scripts/test",
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    if (const auto at = text.find(from); at != std::string::npos) {
        text.replace(at, from.size(), to);
    }
    return text;
}

const std::string built = "build/release/millwright";
const std::string workbench = built + " assets/projects/dome.json";

/// A checkout as the commands see it.
class Readme : public testing::Test {
protected:
    Readme() {
        fs::create_directories(checkout / "build/release");
        fs::create_symlink(program_file(), checkout / built);
        fs::create_symlink(fs::absolute("assets"), checkout / "assets");
    }
    ScratchFolder checkout;
};

TEST_F(Readme, ShowsOnlyCommandsThatWork) {
    write_content(checkout / "job.ngc", "G21 G90 G94\nG1 X1 Y1 F3000\nM30\n");
    const std::string port = (checkout / "ttyUSB0").string();
    const Emulator emulator(port, {"--speed", "20"});

    int tried = 0;
    for (const std::string& command : commands_of(content_of("README.md"))) {
        if (command == workbench || for_bare_machines.contains(command)) {
            continue;
        }
        ASSERT_THAT(command, testing::StartsWith(built)) << "no test runs this command";
        const ShellRun run = shell(checkout.path(), replaced(command, "/dev/ttyUSB0", port));
        EXPECT_EQ(run.exit_code, 0) << command << '\n' << run.output;
        ++tried;
    }
    EXPECT_GE(tried, 8);
    for (const char* made : {"program.ngc", "report.json", "preview.png", "error.png"}) {
        EXPECT_TRUE(fs::exists(checkout / "out" / made)) << made;
    }
}

TEST_F(Readme, OpensTheWorkbenchOnADisplay) {
    if (std::getenv("DISPLAY") == nullptr) {
        GTEST_SKIP() << "NOT TESTED: there is no DISPLAY; run the tests under xvfb-run";
    }
    ASSERT_THAT(commands_of(content_of("README.md")), testing::Contains(workbench));
    // The title names the project once a frame has been shown. In the end the window is asked to close.
    const ShellRun run =
        shell(checkout.path(),
              workbench + " & timeout 60 xdotool search --sync --name '^dome.json - Millwright'; "
                          "seen=$?; kill -TERM $!; wait $!; exit $seen");
    EXPECT_EQ(run.exit_code, 0) << run.output;
}

TEST(ReadmeCommands, AreThoseOfTheShellBlocksInTheirOrder) {
    EXPECT_THAT(commands_of("text\n```sh\na b   # why\n\nc\n```\n```\nd\n```\n"),
                testing::ElementsAre("a b", "c"));
}

} // namespace
} // namespace millwright::test
