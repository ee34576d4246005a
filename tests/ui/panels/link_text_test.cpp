#include "ui/panels/link_text.h"

#include <gtest/gtest.h>

namespace millwright::panels {
namespace {

grid::ImproverLink link() {
    grid::ImproverLink link{"all nodes at once, exponent 4", {}, {}, {}};
    link.reached = {.max = 0.51234, .mean = 0.26, .axis_max = 0.3};
    link.of_best = {.max = 0.448, .mean = 0.26012, .axis_max = 0.26179938779914943};
    return link;
}

TEST(LinkText, HasTheToolAxisBesideTheTip) {
    EXPECT_EQ(link_figures(link(), true), "0.448 / 0.260 / 15.0");
    EXPECT_EQ(link_tip(link(), true),
              "all nodes at once, exponent 4: 0.5123 / 0.2600 mm, axis 17.19 deg at the end of this stage.");
}

TEST(LinkText, HasNoToolAxisWhereTheMachineCannotTurnIt) {
    EXPECT_EQ(link_figures(link(), false), "0.448 / 0.260 / -");
    EXPECT_EQ(link_tip(link(), false),
              "all nodes at once, exponent 4: 0.5123 / 0.2600 mm at the end of this stage.");
}

TEST(LinkText, SaysWhyTheNodesWereNotTaken) {
    grid::ImproverLink refused = link();
    refused.refused = "tracks too far apart";
    EXPECT_EQ(link_tip(refused, false),
              "all nodes at once, exponent 4: 0.5123 / 0.2600 mm at the end of this stage, rejected: tracks "
              "too far apart.");
}

} // namespace
} // namespace millwright::panels
