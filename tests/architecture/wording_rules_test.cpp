#include "tests/architecture/wording_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::architecture {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;
using ::testing::SizeIs;

TEST(Wording, OfRatesIsPer) {
    EXPECT_THAT(check_wording({{"app/a.cpp", "auto a = 1;\nsay(\"Feed, mm a minute\");\n"}}),
                ElementsAre(Finding{"app/a.cpp", 2, "'mm a minute': write 'per', as in mm per minute"}));
    EXPECT_THAT(check_wording({{"app/a.cpp", "say(\"Feed, mm per minute\");\n"}}), IsEmpty());
}

TEST(Wording, IsThatOfTextAlone) {
    EXPECT_THAT(check_wording({{"core/a.cpp", "int nobody = 0; // nobody\n"}}), IsEmpty());
    EXPECT_THAT(check_wording({{"tests/a.cpp", "say(\"nobody\");\n"}}), IsEmpty());
    EXPECT_THAT(check_wording({{"README.md", "`nobody`\n```\nnobody\n```\n"}}), IsEmpty());
    EXPECT_THAT(check_wording({{"docs/user/a.md", "Nobody knows.\n"}}), SizeIs(1));
}

TEST(Wording, IsFoundAcrossTheEndOfALine) {
    EXPECT_THAT(check_wording({{"ui/a.cpp", "say(\"40 points \"\n    \"a track\");\n"}}), SizeIs(1));
    EXPECT_THAT(check_wording({{"docs/user/a.md", "40 points\na track\n"}}), SizeIs(1));
    EXPECT_THAT(check_wording({{"docs/user/a.md", "nobody\nknows\n"}}), SizeIs(1));
}

TEST(Wording, OfThisRepositoryIsPlain) {
    EXPECT_THAT(check_wording(read_repository(".")), IsEmpty());
}

} // namespace
} // namespace millwright::architecture
