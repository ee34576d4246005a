// scripts/setup, scripts/run, scripts/fresh and .ci/run beside programs that answer as a computer without
// network, root, disk or time would.
#include "tests/app/program.h"
#include "tests/app/shell.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <string>
#include <string_view>

namespace millwright::test {
namespace {

namespace fs = std::filesystem;
using testing::AllOf;
using testing::HasSubstr;
using testing::Not;

/// A checkout with the scripts alone, and a folder of programs that come before those of the computer.
class Scripts : public ::testing::Test {
protected:
    ScratchFolder scratch;
    const fs::path checkout = scratch / "my checkout \u00fc";

    Scripts() {
        fs::create_directories(checkout / "scripts");
        fs::create_directories(checkout / ".ci");
        fs::create_directories(scratch / "bin");
        for (const char* const script : {"scripts/setup",
                                         "scripts/run",
                                         "scripts/build",
                                         "scripts/test",
                                         "scripts/fresh",
                                         "scripts/package",
                                         "scripts/packages.txt",
                                         ".ci/run"}) {
            fs::copy_file(script, checkout / script);
        }
    }

    /// A program that is found first.
    void install(const std::string& name, const std::string& lines) {
        write_program(scratch / "bin" / name, lines);
    }
    void write_program(const fs::path& file, const std::string& lines) {
        write_content(file, "#!/bin/bash\n" + lines + "\n");
        fs::permissions(file, fs::perms::owner_all);
    }
    [[nodiscard]] ShellRun in_checkout(const std::string& command) {
        // The continuous integration runs these tests, too, perhaps with a turn of its own.
        return shell(checkout,
                     "unset MILLWRIGHT_CI_TURN MILLWRIGHT_CI_MINUTES MILLWRIGHT_TEST_SHARE; export PATH='" +
                         (scratch / "bin").string() + "':\"$PATH\"; " + command);
    }
};

class SetUp : public Scripts {
protected:
    SetUp() {
        install("dpkg-query", "exit 1"); // nothing is installed
        install("apt-cache", "exit 0");
        install("id", "echo 0");
    }
};

TEST_F(SetUp, SaysWhatRootHasToRun) {
    install("id", "echo 1000");
    install("sudo", "exit 1");
    install("apt-get", "echo must not be run; exit 1");
    const ShellRun run = in_checkout("scripts/setup fresh");
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_THAT(run.output,
                AllOf(HasSubstr("needs root or sudo. As root run:\n"
                                "apt-get update && apt-get install --no-install-recommends debootstrap\n"),
                      Not(HasSubstr("must not be run"))));
}

TEST_F(SetUp, SaysThatThereIsNoNetwork) {
    install("apt-get", R"(case "$*" in
*--simulate*) exit 0 ;;
update*) exit 0 ;;
*) echo "E: Temporary failure resolving 'deb.debian.org'" >&2; exit 100 ;;
esac)");
    const ShellRun run = in_checkout("scripts/setup fresh");
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_THAT(run.output, HasSubstr("Temporary failure resolving"));
    EXPECT_THAT(run.output, HasSubstr("could not be fetched or installed: check the network connection"));
}

// Of a disk that was full while apt read its lists, it said that there was no network.
TEST_F(SetUp, SaysThatTheDiskIsFullWhateverAptWasDoing) {
    for (const char* const what : {"*", "update*", "install*"}) {
        install("apt-get",
                std::string("case \"$*\" in\n") + what +
                    ") echo 'E: Write error - write (28: No space left on device)' >&2; exit 100 ;;\n"
                    "*--simulate*) exit " +
                    (std::string_view(what) == "install*" ? "0" : "1") + " ;;\nesac");
        const ShellRun run = in_checkout("scripts/setup fresh");
        EXPECT_EQ(run.exit_code, 1) << what;
        EXPECT_THAT(run.output, HasSubstr("the disk is full. Free up to 2 GB")) << what;
    }
}

// Packages were installed for minutes before the build found that it could not write.
TEST_F(SetUp, IsNotBegunWhereTheBuildCannotWrite) {
    install("apt-get", "echo must not be run; exit 1");
    write_content(checkout / "build", "a file\n");
    write_content(checkout / "a.json", "{}\n");
    const ShellRun run = in_checkout("scripts/run a.json --headless --out out");
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_THAT(run.output,
                AllOf(HasSubstr("cannot write to "),
                      HasSubstr("clone the repository to a folder"),
                      Not(HasSubstr("must not be run"))));
    fs::remove(checkout / "build");
    write_content(checkout / "out", "a file\n");
    EXPECT_THAT(in_checkout("scripts/run a.json --headless --out out").output,
                HasSubstr("cannot write to the folder out: name another one with --out"));
}

TEST_F(SetUp, IsNotBegunWhereThePackageCannotBeWritten) {
    install("apt-get", "echo must not be run; exit 1");
    write_content(checkout / "out", "a file\n");
    const ShellRun out = in_checkout("scripts/package --out out");
    EXPECT_EQ(out.exit_code, 1);
    EXPECT_THAT(out.output,
                AllOf(testing::ContainsRegex(
                          "package: cannot write to the folder .*/out: name another one with --out"),
                      Not(HasSubstr("must not be run"))));
    fs::remove_all(checkout / "build");
    write_content(checkout / "build", "a file\n");
    const ShellRun build = in_checkout("scripts/package");
    EXPECT_EQ(build.exit_code, 1);
    EXPECT_THAT(
        build.output,
        AllOf(testing::ContainsRegex("package: cannot write to .*/build: clone the repository to a folder"),
              Not(HasSubstr("must not be run"))));
}

// The packages were installed and the format checked before.
TEST_F(Scripts, UnknownPresetsAreNamedAtOnce) {
    install("apt-get", "echo must not be run; exit 1");
    for (const char* const script : {"scripts/test", "scripts/build"}) {
        const ShellRun run = in_checkout(std::string(script) + " releas");
        EXPECT_NE(run.exit_code, 0) << script;
        EXPECT_THAT(run.output, HasSubstr("unknown preset 'releas': use release, debug, asan, tsan or fuzz"));
        EXPECT_THAT(run.output, Not(HasSubstr("must not be run"))) << script;
    }
}

TEST_F(Scripts, WarningsAreErrorsForDevelopersAlone) {
    install("df", "echo 9000");
    install("ninja", "exit 0");
    install("cmake", "case \"$*\" in --build*) echo 'a.cpp:1:2: warning: unused variable' ;; esac");
    EXPECT_EQ(in_checkout("scripts/build").exit_code, 0);
    const ShellRun all = in_checkout("scripts/build release all");
    EXPECT_EQ(all.exit_code, 1);
    EXPECT_THAT(all.output, HasSubstr("warnings count as errors here: see build/release/build.log"));
}

TEST_F(Scripts, ABuildThatTheDiskHasNoRoomForIsNotBegun) {
    install("df", "echo 12");
    install("ninja", "exit 0");
    install("cmake", "echo must not be run");
    const ShellRun run = in_checkout("scripts/build");
    EXPECT_EQ(run.exit_code, 1);
    EXPECT_THAT(run.output,
                AllOf(HasSubstr("only 12 MB are free in "),
                      HasSubstr("this build needs up to 700 MB"),
                      Not(HasSubstr("must not be run"))));
}

TEST_F(Scripts, FreshGoesOnOnlyInAMachineThatIsThere) {
    install("id", "echo 0");
    install("debootstrap", "echo must not be run; exit 1");
    const std::string there = "MILLWRIGHT_FRESH='" + (scratch / "cache").string() + "' ";
    EXPECT_THAT(
        in_checkout(there + "scripts/fresh --again bookworm true").output,
        AllOf(HasSubstr("no machine of an earlier run: leave out --again"), Not(HasSubstr("making a bare"))));
    EXPECT_THAT(in_checkout(there + "scripts/fresh bookworm true").output,
                HasSubstr("debootstrap failed, see "));
}

/// Every step writes down that it was run.
class Ci : public Scripts {
protected:
    Ci() {
        install("id", "echo 0");
        install("ctest", "echo ctest \"$@\" >>\"$LOG\"");
        for (const char* const step : {"setup", "fresh", "fuzz", "try-package", "test"}) {
            fs::remove(checkout / "scripts" / step);
            write_program(checkout / "scripts" / step,
                          std::string("echo ") + step +
                              " \"$@\" \"$MILLWRIGHT_TEST_SHARE\" >>\"$LOG\"\nmkdir -p build/release\n"
                              "echo \"$TESTS\" >build/release/ctest.log");
        }
    }
    /// `age`: hours since the turn was taken last.
    void stamp(const std::string& turn, int age) {
        ASSERT_EQ(shell(scratch.path(),
                        "mkdir -p cache/millwright-ci && touch -d '" + std::to_string(age) +
                            " hours ago' cache/millwright-ci/" + turn)
                      .exit_code,
                  0);
    }
    ShellRun ci(const std::string& settings = "") {
        write_content(scratch / "log", "");
        return in_checkout("export LOG='" + (scratch / "log").string() + "' XDG_CACHE_HOME='" +
                           (scratch / "cache").string() + "'; TESTS='100% tests passed' " + settings +
                           " .ci/run");
    }
    [[nodiscard]] std::string steps() const { return content_of(scratch / "log"); }
};

TEST_F(Ci, TakesTheTurnThatIsOldest) {
    stamp("tsan", 1);
    stamp("fuzz", 10);
    stamp("trixie", 90);
    stamp("asan", 40);
    const ShellRun first = ci();
    EXPECT_EQ(first.exit_code, 0) << first.output;
    EXPECT_THAT(steps(), HasSubstr("fresh trixie scripts/run --headless --out out"));
    EXPECT_THAT(steps(), Not(HasSubstr("asan")));
    EXPECT_THAT(steps(),
                AllOf(HasSubstr("test release"),
                      HasSubstr("fresh bookworm scripts/run --headless"),
                      HasSubstr("try-package"),
                      HasSubstr("ctest --preset long")));
    EXPECT_EQ(ci().exit_code, 0);
    EXPECT_THAT(steps(), HasSubstr("test asan 4\n"));
    EXPECT_THAT(steps(), Not(HasSubstr("trixie")));
}

TEST_F(Ci, LeavesOutWhatHasNoTimeLeftAndSaysSo) {
    stamp("tsan", 1);
    stamp("fuzz", 10);
    stamp("trixie", 20);
    stamp("asan", 40);
    const ShellRun run = ci("MILLWRIGHT_CI_MINUTES=19");
    EXPECT_EQ(run.exit_code, 0) << run.output;
    EXPECT_THAT(steps(), HasSubstr("fuzz"));
    EXPECT_THAT(
        run.output,
        testing::ContainsRegex("ci: left out: scripts/test asan: 1[89] minutes were left, 40 are needed"));
    EXPECT_THAT(run.output, HasSubstr("ci: left out: scripts/fresh trixie"));
    const ShellRun none = ci("MILLWRIGHT_CI_MINUTES=2 MILLWRIGHT_CI_TURN=none");
    EXPECT_EQ(none.exit_code, 0) << none.output;
    EXPECT_THAT(steps(),
                AllOf(HasSubstr("test release"), Not(HasSubstr("ctest")), Not(HasSubstr("try-package"))));
}

TEST_F(Ci, FailsForASkippedTestAndForAnUnknownTurn) {
    const ShellRun skipped = ci("TESTS='7 - Oracle.Speaks (Skipped)'");
    EXPECT_EQ(skipped.exit_code, 1);
    EXPECT_THAT(skipped.output, HasSubstr("7 - Oracle.Speaks (Skipped)"));
    const ShellRun unknown = ci("MILLWRIGHT_CI_TURN=msan");
    EXPECT_EQ(unknown.exit_code, 2);
    EXPECT_THAT(unknown.output, HasSubstr("unknown turn 'msan': use asan, tsan, fuzz, trixie or none"));
    EXPECT_EQ(steps(), "");
}

TEST_F(Ci, EndsWhereAStepFails) {
    write_program(checkout / "scripts/fresh", "exit 7");
    const ShellRun run = ci();
    EXPECT_EQ(run.exit_code, 7);
    EXPECT_THAT(run.output,
                HasSubstr("ci: scripts/fresh bookworm scripts/run --headless --out out failed (7)"));
    EXPECT_THAT(steps(), Not(HasSubstr("try-package")));
}

} // namespace
} // namespace millwright::test
