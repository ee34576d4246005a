#include "core/kinematics/tool_rotation.h"

#include "core/base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace millwright::kinematics {
namespace {

using ::testing::HasSubstr;

TEST(ToolRotation, TakesTheRoundingOfTypedNumbersAway) {
    const std::vector<double> rows{
        0.115551, -0.822658, 0.556670, 0.883210, 0.341535, 0.321394, -0.454519, 0.454519, 0.766044};
    const Mat3 found = rotation_of_rows(rows);
    EXPECT_TRUE(found.isUnitary(1e-14));
    for (int n = 0; n < 9; ++n) {
        EXPECT_NEAR(found(n / 3, n % 3), rows[static_cast<std::size_t>(n)], 1e-6);
    }
}

TEST(ToolRotation, SaysWhatIsNoRotation) {
    const auto why = [](const std::vector<double>& rows) {
        try {
            (void)rotation_of_rows(rows);
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string("taken");
    };
    EXPECT_EQ(why({1, 0, 0, 0, 1, 0, 0, 0, 1}), "taken");
    EXPECT_THAT(why({1, 0, 0, 0, 1, 0, 0, 0}), HasSubstr("9 numbers, but 8 were given"));
    EXPECT_THAT(why({1, 0, 0, 0, 2, 0, 0, 0, 1}), HasSubstr("column 2 of the rotation matrix has length 2"));
    EXPECT_THAT(why({1, 0, 0.6, 0, 1, 0, 0, 0, 0.8}), HasSubstr("columns 1 and 3 of the rotation matrix"));
    EXPECT_THAT(why({1, 0, 0, 0, 1, 0, 0, 0, -1}), HasSubstr("left-handed"));
    EXPECT_THAT(why({std::numeric_limits<double>::quiet_NaN(), 0, 0, 0, 1, 0, 0, 0, 1}),
                HasSubstr("not finite"));
}

} // namespace
} // namespace millwright::kinematics
