#include "core/plot/path_file.h"

#include "core/base/error.h"
#include "core/plot/point_file.h"
#include "tests/support/reason.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <random>
#include <string>

namespace millwright::plot {
namespace {

using ::testing::HasSubstr;

CutPath random_path() {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> coordinate(-1000.0, 1000.0);
    CutPath path;
    for (int n = 0; n < 2000; ++n) {
        path.push_back({.at = {coordinate(random), coordinate(random) * 1e-7, 0.1 * n},
                        .speed = std::abs(coordinate(random)) / 3.0,
                        .move = static_cast<CutMove>(n % 5),
                        .tool = n % 7});
    }
    return path;
}

TEST(PathFiles, ComeBackToTheLastBit) {
    const CutPath path = random_path();
    const std::string text = path_file_text(path);
    EXPECT_EQ(read_path(text, "a.path"), path);
    EXPECT_EQ(path_file_text(read_path(text, "a.path")), text);
    EXPECT_TRUE(read_path(path_file_text({}), "a.path").empty());
}

TEST(PathFiles, AByteOrderMarkIsSkipped) {
    const std::string marked = "\xEF\xBB\xBF" + path_file_text(random_path());
    EXPECT_TRUE(is_path_file(marked));
    EXPECT_EQ(read_path(marked, "a.path"), random_path());
}

// The zero bytes between its letters would end each number after one digit.
TEST(PathFiles, AndPointFilesInUtf16AreRefused) {
    using namespace std::string_literals;
    for (const std::string& text :
         {"\xFF\xFEx\0;\0y\0;\0"s, "\xFE\xFF\0x\0;\0y"s, "x\0;\0y\0;\0"s, "\0x\0;\0y\0;"s}) {
        const PointFile points = read_points(text, "wide.csv");
        ASSERT_EQ(points.diagnostics.size(), 1U);
        EXPECT_THAT(to_text(points.diagnostics[0]), HasSubstr("wide.csv:1: the file is text in UTF-16"));
        EXPECT_THAT(test::reason([&] { (void)read_path(text, "wide.path"); }), HasSubstr("UTF-16"));
    }
}

int line_of_fault(const std::string& record) {
    try {
        static_cast<void>(read_path(path_file_text({}) + "1,2,3,4,cut,1\n" + record + "\n", "a.path"));
    } catch (const Error& error) {
        return error.diagnostic().place.line;
    }
    return 0;
}

// A speed that was lost went through the material as fast as the machine can.
TEST(PathFiles, WhatGoesThroughTheWorkHasASpeed) {
    const std::string title =
        "# millwright path 1: absolute; x mm, y mm, z mm, speed mm/s (0: rapid), move, tool\n";
    for (const char* move : {"cut", "plunge"}) {
        std::string text = title;
        text.append("1,2,5,0,rapid,1\n1,2,-1,0,").append(move).append(",1\n");
        try {
            (void)read_path(text, "a.path");
            ADD_FAILURE() << move;
        } catch (const Error& error) {
            EXPECT_EQ(error.diagnostic().place.line, 3);
            EXPECT_NE(std::string(error.what()).find("has speed 0"), std::string::npos) << error.what();
        }
    }
    EXPECT_NO_THROW(
        (void)read_path(title + "1,2,5,0,rapid,1\n1,2,-1,2,plunge,1\n1,2,5,0,retract,1\n", "a.path"));
}

TEST(PathFiles, FaultsHaveTheirLine) {
    for (const char* record : {"1,2,3,4,cut",
                               "1,2,3,4,cut,1,9",
                               "1,2,nan,4,cut,1",
                               "1,2,,4,cut,1",
                               "1,2,3,-4,cut,1",
                               "1,2,3,4,fly,1",
                               "1,2,3,4,cut,1.5",
                               "1,2,3,4,cut,-1",
                               "1;2;3"}) {
        EXPECT_EQ(line_of_fault(record), 3) << record;
    }
    EXPECT_EQ(line_of_fault("1,2,3,4,cut,1"), 0);
    EXPECT_THROW(static_cast<void>(read_path("G0 X1\n", "a.path")), Error);
}

} // namespace
} // namespace millwright::plot
