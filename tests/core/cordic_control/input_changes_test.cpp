#include "core/cordic_control/plc.h"

#include <gtest/gtest.h>

namespace millwright::cordic {
namespace {

TEST(InputChanges, AreReadWithLineAndColumnOfWhatIsWrong) {
    const ReadInputs good = read_inputs("; a door\n0.5 I3 1\n\n1.25 i3 0 ; closed\n", "inputs");
    ASSERT_EQ(good.changes.size(), 2U);
    EXPECT_EQ(good.changes[1].seconds, 1.25);
    EXPECT_FALSE(good.changes[1].value);
    struct Wrong {
        const char* text;
        int line, column;
    };
    for (const Wrong& wrong : {Wrong{"x I3 1", 1, 1},
                               Wrong{"1 I3 1\n 0.5 I3 0", 2, 2},
                               Wrong{"1 Q3 1", 1, 3},
                               Wrong{"1 I3 2", 1, 6},
                               Wrong{"1 I3", 1, 3},
                               Wrong{"-1 I3 1", 1, 1},
                               Wrong{"inf I3 1", 1, 1},
                               Wrong{"nan I3 1", 1, 1}}) {
        const ReadInputs read = read_inputs(wrong.text, "inputs");
        ASSERT_EQ(read.errors.size(), 1U) << wrong.text;
        EXPECT_EQ(read.errors[0].place.line, wrong.line) << wrong.text;
        EXPECT_EQ(read.errors[0].place.column, wrong.column) << wrong.text;
    }
}

} // namespace
} // namespace millwright::cordic
