// Every command and listing that the documents show is run and compared. Those of the README:
// readme_test.cpp.
#include "tests/app/guide.h"
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
#include <regex>
#include <set>
#include <sstream>
#include <string>
#include <vector>

namespace millwright::test {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

TEST_F(Guide, CommandsOfTheCommandLineGuideWork) {
    const std::string guide = content_of("docs/user/command-line.md");
    EXPECT_GE(follow(commands_of(guide)), 20);
    for (const char* const left : {"program.ngc", "report.json", "preview.png"}) { // "leaves in out"
        EXPECT_TRUE(fs::exists(checkout / "out" / left)) << left;
    }
    EXPECT_GE(follow(indented_commands_of(guide)), 8);
}

TEST_F(Guide, CommandsOfTheOtherGuidesWork) {
    int tried = 0;
    for (const fs::path& document : documents_in("docs/user")) {
        const bool tutorial = document.parent_path().filename() == "tutorials";
        if (document.filename() != "command-line.md" && !tutorial) {
            tried += follow_document(content_of(document));
        }
    }
    EXPECT_GE(tried, 8);
}

/// Each on a computer that has none of its files.
class Tutorial : public Guide, public testing::WithParamInterface<const char*> {};

TEST_P(Tutorial, LeadsFromItsFirstCommandToItsLast) {
    const fs::path page = fs::path("docs/user/tutorials") / (std::string(GetParam()) + ".md");
    EXPECT_GE(follow_document(content_of(page)), 3);
}

INSTANTIATE_TEST_SUITE_P(Pages,
                         Tutorial,
                         testing::Values("dome", "machine", "points", "logo", "table", "arm"));

TEST(DocumentsTest, TriesEveryTutorial) {
    EXPECT_EQ(documents_in("docs/user/tutorials").size(), 6U);
}

TEST_F(Guide, CommandsOfTheReferenceWork) {
    int tried = 0;
    for (const fs::path& document : documents_in("docs/reference")) {
        if (document.filename() != "cli.md") { // which shows none, but how they are built
            tried += follow_document(content_of(document));
        }
    }
    EXPECT_GE(tried, 12);
}

/// scripts/cli-pages --check on a copy of the pages, with `from` replaced by `to` in that of `plan`.
ShellRun checked_pages(const std::string& from, const std::string& to) {
    const ScratchFolder scratch;
    const fs::path pages = scratch / "cli";
    fs::copy("docs/reference/cli", pages);
    std::string plan = content_of(pages / "plan.md");
    plan.replace(plan.find(from), from.size(), to);
    write_content(pages / "plan.md", plan);
    return shell(fs::current_path(),
                 "scripts/cli-pages --check --program '" + program_file().string() + "' --pages '" +
                     pages.string() + "'");
}

TEST(CommandPages, SayWhatTheHelpSays) {
    const ShellRun same = checked_pages("Range", "Range");
    EXPECT_EQ(same.exit_code, 0) << same.output;
    const ShellRun other = checked_pages("0 to 180", "0 to 90");
    EXPECT_EQ(other.exit_code, 1);
    EXPECT_THAT(other.output, HasSubstr("docs/reference/cli/plan.md"));
    EXPECT_EQ(checked_pages("## Notes", "## Remarks").exit_code, 0) << "below the mark people write";
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

TEST(CommandPages, NameNoOptionThatTheirCommandLacks) {
    for (const fs::path& page : documents_in("docs/reference/cli")) {
        const std::string text = content_of(page);
        const auto mark = text.find("<!-- The text above");
        ASSERT_NE(mark, std::string::npos) << page;
        const std::set<std::string> there = options_in(text.substr(0, mark));
        for (const std::string& option : options_in(text.substr(text.find("-->", mark)))) {
            EXPECT_TRUE(there.contains(option)) << page << " has no " << option;
        }
    }
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
         listing_behind(content_of("docs/reference/cli/gcode.md"), "`gcode check` prints")) {
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

TEST(DocumentsTest, FindsTheFilesThatADocumentShows) {
    const auto files =
        files_of("Save this as `my-arm.json`:\n\n```json\n{}\n```\n\nIt says\n\n```\nnothing\n```\n");
    EXPECT_THAT(files, testing::ElementsAre(testing::Pair("my-arm.json", "{}\n")));
}

TEST(DocumentsTest, FindsWhatADocumentSaysThatACommandPrints) {
    const auto listings = listings_of("```sh\na\nb --c   # why\n```\n\nIt prints\n\n```\n1 2\n3\n```\n\n"
                                      "A file:\n\n```\nG21\n```\n");
    ASSERT_EQ(listings.size(), 1U);
    EXPECT_EQ(listings[0].command, "b --c");
    EXPECT_EQ(listings[0].text, "1 2\n3\n");
    EXPECT_EQ(listings_of(content_of("docs/user/tutorials/dome.md")).size(), 1U);
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
