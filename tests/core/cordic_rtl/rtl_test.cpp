#include "core/cordic_rtl/rtl.h"

#include "core/base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>

namespace millwright::cordic {
namespace {

using testing::HasSubstr;

// The bits are compared by tests/oracle/iverilog_test.cpp.
TEST(Rtl, HoldsTheTablesOfItsFormat) {
    const auto files = make_rtl(fixed_format(2, 22), thesis_sequence(), 10, 1);
    ASSERT_EQ(files.size(), 5U);
    EXPECT_THAT(files[0].text, HasSubstr("0: begin s = 1; angle = 24'h1dac67; end")); // atan 1/2 in 22 places
    EXPECT_THAT(files[0].text, HasSubstr("29: begin s = 2; corrects = 1; subtracts = 1; end"));
    EXPECT_THAT(files[0].text, testing::Not(HasSubstr("33: begin"))); // a correction of 0 does nothing
    EXPECT_EQ(std::ranges::count(files[4].text, '\n'), 10);
}

TEST(Rtl, NamesItsSystemAndWhatConverges) {
    for (const RtlFile& file :
         make_rtl(fixed_format(4, 20), thesis_sequence(CoordinateSystem::hyperbolic), 10, 1)) {
        if (file.name.ends_with(".v")) {
            EXPECT_THAT(file.text, HasSubstr("29 hyperbolic steps")) << file.name;
            EXPECT_THAT(file.text,
                        HasSubstr("|z| <= 1.837456 (rotation), x > 0 and |y/x| <= 0.950550 (vectoring)"));
        }
    }
}

TEST(Rtl, IsTheSameEachTime) {
    const auto a = make_rtl(fixed_format(2, 22), thesis_sequence(), 100, 7);
    const auto b = make_rtl(fixed_format(2, 22), thesis_sequence(), 100, 7);
    for (std::size_t n = 0; n < a.size(); ++n) {
        EXPECT_EQ(a[n].text, b[n].text);
    }
    EXPECT_THROW(static_cast<void>(make_rtl(binary32, thesis_sequence(), 100, 7)), Error);
}

} // namespace
} // namespace millwright::cordic
