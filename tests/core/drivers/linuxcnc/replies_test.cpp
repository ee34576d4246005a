#include "core/drivers/linuxcnc/internal/replies.h"

#include "core/base/error.h"
#include "core/drivers/linuxcnc/internal/program_file.h"
#include "core/jobs/job.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::drivers::linuxcnc {
namespace {

using testing::HasSubstr;

TEST(LinuxCncReplies, AreTakenApart) {
    EXPECT_EQ(read_reply("HELLO ACK EMCNETSVR 1.1").kind, Reply::Kind::hello);
    EXPECT_EQ(read_reply("HELLO NAK").kind, Reply::Kind::refused);
    EXPECT_EQ(read_reply("SET RUN ACK").kind, Reply::Kind::done);
    EXPECT_EQ(read_reply("SET RUN ACK").subject, "RUN");
    EXPECT_EQ(read_reply("SET BOGUS NAK").kind, Reply::Kind::refused);
    EXPECT_EQ(read_reply("GET BOGUS NAK").subject, "BOGUS");
    const Reply line = read_reply("PROGRAM_LINE 12");
    EXPECT_EQ(line.kind, Reply::Kind::value);
    EXPECT_EQ(line.subject, "PROGRAM_LINE");
    EXPECT_EQ(line.text, "12");
    EXPECT_EQ(read_reply("ERROR Linear move on line 3 would exceed X's positive limit").text,
              "Linear move on line 3 would exceed X's positive limit");
    for (const char* nothing : {"", "set echo off", "<none>", "\x01\xff", "SET", "SET RUN"}) {
        EXPECT_EQ(read_reply(nothing).kind, Reply::Kind::other) << nothing;
    }
}

TEST(LinuxCncReplies, GiveFiniteNumbersOrNone) {
    EXPECT_EQ(read_numbers(" 1.5 -2 3 "), (std::vector{1.5, -2.0, 3.0}));
    EXPECT_EQ(read_numbers(""), std::vector<double>{});
    EXPECT_FALSE(read_numbers("1 nan"));
    EXPECT_FALSE(read_numbers("1 inf"));
    EXPECT_FALSE(read_numbers("1 2x"));
}

ProgramFile file_of(const std::string& text) {
    return program_file(*jobs::text_job(text, "part.ngc").listing, "part.ngc", 7);
}

TEST(LinuxCncProgramFile, MarksItsEnd) {
    const ProgramFile file = file_of("G0 X1\nN30 G1 M30\n");
    EXPECT_EQ(file.text, "G0 X1\nG4 P0\n(MSG,millwright 7 has executed everything)\nN30 G1 M30\n");
    EXPECT_EQ(file.end_line, 2);
    EXPECT_TRUE(file.in_order);
    EXPECT_EQ(file_of("%\nG0 X1\n%\n").end_line, 3);
    EXPECT_EQ(file_of("(M2 comes) G0 X1\nM25\nm 2\n").end_line, 3);
}

TEST(LinuxCncProgramFile, KnowsWhereLinesAreNotExecutedInTheirOrder) {
    EXPECT_FALSE(file_of("o1 repeat [2]\nG0 X1\no1 endrepeat\nM2\n").in_order);
}

TEST(LinuxCncProgramFile, RefusesAProgramWithoutAnEnd) {
    try {
        (void)file_of("G0 X1\n");
        FAIL();
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("part.ngc: the program has no end"));
    }
}

} // namespace
} // namespace millwright::drivers::linuxcnc
