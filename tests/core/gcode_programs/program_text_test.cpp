// What stands around a program is left out by every reader.
#include "core/gcode/program_text.h"

#include "core/base/files.h"
#include "core/gcode/interpreter.h"
#include "core/gcode/tool_table.h"
#include "core/gcode_programs/cut_program.h"
#include "tests/core/gcode/read_program.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace millwright::gcode {
namespace {

using ::testing::MatchesRegex;

const std::string mark = "\xEF\xBB\xBF";
const std::string dos_end = "\x1A";

class CountedMoves final : public CanonSink {
public:
    void move(const Move&, const SourceLine&) override { ++count; }
    void curve(const Curve&, const SourceLine&) override {}
    void command(const Command&, const SourceLine&) override {}
    int count = 0;
};

TEST(ProgramText, IsWithoutMarkAndWithoutTheEndOfDos) {
    EXPECT_EQ(program_text(mark + "G21\nM2\n" + dos_end + dos_end), "G21\nM2\n");
    EXPECT_EQ(program_text("M2" + dos_end), "M2");
    EXPECT_EQ(program_text(std::string("M2\n\x1A\0\0", 6)), "M2\n"); // a block filled up
    EXPECT_EQ(program_text("G21"), "G21");
    EXPECT_EQ(program_text(mark), "");
    EXPECT_EQ(program_text(""), "");
    EXPECT_EQ(program_text("\xEF\xBB"), "\xEF\xBB");
}

TEST(ProgramText, IsReadTheSameFromTextAndFromAFile) {
    const test::ScratchFolder folder;
    for (const std::string& text : {mark + "G0 X1\nM98 P7\nG0 X2\nM2\nO7\nG0 X5\nM99\n" + dos_end,
                                    mark + "%\nG0 X1\nG0 X2\nG0 X3\n%\r\n" + dos_end + dos_end,
                                    "G0 X1\nG0 X2\nG0 X3\nM2" + dos_end,
                                    "G0 X1\nG0 X2\nG0 X3\nM2\n" + std::string(100'000, '\0')}) {
        CountedMoves of_text, of_file;
        Interpreter by_text(text, "part.ngc", {}, of_text);
        by_text.run();
        const auto file = folder.path() / "part.ngc";
        write_file(file, text);
        Interpreter by_file(file, {}, of_file);
        by_file.run();
        EXPECT_TRUE(by_text.errors().empty()) << to_text(by_text.errors().front());
        EXPECT_TRUE(by_file.errors().empty()) << to_text(by_file.errors().front());
        EXPECT_EQ(of_text.count, 3);
        EXPECT_EQ(of_file.count, 3);
    }
}

// Each line was refused anew, and for Grbl with words about numbers.
TEST(ProgramText, WhatIsNoPlainTextIsRefusedOnceInEveryDialect) {
    using namespace std::string_literals;
    const auto errors = [](const std::string& text, Dialect dialect) {
        ReaderSettings settings;
        settings.dialect = dialect;
        settings.most_errors = 100;
        settings.read_on = true;
        std::string all;
        for (const Diagnostic& error : test::read_all(text, settings).errors) {
            all += to_text(error) + "\n";
        }
        return all;
    };
    for (const Dialect dialect : {Dialect::linuxcnc, Dialect::grbl}) {
        EXPECT_THAT(errors("G\0002\0001\0\n\0G\0000\0\n\0"s, dialect),
                    MatchesRegex(".*:1:1: the file is UTF-16 \\(save it as plain text\\)\n"));
        EXPECT_THAT(errors("\xFF\xFE\0\0G\0\0\0\n\0\0\0"s, dialect),
                    MatchesRegex(".*:1:1: the file is UTF-32 \\(save it as plain text\\)\n"));
        EXPECT_THAT(errors("G21\nG0\0 X1\nG0\0 X2\nM2\n"s, dialect),
                    MatchesRegex(".*:2:3: byte 0x00 found: this is a binary file.*\n"));
        EXPECT_EQ(errors("G21\nG0 X1\nM2\n\0\0\0\0"s, dialect), "");
    }
}

TEST(ProgramText, ABytesOfDosInTheMiddleIsNone) {
    EXPECT_EQ(test::error_of("G0 X1\n" + dos_end + "\nG0 X2"), "2:1: byte 0x1A is not valid in a program");
}

TEST(ProgramText, IsKnownForGcodeAllTheSame) {
    EXPECT_TRUE(is_gcode(mark + "G21\n"));
    EXPECT_EQ(parse_tool_table(mark + "T1 P1 Z1234567.123456 D13\n" + dos_end, "tools").tools.size(), 1U);
}

} // namespace
} // namespace millwright::gcode
