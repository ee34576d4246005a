// Every command and listing that the documents show is run and compared. Those of the README:
// readme_test.cpp.
#include "tests/app/emulator.h"
#include "tests/app/program.h"
#include "tests/app/shell.h"
#include "tests/support/scratch_folder.h"

#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

const std::string built_program = "build/release/millwright";

/// Why a command of a document is not run: it takes no arguments that could be right everywhere, or minutes.
const std::map<std::string, std::string> not_run = {
    {"millwright study run-time --out out", "takes minutes: RunTimeStudy"},
};

std::vector<fs::path> documents_in(const fs::path& folder) {
    std::vector<fs::path> found;
    for (const auto& entry : fs::directory_iterator(folder)) {
        if (entry.path().extension() == ".md") {
            found.push_back(entry.path());
        }
    }
    std::sort(found.begin(), found.end());
    return found;
}

/// Commands that stand in a line of their own, four blanks in; without those that stand for any (PROJECT,
/// [--json]).
std::vector<std::string> indented_commands_of(const std::string& document) {
    static const std::regex placeholder(R"(\[|\.\.\.|\b[A-Z]{3,}\b)");
    std::vector<std::string> commands;
    std::istringstream text(document);
    for (std::string line; std::getline(text, line);) {
        if (line.starts_with("    millwright ")) {
            std::string command = line.substr(4, line.find("  #") - 4);
            command.erase(command.find_last_not_of(' ') + 1);
            if (!std::regex_search(command, placeholder)) {
                commands.push_back(command);
            }
        }
    }
    return commands;
}

std::string replaced_everywhere(std::string text, const std::string& from, const std::string& to) {
    for (auto at = text.find(from); at != std::string::npos; at = text.find(from, at + to.size())) {
        text.replace(at, from.size(), to);
    }
    return text;
}

/// A bicubic strip from x = `from`, 40 mm wide.
std::string strip_project(const std::string& name, double from) {
    nlohmann::json points = nlohmann::json::array();
    for (int i = 0; i < 4; ++i) {
        nlohmann::json row = nlohmann::json::array();
        for (int j = 0; j < 4; ++j) {
            row.push_back({from + 40.0 * i / 3.0, 20.0 * j, j == 1 ? 2.0 : 0.0});
        }
        points.push_back(row);
    }
    return nlohmann::json{{"format", "millwright-project"},
                          {"version", 1},
                          {"name", name},
                          {"surface", {{"patches", {{{"points", points}}}}}},
                          {"machine", {{"file", "ac-table"}}}}
        .dump();
}

/// A checkout as the commands see it, with the files that they name and emulated controllers at their ports.
class Documents : public testing::Test {
protected:
    Documents() {
        fs::create_directories(checkout / "build/release");
        fs::create_symlink(program_file(), checkout / built_program);
        fs::create_symlink(fs::absolute("assets"), checkout / "assets");
        fs::create_directories(checkout / "tmp");
        write_content(checkout / "part.ngc", "G21 G90 G94\nG1 X1 Y1 F3000\nM30\n");
        write_content(checkout / "probe.csv",
                      "0,0,0\n0,20,1\n0,40,0\n20,0,1\n20,20,3\n20,40,1\n40,0,0\n40,20,1\n40,40,0\n");
        write_content(checkout / "left.json", strip_project("left", 0.0));
        write_content(checkout / "right.json", strip_project("right", 40.2));
        fs::copy_file("assets/samples/cover.step", checkout / "part.step");
        EXPECT_EQ(shell(checkout.path(), built_program + " export assets/projects/dome.json --out scan.stl")
                      .exit_code,
                  0);
    }

    ~Documents() override {
        for (const std::string& pid : emulators_) {
            (void)shell(checkout.path(), "kill -INT " + pid);
        }
    }

    /// As it can be run here: with ports of ours, and no slower than it computes.
    [[nodiscard]] std::string here(std::string command) const {
        static const std::regex real_time("--speed [0-9]+");
        const auto has = [&](std::string_view word) { return command.find(word) != std::string::npos; };
        if (command.starts_with("millwright ")) {
            command = "build/release/" + command;
        }
        if ((has(" run ") || has(" send ")) && (has("--driver virtual") || has("--driver cordic"))) {
            command = std::regex_replace(command, real_time, "") + " --speed 0";
        }
        const std::string port =
            has(" pmac ") ? "/tmp/pmac" : "/tmp/grbl"; // below the checkout, as all of /tmp
        for (const char* const shown : {"/dev/ttyUSB0", "tcp:127.0.0.1:1025"}) {
            command = replaced_everywhere(command, shown, port);
        }
        return replaced_everywhere(command, "/tmp/", (checkout / "tmp").string() + "/");
    }

    /// In the background, until the test ends; its port is there then.
    void start(const std::string& command) {
        static const std::regex tcp("--tcp [0-9]+");
        static const std::regex pty("--pty (\\S+)");
        const bool has_pty = command.find("--pty ") != std::string::npos;
        const std::string kind = command.find(" pmac") != std::string::npos ? "pmac" : "grbl";
        std::string own = std::regex_replace(here(command), tcp, "");
        const bool only_tcp = !has_pty && (kind == "pmac" || command.find(" stream") != std::string::npos);
        if (!has_pty && !only_tcp) {
            own = std::regex_replace(here(command), tcp, "--tcp 0"); // any that is free
        } else if (only_tcp) {
            own += " --pty " + (checkout / "tmp" / (kind == "pmac" ? "pmac" : "stream")).string();
        }
        std::smatch link;
        if (std::regex_search(own, link, pty) && fs::exists(link[1].str())) { // one at a port
            stop_emulators();
        }
        const std::string log = (checkout / "emulator.log").string();
        const ShellRun run = shell(checkout.path(), "{ " + own + " >'" + log + "' 2>&1 & echo $!; }");
        emulators_.push_back(run.output.substr(0, run.output.find('\n')));
        if (std::regex_search(own, link, pty)) {
            const ShellRun there = shell(checkout.path(),
                                         "for n in $(seq 600); do test -e '" + link[1].str() +
                                             "' && exit 0; sleep 0.1; done; exit 1");
            EXPECT_EQ(there.exit_code, 0) << command << '\n' << content_of(log);
        } else {
            EXPECT_EQ(shell(checkout.path(), "sleep 1; kill -0 " + emulators_.back()).exit_code, 0)
                << command << '\n'
                << content_of(log);
        }
    }

    void stop_emulators() {
        for (const std::string& pid : emulators_) {
            (void)shell(checkout.path(),
                        "kill -INT " + pid + "; for n in $(seq 100); do kill -0 " + pid +
                            " 2>/dev/null || break; sleep 0.1; done");
        }
        emulators_.clear();
        for (const char* const link : {"tmp/grbl", "tmp/pmac", "tmp/stream"}) {
            fs::remove(checkout / link);
        }
    }

    /// To its end, with 0; what it names by --out is there then.
    void run_shown(const std::string& command) {
        static const std::regex out("--out ([^ |]+)");
        const std::string environment =
            "MILLWRIGHT_PMAC_PORT='" + (checkout / "tmp/pmac").string() + "' timeout 300 ";
        ShellRun run = shell(checkout.path(), environment + here(command));
        // The guard of a PMAC takes the power then, as it should, and the command says so.
        const char* const was_busy = "the card received nothing from this computer for 50 ms";
        for (int n = 0; n < 4 && run.output.find(was_busy) != std::string::npos; ++n) {
            run = shell(checkout.path(), environment + here(command));
        }
        EXPECT_EQ(run.exit_code, 0) << command << '\n' << run.output;
        std::smatch file;
        if (std::regex_search(command, file, out)) {
            EXPECT_TRUE(fs::exists(checkout / file[1].str())) << command;
        }
    }

    /// What a person does who follows the document. The number of commands.
    int follow(const std::vector<std::string>& commands) {
        int tried = 0;
        for (const std::string& command : commands) {
            if (not_run.contains(command)) {
                continue;
            }
            if (command.find(" emulate ") != std::string::npos) {
                start(command);
            } else {
                const bool of_grbl = command.find("ttyUSB0") != std::string::npos &&
                                     command.find(" pmac ") == std::string::npos;
                if (of_grbl && !fs::exists(checkout / "tmp/grbl")) {
                    start(built_program + " emulate grbl --pty /tmp/grbl --speed 20");
                    run_shown(command);
                    stop_emulators();
                } else if (command.find(" pmac ") != std::string::npos &&
                           command.find(" emulate ") == std::string::npos &&
                           !fs::exists(checkout / "tmp/pmac")) {
                    start(built_program + " emulate pmac --pty /tmp/pmac --wait-for-host 0.01");
                    run_shown(command);
                } else {
                    run_shown(command);
                }
            }
            ++tried;
        }
        stop_emulators();
        return tried;
    }

    ScratchFolder checkout;

private:
    std::vector<std::string> emulators_; ///< process numbers
};

TEST_F(Documents, CommandsOfTheCommandLineGuideWork) {
    const std::string guide = content_of("docs/user/command-line.md");
    EXPECT_GE(follow(commands_of(guide)), 20);
    for (const char* const left : {"program.ngc", "report.json", "preview.png"}) { // "leaves in out"
        EXPECT_TRUE(fs::exists(checkout / "out" / left)) << left;
    }
    EXPECT_GE(follow(indented_commands_of(guide)), 8);
}

TEST_F(Documents, CommandsOfTheOtherGuidesWork) {
    int tried = 0;
    for (const fs::path& document : documents_in("docs/user")) {
        if (document.filename() != "command-line.md") {
            const std::string text = content_of(document);
            tried += follow(commands_of(text)) + follow(indented_commands_of(text));
        }
    }
    EXPECT_GE(tried, 8);
}

TEST_F(Documents, CommandsOfTheReferenceWork) {
    int tried = 0;
    for (const fs::path& document : documents_in("docs/reference")) {
        if (document.filename() != "cli.md") { // which shows none, but how they are built
            const std::string text = content_of(document);
            tried += follow(commands_of(text)) + follow(indented_commands_of(text));
        }
    }
    EXPECT_GE(tried, 12);
}

/// The help of "plan" or "plot toolpath".
const std::string& help_of(const std::string& command) {
    static std::map<std::string, std::string> texts;
    if (!texts.contains(command)) {
        std::vector<std::string> words;
        std::istringstream text(command);
        for (std::string word; text >> word;) {
            words.push_back(word);
        }
        words.emplace_back("--help");
        const Ended ended = run(words);
        texts[command] = ended.exit_code == 0 ? ended.out : std::string();
    }
    return texts[command];
}

/// "plot toolpath" of "plot toolpath FILE --out FILE"; empty where the first word is no command.
std::string command_words(const std::string& shown) {
    static const std::regex name("[a-z][-a-z]*");
    std::string words;
    std::istringstream text(shown);
    for (std::string word; text >> word && std::regex_match(word, name);) {
        const std::string longer = words.empty() ? word : words + " " + word;
        if (help_of(longer).find("Usage: millwright " + longer) == std::string::npos) {
            break;
        }
        words = longer;
    }
    return words;
}

std::set<std::string> options_in(const std::string& text) {
    static const std::regex option("--[a-z][-a-z0-9]*");
    std::set<std::string> found;
    for (std::sregex_iterator at(text.begin(), text.end(), option), end; at != end; ++at) {
        found.insert(at->str());
    }
    return found;
}

TEST(DocumentedCommands, OfTheReferenceHaveTheOptionsThatItShows) {
    std::istringstream text(content_of("docs/reference/cli.md"));
    std::string shown;
    int lines = 0;
    const auto check = [&] {
        if (shown.empty()) {
            return;
        }
        const std::string command = command_words(shown);
        ASSERT_FALSE(command.empty()) << shown;
        const std::set<std::string> there = options_in(help_of(command));
        for (const std::string& option : options_in(shown)) {
            EXPECT_TRUE(there.contains(option)) << command << " has no " << option;
        }
        ++lines;
    };
    for (std::string line; std::getline(text, line) && !line.starts_with("    millwright [--threads");) {
        if (line.starts_with("    millwright ") && !line.starts_with("    millwright [")) {
            check();
            shown = line.substr(15);
        } else if (line.starts_with("     ") && !shown.empty()) {
            shown += " " + line;
        }
    }
    check();
    EXPECT_GE(lines, 60);
}

TEST(DocumentedCommands, InTheTextOfTheDocumentsExistWithTheirOptions) {
    static const std::regex inline_command("`(?:build/release/)?millwright ([a-z][^`]*)`");
    int tried = 0;
    for (const char* const folder : {"docs/user", "docs/reference", "docs/dev"}) {
        for (const fs::path& document : documents_in(folder)) {
            const std::string text = content_of(document);
            for (std::sregex_iterator at(text.begin(), text.end(), inline_command), end; at != end; ++at) {
                const std::string shown = (*at)[1].str();
                if (shown.find('.') < shown.find(' ')) { // a file: `millwright part.ngc`
                    continue;
                }
                const std::string command = command_words(shown);
                EXPECT_FALSE(command.empty()) << document << ": " << shown;
                const std::set<std::string> there = options_in(help_of(command));
                for (const std::string& option : options_in(shown)) {
                    EXPECT_TRUE(there.contains(option)) << document << ": " << shown << ": " << option;
                }
                ++tried;
            }
        }
    }
    EXPECT_GE(tried, 40);
}

/// The first block of three backticks behind `heading`, line by line.
std::vector<std::string> listing_behind(const std::string& document, const std::string& heading) {
    std::vector<std::string> lines;
    std::istringstream text(document.substr(std::min(document.find(heading), document.size())));
    bool inside = false;
    for (std::string line; std::getline(text, line);) {
        if (line.starts_with("```")) {
            if (inside) {
                break;
            }
            inside = true;
        } else if (inside) {
            lines.push_back(line);
        }
    }
    return lines;
}

TEST(DocumentedListings, TheProgramOfTheGcodeReferenceIsTheOneOfTheDome) {
    const ScratchFolder scratch;
    const Ended ended = run({"plan", "assets/projects/dome.json", "--out", (scratch / "out").string()});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const std::vector<std::string> shown =
        listing_behind(content_of("docs/reference/gcode.md"), "## A program");
    ASSERT_GE(shown.size(), 10U);
    std::istringstream program(content_of(scratch / "out/program.ngc"));
    for (const std::string& line : shown) {
        std::string made;
        ASSERT_TRUE(std::getline(program, made));
        if (!made.starts_with("(made by:")) { // its version
            EXPECT_EQ(made, line);
        }
    }
}

TEST(DocumentedListings, CanonicalCommandsHaveTheFormatThatIsShown) {
    const ScratchFolder scratch;
    write_content(scratch / "two.ngc", "\n\n\n\n\n\nG21\nN10 G1 X1 Y2 F100\nM2\n");
    const Ended ended = run({"gcode", "canon", (scratch / "two.ngc").string()});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    const auto without_number = [](const std::string& line) { // rs274 counts the calls
        return line.substr(std::min(line.find('N'), line.size()));
    };
    for (const std::string& shown :
         listing_behind(content_of("docs/reference/gcode-reading.md"), "## Canonical commands")) {
        EXPECT_THAT(ended.out, HasSubstr(without_number(shown)));
    }
}

/// The names of an object's members, and of those of the objects in its lists: "jobs[].id".
std::set<std::string> members_of(const nlohmann::json& value, const std::string& at = {}) {
    std::set<std::string> names;
    if (value.is_object()) {
        for (const auto& [name, member] : value.items()) {
            names.insert(at + name);
            names.merge(members_of(member, at + name + "."));
        }
    } else if (value.is_array() && !value.empty()) {
        for (const auto& member : value) {
            names.merge(members_of(member, at + "[]."));
        }
    }
    return names;
}

TEST(DocumentedListings, TheJsonOfACheckHasTheMembersThatAreShown) {
    const ScratchFolder scratch;
    write_content(scratch / "part.ngc", "G21 G90\nG1 X1 F100\nG2 X5 I1\nM2\n");
    const Ended ended = run({"gcode", "check", (scratch / "part.ngc").string(), "--json"});
    EXPECT_EQ(ended.exit_code, 1);
    std::string shown;
    for (const std::string& line :
         listing_behind(content_of("docs/reference/cli.md"), "`gcode check` prints")) {
        shown += line + "\n";
    }
    EXPECT_EQ(members_of(nlohmann::json::parse(ended.out)), members_of(nlohmann::json::parse(shown)));
}

TEST(DocumentedListings, TheJobLogHasTheMembersThatAreShown) {
    const ScratchFolder scratch;
    const std::string logs = (scratch / "logs").string();
    const Ended ended = run({"run",
                             small_project(scratch.path(), "dome").string(),
                             "--driver",
                             "virtual",
                             "--speed",
                             "0",
                             "--log",
                             logs});
    ASSERT_EQ(ended.exit_code, 0) << ended.err;
    std::map<std::string, std::set<std::string>> written; // by kind of line
    for (const auto& entry : fs::directory_iterator(logs)) {
        std::istringstream text(content_of(entry.path()));
        for (std::string line; std::getline(text, line);) {
            const auto json = nlohmann::json::parse(line);
            written[json.at("record")].merge(members_of(json));
        }
    }
    const std::string document = content_of("docs/reference/job-log.md");
    for (const char* const heading : {"## First line", "## Other lines"}) {
        const auto shown = nlohmann::json::parse(listing_behind(document, heading).at(0));
        for (const std::string& member : members_of(shown)) {
            EXPECT_TRUE(written[shown.at("record")].contains(member)) << heading << ": " << member;
        }
    }
}

TEST(DocumentedListings, TheProgramOfConstantScallopLeavesWhatTheTableSays) {
    const ScratchFolder scratch;
    auto project = nlohmann::json::parse(content_of("assets/projects/dome.json"));
    project["tool"] = {{"cutter", "ball"}, {"diameter_mm", 6}, {"scallop_mm", 0.1}};
    project["toolpath"] = {{"strategy", "constant-scallop"}};
    write_content(scratch / "dome.json", project.dump());
    const Ended ended =
        run({"cutter", (scratch / "dome.json").string(), "--out", (scratch / "out").string()});
    EXPECT_EQ(ended.exit_code, 3) << ended.err; // it gouges, as the table says
    const auto cut = nlohmann::json::parse(content_of(scratch / "out/cut.json"));
    const std::string row = fmt::format("| dome | 0.1 mm | 20 | {:.3f} mm | {:.3f} mm |",
                                        cut.at("scallop_mm").at("max").get<double>(),
                                        cut.at("deepest_cut_below_surface_mm").get<double>());
    EXPECT_THAT(content_of("docs/reference/strategies.md"), HasSubstr(row));
}

TEST(DocumentsTest, FindsCommandsAndLeavesOutWhatStandsForAny) {
    EXPECT_THAT(indented_commands_of("text\n    millwright plan a.json --out b   # why\n"
                                     "    millwright plan PROJECT --out DIR\n    millwright run a [--yes]\n"),
                testing::ElementsAre("millwright plan a.json --out b"));
    EXPECT_THAT(commands_of("```sh\na b \\\n   c\n```\n"), testing::ElementsAre("a b c"));
    EXPECT_EQ(command_words("plot toolpath FILE --out FILE"), "plot toolpath");
    EXPECT_EQ(command_words("nonsense FILE"), "");
}

} // namespace
} // namespace millwright::test
