// Each program in tests/golden/gcode-bad has to be refused with the very place and words that its first
// comment states: "; LINE:COLUMN: message". A new file is a new case.
#include "core/base/files.h"
#include "core/gcode/interpreter.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <vector>

namespace millwright::gcode {
namespace {

std::vector<std::filesystem::path> bad_programs() {
    std::vector<std::filesystem::path> files;
    for (const auto& entry : std::filesystem::directory_iterator("tests/golden/gcode-bad")) {
        files.push_back(entry.path());
    }
    std::sort(files.begin(), files.end());
    return files;
}

class Nothing final : public CanonSink {
public:
    void move(const Move&, const SourceLine&) override {}
    void curve(const Curve&, const SourceLine&) override {}
    void command(const Command&, const SourceLine&) override {}
};

std::string stated_error(const std::string& text) {
    const std::size_t begin = text.find("; ") + 2;
    return text.substr(begin, text.find('\n', begin) - begin);
}

TEST(BadPrograms, AreRefusedWithPlaceAndRule) {
    const test::WithoutTraps numbers_that_are_none; // some of them calculate beyond all numbers
    ReaderSettings settings;
    settings.most_repeated_lines = 10'000;
    const auto files = bad_programs();
    EXPECT_GE(files.size(), 150U);
    for (const auto& file : files) {
        const std::string text = read_file(file);
        Nothing sink;
        Interpreter program(text, file, settings, sink);
        program.run();
        ASSERT_EQ(program.errors().size(), 1U) << file;
        const Diagnostic& found = program.errors().front();
        std::string says = std::to_string(found.place.line) + ":" + std::to_string(found.place.column) +
                           ": " + found.message;
        says += found.hint.empty() ? "" : " (" + found.hint + ")";
        EXPECT_EQ(says, stated_error(text)) << file;
    }
}

/// Counts what a refused line has moved before it was refused.
class MovesOf final : public CanonSink {
public:
    explicit MovesOf(int line) : line_(line) {}
    void move(const Move& move, const SourceLine&) override { moves += move.source.line == line_ ? 1 : 0; }
    void curve(const Curve&, const SourceLine&) override {}
    void command(const Command&, const SourceLine&) override {}

    int moves = 0;

private:
    int line_;
};

int moves_of_refused(const std::string& line) {
    const std::string text = "G21 F10 S100 M3\n" + line + "\nM2\n";
    MovesOf sink(2);
    Interpreter program(text, "cycle.ngc", {}, sink);
    program.run();
    EXPECT_EQ(program.errors().size(), 1U) << line;
    return sink.moves;
}

TEST(BadPrograms, EndlessCyclesMoveNothing) {
    const test::WithoutTraps numbers_that_are_none;
    EXPECT_EQ(moves_of_refused("G81 X1 Z-1 R1 L1000000000"), 0);
    EXPECT_EQ(moves_of_refused("G81 X1 Z-1 R1 L250001"), 0);
    EXPECT_EQ(moves_of_refused("G83 X1 Z-1000 R1 Q0.000001"), 0);
    EXPECT_EQ(moves_of_refused("G73 X1 Z-1000 R1 Q0.000001"), 0);
    EXPECT_EQ(moves_of_refused("G76 P1 Z-10 I-1 J0.001 K10 R2"), 0);
}

TEST(BadPrograms, LongCyclesAreNotRefused) {
    const std::string text = "G21 F10\nG81 X1 Z-1 R1 L249999\nG80\nG83 X1 Z-99 R1 Q0.001\nM2\n";
    MovesOf sink(4);
    Interpreter program(text, "cycle.ngc", {}, sink);
    program.run();
    EXPECT_TRUE(program.errors().empty());
    EXPECT_NEAR(sink.moves, 300'000, 5);
}

} // namespace
} // namespace millwright::gcode
