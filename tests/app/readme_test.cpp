// Every command that the README shows is run as it stands there.
#include "tests/app/guide.h"
#include "tests/app/program.h"
#include "tests/app/shell.h"

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

/// Those that install or build: scripts/try-package and .ci/run run them on bare machines.
const std::set<std::string> for_bare_machines = {
    "sudo apt install ./millwright_0.1.0-1~bookworm_amd64.deb",
    "cp -r /usr/share/millwright/assets .",
    "tar -xf millwright-0.1.0-x86_64.tar.gz",
    "millwright-0.1.0/bin/millwright",
    "scripts/run",
    "scripts/run --headless --out out",
};

const std::string workbench = "millwright assets/projects/dome.json";

class Readme : public Guide {};

TEST_F(Readme, ShowsOnlyCommandsThatWork) {
    std::vector<std::string> commands;
    for (const std::string& command : commands_of(content_of("README.md"))) {
        if (command == workbench || for_bare_machines.contains(command)) {
            continue;
        }
        EXPECT_THAT(command, testing::StartsWith("millwright ")) << "no test runs this command";
        commands.push_back(command);
    }
    EXPECT_GE(follow(commands), 12);
    for (const char* made : {"program.ngc", "report.json", "preview.png"}) {
        EXPECT_TRUE(fs::exists(checkout / "out" / made)) << made;
    }
}

TEST_F(Readme, OpensTheWorkbenchOnADisplay) {
    if (std::getenv("DISPLAY") == nullptr) {
        GTEST_SKIP() << "NOT TESTED: there is no DISPLAY; run the tests under xvfb-run";
    }
    ASSERT_THAT(commands_of(content_of("README.md")), testing::Contains(workbench));
    // The title names the project once a frame has been shown. In the end the window is asked to close.
    const ShellRun run = shell(checkout.path(),
                               "build/release/" + workbench +
                                   " & timeout 60 xdotool search --sync --name '^dome.json - Millwright'; "
                                   "seen=$?; kill -TERM $!; wait $!; exit $seen");
    EXPECT_EQ(run.exit_code, 0) << run.output;
}

/// What `plan` prints of the dome, as the README says it.
TEST_F(Readme, HasTheFiguresOfTheDome) {
    const Ended ended = run({"plan", "assets/projects/dome.json", "--out", (checkout / "figures").string()});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    EXPECT_THAT(ended.out, testing::ContainsRegex("uniform +6\\.87"));
    EXPECT_THAT(ended.out, testing::ContainsRegex("tracks +0\\.59"));
    EXPECT_THAT(ended.out, testing::HasSubstr("400 points"));
    for (const char* figure : {"6.88 mm", "0.59 mm", "400 points"}) {
        EXPECT_THAT(content_of("README.md"), testing::HasSubstr(figure));
    }
}

TEST(ReadmeCommands, AreThoseOfTheShellBlocksInTheirOrder) {
    EXPECT_THAT(commands_of("text\n```sh\na b   # why\n\nc\n```\n```\nd\n```\n"),
                testing::ElementsAre("a b", "c"));
}

} // namespace
} // namespace millwright::test
