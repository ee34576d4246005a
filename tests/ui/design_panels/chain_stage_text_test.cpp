#include "ui/design_panels/chain_stage_text.h"

#include <gtest/gtest.h>

namespace millwright::panels {
namespace {

grid::ChainStage stage() {
    grid::ChainStage stage{"all nodes at once, exponent 4", {}, {}, {}};
    stage.reached = {.max = 0.51234, .mean = 0.26, .axis_max = 0.3};
    stage.of_best = {.max = 0.448, .mean = 0.26012, .axis_max = 0.26179938779914943};
    return stage;
}

TEST(ChainStageText, HasTheToolAxisBesideTheTip) {
    EXPECT_EQ(stage_figures(stage(), true), "0.448 / 0.260 / 15.0");
    EXPECT_EQ(stage_tip(stage(), true),
              "all nodes at once, exponent 4: 0.5123 / 0.2600 mm, axis 17.19 deg at the end of this stage.");
}

TEST(ChainStageText, HasNoToolAxisWhereTheMachineCannotTurnIt) {
    EXPECT_EQ(stage_figures(stage(), false), "0.448 / 0.260 / -");
    EXPECT_EQ(stage_tip(stage(), false),
              "all nodes at once, exponent 4: 0.5123 / 0.2600 mm at the end of this stage.");
}

TEST(ChainStageText, SaysWhyTheNodesWereNotTaken) {
    grid::ChainStage refused = stage();
    refused.refused = "tracks too far apart";
    EXPECT_EQ(stage_tip(refused, false),
              "all nodes at once, exponent 4: 0.5123 / 0.2600 mm at the end of this stage, rejected: tracks "
              "too far apart.");
}

} // namespace
} // namespace millwright::panels
