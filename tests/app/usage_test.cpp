#include "tests/app/program.h"
#include "tests/app/shipped_files.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <filesystem>
#include <regex>
#include <sstream>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

using testing::HasSubstr;
using testing::Not;
using testing::StartsWith;

void expect_wrong_usage(const std::vector<std::string>& arguments, const std::string& says) {
    const Ended ended = run(arguments);
    EXPECT_EQ(ended.exit_code, 2) << testing::PrintToString(arguments);
    EXPECT_THAT(ended.err, StartsWith("millwright: ")) << testing::PrintToString(arguments);
    EXPECT_THAT(ended.err, HasSubstr(says)) << testing::PrintToString(arguments);
    EXPECT_EQ(ended.out, "") << testing::PrintToString(arguments);
}

TEST(Usage, HelpNamesEveryCommandAndOption) {
    const Ended ended = run({"--help"});
    EXPECT_EQ(ended.exit_code, 0);
    for (const char* command :
         {"plan", "render", "run", "gcode", "--version", "FILE", "plot, picture, path or"}) {
        EXPECT_THAT(ended.out, HasSubstr(command));
    }
    EXPECT_THAT(run({"render", "--help"}).out, HasSubstr("design|grid|toolpath|error|machine"));
    EXPECT_THAT(run({"run", "--help"}).out, HasSubstr("--speed"));
}

TEST(Usage, TheVersionIsPrinted) {
    const Ended ended = run({"--version"});
    EXPECT_EQ(ended.exit_code, 0);
    EXPECT_THAT(ended.out, testing::MatchesRegex("millwright [0-9]+\\.[0-9]+\\.[0-9]+\n"));
}

// They take longer to load than all the rest; EGL is missing on many servers.
TEST(Usage, TheProgramStartsWithoutOpenCascadeAndEgl) {
    const std::string libraries = content_of(program_file());
    EXPECT_THAT(libraries, HasSubstr("libX11.so"));
    EXPECT_THAT(libraries, Not(HasSubstr("libTKernel.so")));
    EXPECT_THAT(libraries, Not(HasSubstr("libEGL.so")));
}

TEST(Usage, WhatIsMissingIsNamed) {
    expect_wrong_usage({"plan"}, "PROJECT is required");
    expect_wrong_usage({"plan", dome_project}, "--out is required");
    expect_wrong_usage({"render", dome_project, "--out", "x.png"}, "--view is required");
    expect_wrong_usage({"run", dome_project}, "--driver is required");
    expect_wrong_usage({"run", dome_project, "--driver", "stream"}, "needs a port (give --port)");
    expect_wrong_usage({"emulate", "grbl"}, "give --pty LINK or --tcp PORT");
    expect_wrong_usage({"emulate", "grbl", "--tcp", "0", "--faults", "bend=1"}, "bend");
}

TEST(Usage, WhatIsUnknownIsNamed) {
    expect_wrong_usage({"plan", dome_project, "--out", "x", "--fast"}, "--fast");
    expect_wrong_usage({"plan", dome_project, "other.json", "--out", "x"}, "other.json");
    expect_wrong_usage({"render", dome_project, "--view", "back", "--out", "x.png"}, "back");
    expect_wrong_usage({"run", dome_project, "--driver", "real"}, "real");
    expect_wrong_usage({dome_project, "more"}, "more");
    expect_wrong_usage({"plan", dome_project, "--out", "x", "run", dome_project, "--driver", "virtual"}, "");
}

TEST(Usage, AFaultPointsToTheHelpOfItsOwnCommand) {
    expect_wrong_usage({"import", "--list"}, "Run \"millwright import --help\" for more.");
    expect_wrong_usage({"plan", dome_project}, "Run \"millwright plan --help\" for more.");
    expect_wrong_usage({"cordic", "asm", "--wrong"}, "Run \"millwright cordic asm --help\" for more.");
    expect_wrong_usage({"emulate", "grbl", "--tcp", "many"}, "Run \"millwright emulate grbl --help\"");
    expect_wrong_usage({"--wrong"}, "Run \"millwright --help\" for more.");
    expect_wrong_usage({dome_project, "more"}, "Run \"millwright --help\" for more.");
}

TEST(Usage, ASizeIsWidthTimesHeight) {
    for (const char* size :
         {"", "1280", "1280x", "x800", "1280x800x", "0x0", "-5x5", "99999x800", "1280 x 800", "axb"}) {
        expect_wrong_usage({"render", dome_project, "--view", "error", "--size", size, "--out", "x.png"},
                           "--size");
    }
}

TEST(Usage, ASpeedIsInItsRange) {
    for (const char* speed : {"", "-1", "0.001", "1001", "nan", "fast", "10x"}) {
        expect_wrong_usage({"run", dome_project, "--driver", "virtual", "--speed", speed}, "--speed");
    }
}

TEST(Usage, ANumberOfThreadsIsWhole) {
    for (const char* threads : {"", "0", "-2", "1.5", "2x", "many", "1025", "99999999999"}) {
        const std::string says =
            "--threads: \"" + std::string(threads) + "\" is not a whole number from 1 to 1024";
        expect_wrong_usage({"plan", dome_project, "--out", "x", "--threads", threads}, says);
        expect_wrong_usage({"--threads", threads, "plan", dome_project, "--out", "x"}, says);
    }
    expect_wrong_usage({"gcode", "check", "--threads", "2", "x.ngc"}, "--threads");
    for (const std::vector<std::string>& command :
         std::vector<std::vector<std::string>>{{"plan"},
                                               {"study", "set-up"},
                                               {"cordic", "accuracy"},
                                               {"picture", "relief"},
                                               {"plot", "toolpath"}}) {
        std::vector<std::string> words = command;
        words.emplace_back("--help");
        EXPECT_THAT(run(words).out, HasSubstr("--threads N")) << testing::PrintToString(command);
    }
}

/// The file is not there, which is only found out if it was taken for the file.
TEST(Usage, SeriesOfNumbersLeaveTheFileBehindThemAlone) {
    const std::vector<std::vector<std::string>> commands{
        {"send", "--origin", "1,2", "absent", "--driver", "virtual", "--machine", "router-xyz"},
        {"send", "--origin", "1,2,3", "absent", "--driver", "virtual", "--machine", "router-xyz"},
        {"send", "--at", "1,2,3", "absent", "--driver", "virtual", "--machine", "router-xyz"},
        {"gcode", "convert", "--origin", "1,2", "absent", "--machine", "router-xyz", "--post", "grbl"},
        {"plot", "toolpath", "--origin", "1,2", "absent", "--out", "/tmp/out.ngc"},
        {"picture", "trace", "--region", "1,2,3,4", "absent", "--out", "/tmp/out.svg"},
        {"arm", "reach", "--frame", "1,2,3,4,5,6", "absent", "--json"},
        {"reshape", "--degree", "3,3", "absent", "--out", "/tmp/out.json"},
        {"thesis", "convert", "--size", "3,3", "absent", "--out", "/tmp/out.dat"}};
    for (const auto& command : commands) {
        const Ended ended = run(command);
        EXPECT_EQ(ended.exit_code, 1) << testing::PrintToString(command);
        EXPECT_THAT(ended.err, HasSubstr("absent: ")) << testing::PrintToString(command);
    }
    expect_wrong_usage({"send", "absent", "--origin", "1,2,3,4"},
                       "--origin: At Most 3 required but received 4");
    expect_wrong_usage({"send", "absent", "--origin", "1"}, "--origin");
    expect_wrong_usage({"send", "absent", "--origin", "nan,1"}, "not a finite number");
}

/// All commands, with those of their groups: "plan", "plot toolpath".
std::vector<std::vector<std::string>> all_commands(const std::vector<std::string>& group = {}) {
    std::vector<std::string> words = group;
    words.emplace_back("--help");
    std::istringstream help(run(words).out);
    std::vector<std::vector<std::string>> found;
    bool inside = false;
    for (std::string line; std::getline(help, line);) {
        if (line == "Subcommands:") {
            inside = true;
        } else if (inside && line.starts_with("  ") && line.size() > 2 && line[2] != ' ') {
            std::vector<std::string> command = group;
            command.push_back(line.substr(2, line.find(' ', 2) - 2));
            found.push_back(command);
            for (const auto& below : all_commands(command)) {
                found.push_back(below);
            }
        }
    }
    return found;
}

// It had FLOAT:FLOAT in [0 - 1], TEXT:{nearest,travel}, TEXT:WIDTHxHEIGHT, FILE TEXT, [0,0] and GOAL(6x).
TEST(Usage, HelpSpeaksPlainly) {
    const auto commands = all_commands();
    EXPECT_GE(commands.size(), 50U);
    for (std::vector<std::string> command : commands) {
        command.emplace_back("--help");
        const std::string help = run(command).out;
        static const std::regex leftover(
            R"(\b(FLOAT|INT|UINT|REQUIRED)\b|TEXT:|\n  [A-Z]+ TEXT|default \[| in \[|\([0-9]+x\)|(Excludes|Needs):)");
        std::smatch found;
        EXPECT_FALSE(std::regex_search(help, found, leftover))
            << testing::PrintToString(command) << ": " << found.str();
        static const std::regex of_names(R"([a-z]\|[a-z][a-z|-]* \([^)]*default [0-9])");
        EXPECT_FALSE(std::regex_search(help, found, of_names))
            << testing::PrintToString(command) << ": " << found.str();
        static const std::regex of_some_text("--(out|machine|format|tool|unit|surface) TEXT");
        EXPECT_FALSE(std::regex_search(help, found, of_some_text))
            << testing::PrintToString(command) << ": " << found.str();
        static const std::regex number_of_list(R"(--[a-z-]+ NUMBER(?: \.\.\.)?\s+[^\n]*: X,Y)");
        EXPECT_FALSE(std::regex_search(help, found, number_of_list))
            << testing::PrintToString(command) << ": " << found.str();
        static const std::regex of_range(R"(\(([-0-9.]+) to ([-0-9.]+); default ([-0-9.]+))");
        for (std::sregex_iterator at(help.begin(), help.end(), of_range), end; at != end; ++at) {
            const double value = std::stod((*at)[3]);
            EXPECT_TRUE(value >= std::stod((*at)[1]) && value <= std::stod((*at)[2]))
                << testing::PrintToString(command) << ": " << at->str();
        }
    }
    EXPECT_THAT(run({"plan", "--help"}).out, HasSubstr("--largest-step NUMBER (0 to 180)"));
    EXPECT_THAT(run({"plan", "--help"}).out, HasSubstr("--sequencing nearest|travel|error|time"));
    EXPECT_THAT(run({"plan", "--help"}).out, HasSubstr("--post NAME|FILE (default linuxcnc)"));
    EXPECT_THAT(run({"render", "--help"}).out, HasSubstr("--size WIDTHxHEIGHT (default 1280x800)"));
    EXPECT_THAT(run({"arm", "reach", "--help"}).out, HasSubstr("(default 0,0,0,0,0,0)"));
    EXPECT_THAT(run({"arm", "ik", "--help"}).out, HasSubstr("arm ik [OPTIONS] X Y Z AX AY AZ"));
}

// They were taken, and did nothing.
TEST(Usage, AnOptionThatTheDriverDoesNotHaveIsRefused) {
    for (const std::vector<std::string>& more : std::vector<std::vector<std::string>>{{"--period", "0.5"},
                                                                                      {"--clock", "1000"},
                                                                                      {"--port", "/dev/null"},
                                                                                      {"--one-by-one"},
                                                                                      {"--home"}}) {
        std::vector<std::string> command{"run", dome_project, "--driver", "virtual"};
        command.insert(command.end(), more.begin(), more.end());
        expect_wrong_usage(command, "the virtual driver does not support " + more.front());
    }
    expect_wrong_usage({"send", "a.ngc", "--driver", "grbl", "--port", "/dev/null", "--speed", "3"},
                       "the grbl driver does not support --speed, which is for virtual, cordic");
    expect_wrong_usage({"send", "a.ngc", "--driver", "linuxcnc", "--port", "tcp:localhost:1", "--power"},
                       "the linuxcnc driver does not support --power");
}

TEST(Usage, HelpIsACommandToo) {
    EXPECT_EQ(run({"help"}).out, run({"--help"}).out);
    EXPECT_EQ(run({"help", "arm", "reach"}).out, run({"arm", "reach", "--help"}).out);
    EXPECT_EQ(run({"help", "arm", "reach"}).exit_code, 0);
    expect_wrong_usage({"help", "plann"}, "'plann' is neither a command nor a file (did you mean 'plan'?)");
    expect_wrong_usage({"help", "arm", "recah"}, "'arm recah' is not a command (did you mean 'reach'?)");
    expect_wrong_usage({"help", "help"}, "'help' is neither a command nor a file");
}

// "plann" was read as a file of that name.
TEST(Usage, AMistypedCommandOrOptionIsToldWhatWasMeant) {
    expect_wrong_usage({"plann"}, "'plann' is neither a command nor a file (did you mean 'plan'?)");
    expect_wrong_usage({"paln", dome_project, "--out", "x"}, "did you mean 'plan'?");
    expect_wrong_usage({"plot", "toolpaht", "a.plt", "--out", "x"}, "did you mean 'toolpath'?");
    expect_wrong_usage({"plan", dome_project, "--ot", "x"}, "did you mean '--out'?");
    expect_wrong_usage({"plans", dome_project},
                       "'plans' is neither a command nor a file (did you mean 'plan'?)");
    expect_wrong_usage({"gcod", "check", "x.ngc"}, "'gcod' is neither a command nor a file (did you mean");
    expect_wrong_usage({"arm", "recah", "x.ngc"}, "'arm recah' is not a command (did you mean 'reach'?)");
    expect_wrong_usage({"version"}, "'version' is neither a command nor a file ('millwright --help' lists");
    const ScratchFolder scratch;
    const auto here = std::filesystem::current_path();
    write_content(scratch / "dome", "{}");
    std::filesystem::current_path(scratch.path());
    expect_wrong_usage({"dome", "--bogus"}, "--bogus"); // a file that is there is one
    std::filesystem::current_path(here);
    const Ended far = run({"nonsense.ngc"});
    EXPECT_EQ(far.exit_code, 1);
    EXPECT_EQ(far.err.find("did you mean"), std::string::npos) << far.err;
}

} // namespace
} // namespace millwright::test
