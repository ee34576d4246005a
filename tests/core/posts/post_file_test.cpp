#include "core/posts/post_file.h"

#include "core/base/error.h"
#include "core/base/files.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>

namespace millwright::posts {
namespace {

namespace fs = std::filesystem;
using ::testing::HasSubstr;

TEST(PostFile, OfLinuxCncSaysWhatTheWriterDoesWithoutAFile) {
    EXPECT_EQ(read_post("assets/posts/linuxcnc.json"), PostFormat{});
}

TEST(PostFile, EveryShippedOneIsReadAndNamedInTheReference) {
    const std::string page = read_file("docs/reference/post-file.md");
    int count = 0;
    for (const auto& entry : fs::directory_iterator("assets/posts")) {
        const PostFormat post = read_post(entry.path());
        EXPECT_FALSE(post.name.empty());
        EXPECT_THAT(page, HasSubstr("| `" + entry.path().stem().string() + "` |"));
        ++count;
    }
    EXPECT_EQ(count, 11);
}

/// One thing wrong in a shipped file: `from` becomes `to`, and the message holds `says` with its place.
struct Fault {
    const char* post;
    std::string from, to;
    std::string says;
};

std::string faulty(const Fault& fault) {
    std::string text = read_file(std::string("assets/posts/") + fault.post + ".json");
    const std::size_t at = text.find(fault.from);
    EXPECT_NE(at, std::string::npos) << fault.from;
    return text.replace(at, fault.from.size(), fault.to);
}

std::string message_of(const std::string& text) {
    try {
        (void)parse_post(text, "bad.json");
    } catch (const Error& error) {
        return to_text(error.diagnostic());
    }
    return "nothing is wrong";
}

const std::vector<Fault>& faults() {
    static const std::vector<Fault> all = {
        {"linuxcnc", "{\n", "", "bad.json:1:"},
        {"linuxcnc", "millwright-post", "millwright-machine", "bad.json:2:15: format: not a post file"},
        {"linuxcnc", "\"version\": 1", "\"version\": 2", "bad.json:3:16: version:"},
        {"linuxcnc", "    \"name\": \"LinuxCNC\",\n", "", "name"},
        {"linuxcnc", "\"LinuxCNC\"", "7", "bad.json:4:13: name:"},
        {"linuxcnc",
         "\"LinuxCNC\"",
         "\"Caf\xC3\xA9\"",
         "name: a program text must consist of printable ASCII"},
        {"linuxcnc", "\"extension\"", "\"ending\"", "ending"},
        {"grbl-inch",
         "\"length\": { \"decimals\": 5 }",
         "\"length\": { \"decimals\": 3 }",
         "numbers/length/decimals: a length in inches needs at least 4 decimals"},
        {"linuxcnc",
         "\"ngc\"",
         "\".ngc\"",
         "bad.json:6:18: extension: the extension must be a word without a dot"},
        {"linuxcnc", "\"ngc\"", "\"\"", "extension: the extension must be a word"},
        {"linuxcnc",
         "\"reader\": \"linuxcnc\"",
         "\"reader\": \"nobody\"",
         "reader: 'nobody' must be one of: linuxcnc, grbl, fanuc, klartext"},
        {"linuxcnc", "\"positions\": \"axes\"", "\"positions\": \"tip\"", "positions: \"tip\" is required"},
        {"linuxcnc", "\"XYZABCUVW\"", "\"XYX\"", "axes: 'XYX' must be a list of different letters"},
        {"linuxcnc", "\"XYZABCUVW\"", "\"xyz\"", "axes: 'xyz' must be a list"},
        {"linuxcnc", "\"XYZABCUVW\"", "\"\"", "axes: at least one axis is required"},
        {"linuxcnc", "\"mm\"", "\"cm\"", "unit: 'cm' must be one of: mm, inch"},
        {"linuxcnc",
         "\"time_unit\": \"s\"",
         "\"time_unit\": \"min\"",
         "time_unit: 'min' must be one of: s, ms"},
        {"linuxcnc",
         "\"separator\": \" \"",
         "\"separator\": \", \"",
         "lines/separator: the separator must be"},
        {"linuxcnc", "\"longest\": 255", "\"longest\": 0", "lines/longest"},
        {"linuxcnc", "\"longest\": 255", "\"longest\": 2.5", "lines/longest"},
        {"linuxcnc", "\"on-request\"", "\"sometimes\"", "line_numbers/lines: 'sometimes' must be one of"},
        {"linuxcnc", "\"step\": 10", "\"step\": 0", "line_numbers/step"},
        {"linuxcnc", "\"open\": \"(\"", "\"open\": \"\"", "comment/open: the start of a comment"},
        {"grbl", "\"!?~\"", "\"!.\"", "comment/forbidden: the dot cannot be forbidden"},
        {"linuxcnc",
         "\"length\": { \"decimals\": 4 }",
         "\"length\": { \"decimals\": 7 }",
         "numbers/length/decimals"},
        {"linuxcnc", "\"length\": { \"decimals\": 4 }", "\"length\": { }", "numbers/length"},
        {"linuxcnc",
         "\"length\": { \"decimals\": 4 }",
         "\"length\": { \"decimals\": 4, \"point\": false }",
         "numbers/length: numbers with decimals and trailing zeros need a decimal point"},
        {"linuxcnc",
         "\"angle\": { \"decimals\": 4 }",
         "\"angle\": { \"decimals\": 4, \"comma\": true }",
         "numbers/angle"},
        {"linuxcnc", "\"angle\": { \"decimals\": 4 },\n", "", "angle"},
        {"linuxcnc", "{path}", "{pfad}", "blocks/head[1]: unknown placeholder {pfad} (allowed here: path)"},
        {"linuxcnc", "{path}", "{path", "blocks/head[1]: the braces of 'G54 G94 {path' do not match"},
        {"linuxcnc", "{path}", "path}", "blocks/head[1]: the braces of"},
        {"linuxcnc", "\"G61\"", "\"\"", "blocks/head: {path} requires path_blended and path_exact"},
        {"linuxcnc", "S{speed} M3", "M3", "blocks/spindle_clockwise: {speed} is missing"},
        {"linuxcnc", "G4 P{time}", "G4 P1", "blocks/dwell: {time} is missing"},
        {"linuxcnc", "[\"M8\"]", "\"M8\"", "blocks/coolant_on"},
        {"linuxcnc", "[\"M8\"]", "[8]", "blocks/coolant_on[0]"},
        {"linuxcnc", "[\"M8\"]", "[\"\"]", "blocks/coolant_on[0]: a line must not be empty"},
        {"linuxcnc",
         "[\"M8\"]",
         "[\"M8\\nM5\"]",
         "blocks/coolant_on[0]: a program text must consist of printable"},
        {"linuxcnc",
         "[\"M8\"]",
         "[\"M8 {speed}\"]",
         "unknown placeholder {speed} (no placeholders are allowed here)"},
        {"linuxcnc", "[\"M2\"]", "[]", "blocks/end: the end of a program must have at least one line"},
        {"linuxcnc", "\"rapid\": { \"code\": \"G0\" }", "\"rapid\": { }", "moves/rapid"},
        {"linuxcnc",
         "\"code\": \"G0\"",
         "\"code\": \"\"",
         "moves/rapid/code: the code of a move must not be empty"},
        {"linuxcnc", "\"code\": \"G0\"", "\"code\": \"G1\"", "moves/feed: rapids and feeds must differ"},
        {"linuxcnc", "\"modal_axes\": true", "\"modal_axes\": 1", "moves/modal_axes"},
        {"linuxcnc",
         "\"modal\": false",
         "\"modal\": true",
         "feed/modal: an inverse-time feed belongs to its line"},
        {"linuxcnc", "\"word\": \"F\"", "\"word\": \"\"", "feed/word: the feed word must not be empty"},
        {"linuxcnc", "\"inverse-time\"", "\"per-turn\"", "feed/mode: 'per-turn' must be one of"},
        {"linuxcnc",
         "\"centre\": \"relative\"",
         "\"centre\": \"middle\"",
         "arcs/centre: 'middle' must be one of"},
        {"linuxcnc", "\"ZX\"", "\"XZ\"", "arcs/planes[1]: 'XZ' must be one of: XY, ZX, YZ"},
        {"linuxcnc", "\"G3\"", "\"G2\"", "arcs: each arc direction needs its own code"},
        {"linuxcnc",
         "\"reader\": \"linuxcnc\"",
         "\"reader\": \"klartext\"",
         "arcs: arcs cannot be written in Klartext"},
        {"linuxcnc-tcp",
         "\"positions\": \"tip\"",
         "\"positions\": \"axes\"",
         "positions: \"tip\" is required"},
        {"linuxcnc-tcp", "\"read_m_on\": 428", "\"read_m_on\": 3", "tip/read_m_on"},
        {"linuxcnc-tcp",
         ",\n        \"read_m_on\": 428,\n        \"read_m_off\": 429",
         "",
         "tip: LinuxCNC needs the M codes"},
        {"linuxcnc-tcp", ",\n        \"read_m_off\": 429", "", "read_m_off"},
        {"linuxcnc-tcp",
         "\"reader\": \"linuxcnc\"",
         "\"reader\": \"fanuc\"",
         "read_m_on is for LinuxCNC text only"},
        {"fanuc-tcp", "\"reader\": \"fanuc\"", "\"reader\": \"grbl\"", "tip: Grbl has no tip control"},
        {"fanuc-tcp", "[\"G49\"]", "[]", "tip: tip control needs at least one line for on and one for off"},
        {"fanuc-tcp", "\"rapid_tolerance\": 0.5", "\"rapid_tolerance\": 0", "tip/rapid_tolerance"},
        {"fanuc-tcp",
         "\"tip\": {",
         "\"arcs\": { \"clockwise\": \"G2\", \"counterclockwise\": \"G3\", \"centre\": \"radius\", "
         "\"planes\": [], "
         "\"helical\": false },\n    \"tip\": {",
         "arcs: arcs can be fitted to axis positions only"},
    };
    return all;
}

TEST(PostFile, SaysWhereAndWhyAFileIsWrong) {
    for (const Fault& fault : faults()) {
        const std::string message = message_of(faulty(fault));
        EXPECT_THAT(message, HasSubstr(fault.says)) << fault.from << " -> " << fault.to;
        EXPECT_THAT(message, ::testing::MatchesRegex("bad.json:[0-9]+:[0-9]+( byte [0-9]+)?: .*"));
    }
}

TEST(PostFile, KeepsShortTextsAndShortLists) {
    std::string lines = "\"x\"";
    for (int n = 0; n < 60; ++n) {
        lines += ", \"x\"";
    }
    EXPECT_THAT(message_of(faulty({"linuxcnc", "[\"M8\"]", "[" + lines + "]", ""})),
                HasSubstr("at most 50 lines are allowed"));
    const std::string longest(201, 'x');
    EXPECT_THAT(message_of(faulty({"linuxcnc", "\"LinuxCNC\"", "\"" + longest + "\"", ""})),
                HasSubstr("a text can have at most 200 characters"));
}

} // namespace
} // namespace millwright::posts
