#include "core/drivers/stream/record_format.h"

#include "core/base/error.h"
#include "tests/support/machines.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <random>

namespace millwright::drivers {
namespace {

using testing::HasSubstr;

RecordText text_of(const std::string& pattern, int decimals = 2) {
    RecordFormat format;
    format.pattern = pattern;
    return {format, test::machine("router-xyz"), decimals};
}

// The axes of the router are Y, X, Z in its file's order; a pattern names them.
Record router_record(double x, double y, double z, double a, double s) {
    const kinematics::MachineModel model = test::machine("router-xyz");
    Record made{std::vector<double>(3), a, s};
    made.axes[static_cast<std::size_t>(model.axis_index('X'))] = x;
    made.axes[static_cast<std::size_t>(model.axis_index('Y'))] = y;
    made.axes[static_cast<std::size_t>(model.axis_index('Z'))] = z;
    return made;
}

TEST(RecordText, IsThatOfTheThesisUnlessToldOtherwise) {
    EXPECT_EQ(text_of(RecordFormat().pattern).written(router_record(0.26, 0.0, -1.5, 100.0, 10.0)),
              "t 0.26 0.00 -1.50 100.00 10.00");
    EXPECT_EQ(text_of("MOVE X={X};Z={Z};F{s}!").written(router_record(1.0, 2.0, 3.0, 4.0, 5.0)),
              "MOVE X=1.00;Z=3.00;F5.00!");
}

TEST(RecordText, IsReadAsItWasWritten) {
    std::mt19937 random(1);
    std::uniform_real_distribution<double> value(-500.0, 500.0);
    for (const char* pattern : {"t {X} {Y} {Z} {a} {s}", "{Z}:{Y}:{X}|{s}|{a}", "go({X},{Y},{Z})"}) {
        const RecordText text = text_of(pattern, 4);
        for (int n = 0; n < 100; ++n) {
            const Record made =
                router_record(value(random), value(random), value(random), value(random), value(random));
            const auto read = text.read(text.written(made));
            ASSERT_TRUE(read);
            for (std::size_t axis = 0; axis < 3; ++axis) {
                EXPECT_NEAR(read->axes[axis], made.axes[axis], 5.1e-5);
            }
        }
    }
    const RecordText text = text_of("t {X} {Y}");
    for (const char* line : {"", "t", "t 1", "t 1 ", "t 1 2 3", "u 1 2", "t nan 2", "t 1,2", " t 1 2"}) {
        EXPECT_FALSE(text.read(line)) << line;
    }
}

TEST(RecordText, QuotesAPatternThatIsNone) {
    for (const char* pattern :
         {"", "t", "t {X", "t {Q}", "t {XY}", "t {}", "{a} {s}", "{X}{Y}", "t {X}\n{Y}"}) {
        try {
            static_cast<void>(text_of(pattern));
            ADD_FAILURE() << pattern;
        } catch (const Error& error) {
            EXPECT_THAT(error.what(), HasSubstr(std::string("the record '") + pattern + "'"));
        }
    }
    RecordFormat format;
    format.patience = 0.0;
    EXPECT_THROW(RecordText(format, test::machine("router-xyz"), 2), Error);
}

// Steps of a third of a digit: their sum stays right.
TEST(RecordPath, NeverDriftsWhereItIsRelative) {
    RecordPath path(true, 0.01, 2);
    path.begin({1.0, 0.0, 0.0});
    double x = 1.0;
    for (int n = 1; n <= 3000; ++n) {
        x += path.to({1.0 + n / 300.0, 0.0, 0.0}, {true, true, true}).axes[0];
    }
    EXPECT_NEAR(x, 11.0, 1e-9);
}

TEST(RecordPath, SaysSpeedAndHowItChanges) {
    RecordPath path(false, 0.1, 3);
    path.begin({0.0, 0.0, 0.0});
    const Record first = path.to({0.3, 0.4, 9.0}, {true, true, false});
    EXPECT_NEAR(first.speed, 5.0, 1e-9);
    EXPECT_NEAR(first.acceleration, 50.0, 1e-9);
    const Record second = path.to({0.3, 0.6, 9.0}, {true, true, false});
    EXPECT_NEAR(second.speed, 2.0, 1e-9);
    EXPECT_NEAR(second.acceleration, -30.0, 1e-9);
    EXPECT_DOUBLE_EQ(second.axes[1], 0.6);
}

} // namespace
} // namespace millwright::drivers
