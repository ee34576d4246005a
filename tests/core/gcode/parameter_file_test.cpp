#include "core/gcode/parameter_file.h"

#include "core/base/error.h"
#include "tests/core/gcode/read_program.h"
#include "tests/support/without_traps.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace millwright::gcode {
namespace {

using ::testing::ElementsAre;
using ::testing::HasSubstr;
using ::testing::Pair;

std::string refusal_of(const std::string& text) {
    try {
        (void)parse_parameter_file(text, "linuxcnc.var");
    } catch (const Error& error) {
        return to_text(error.diagnostic());
    }
    return {};
}

TEST(ParameterFile, HasANumberAndAValueALine) {
    EXPECT_THAT(parse_parameter_file("5161\t0.000000\r\n\r\n 5221  -12.5 \n31 1e3", "linuxcnc.var"),
                ElementsAre(Pair(5161, 0.0), Pair(5221, -12.5), Pair(31, 1000.0)));
    EXPECT_THAT(parse_parameter_file("\xEF\xBB\xBF"
                                     "5220 2\n5401 3\n\x1A",
                                     "linuxcnc.var"),
                ElementsAre(Pair(5220, 2.0))); // #5401 belongs to the tool
}

TEST(ParameterFile, IsRefusedWithTheLine) {
    const test::WithoutTraps without_traps;
    EXPECT_EQ(refusal_of("5161 1\nx 2\n"), "linuxcnc.var:2: a line must have a parameter number and a value");
    EXPECT_THAT(refusal_of("5161\n"), HasSubstr(":1: a line must have"));
    EXPECT_THAT(refusal_of("5161 1 2\n"), HasSubstr(":1: a line must have"));
    EXPECT_THAT(refusal_of("5161 nan\n"), HasSubstr(":1: a line must have"));
    EXPECT_THAT(refusal_of("9999 1\n"), HasSubstr("#9999 is not a parameter"));
    EXPECT_THAT(refusal_of("31 1\n31 2\n"), HasSubstr(":2: #31 is given twice"));
}

TEST(ParameterFile, HasABoundOfItsOwn) {
    std::string fault;
    try {
        static_cast<void>(read_parameter_file("/dev/zero"));
    } catch (const Error& error) {
        fault = error.what();
    }
    EXPECT_EQ(fault, "/dev/zero: larger than 4 MiB, the maximum that can be read");
}

TEST(ParameterFile, IsInForceAtTheStart) {
    ReaderSettings settings;
    settings.parameters = parse_parameter_file("31 7\n5221 10\n5163 -4\n", "linuxcnc.var");
    const test::ReadProgram read = test::read("G21 G90\nG0 X#31\nG28 Z0\n", settings);
    ASSERT_EQ(read.moves.size(), 3U);
    EXPECT_EQ(read.moves[0].target[Axis::x], 7.0);
    EXPECT_EQ(read.moves[2].target[Axis::z], -4.0);
    EXPECT_EQ(read.state.g5x_offset[Axis::x], 10.0);
}

} // namespace
} // namespace millwright::gcode
