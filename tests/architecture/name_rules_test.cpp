#include "tests/architecture/name_rules.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::architecture {
namespace {

using ::testing::ElementsAre;
using ::testing::IsEmpty;

TEST(Identifiers, SayPerAndNotA) {
    EXPECT_THAT(check_identifiers({{"core/a.h", "int a;\nint nodes_a_piece;\n"}}),
                ElementsAre(Finding{"core/a.h", 2, "nodes_a_piece: call it nodes_per_piece"}));
    EXPECT_THAT(check_identifiers({{"core/a.h", "int points_an_edge, name_a_case, steps_an_inch_;\n"}}),
                ElementsAre(Finding{"core/a.h", 1, "steps_an_inch_: call it steps_per_inch_"}));
}

TEST(Identifiers, AreTermsOfTheField) {
    EXPECT_THAT(check_identifiers({{"ui/a.cpp", "Workshop& app;\n"}}),
                ElementsAre(Finding{"ui/a.cpp", 1, "Workshop: call it AppController"}));
    EXPECT_THAT(check_identifiers({{"core/jobs/way_on.h", ""}}),
                ElementsAre(Finding{"core/jobs/way_on.h", 0, "call it resume_point"}));
}

TEST(Identifiers, AreNotThoseOfTextAndComments) {
    EXPECT_THAT(check_identifiers(
                    {{"core/a.cpp", "say(\"Workshop\"); // Workshop\nint x = 1'000; char c = '\"';\n"}}),
                IsEmpty());
}

TEST(Identifiers, OfThisRepositoryArePlain) {
    EXPECT_THAT(check_identifiers(read_repository(".")), IsEmpty());
}

} // namespace
} // namespace millwright::architecture
