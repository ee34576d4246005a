// V-carvings of drawings and pictures, as the window derives them.
#include "core/plan/plot_work.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <string>

namespace millwright::project {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::shared_ptr<const plan::PlotResult> carved(const PlotInput& input) {
    plan::PlotWorker worker("assets", [] {});
    worker.request(input);
    worker.wait_idle();
    return worker.latest();
}

/// 20 mm wide, filled: its edge counts.
PlotInput filled_square(const fs::path& folder) {
    std::ofstream(folder / "square.plt") << "IN;SP1;FT1;PU0,0;RA800,800;EA800,800;PU;";
    PlotInput input{folder / "square.plt", {}};
    input.settings.drawing_use = DrawingUse::carving;
    input.settings.tip = {plot::TipKind::v, 40.0, 2.0 * std::atan(1.0)}; // as deep as wide from the middle
    return input;
}

TEST(PlotCarving, OfADrawingHasItsFiguresItsColoursAndItsTool) {
    const test::ScratchFolder scratch;
    PlotInput input = filled_square(scratch.path());
    const auto made = carved(input);
    ASSERT_FALSE(made->failure) << to_text(*made->failure);
    ASSERT_TRUE(made->carved);
    EXPECT_NEAR(made->carved->deepest, 10.0, 1e-3);
    EXPECT_NEAR(made->carved->area, 400.0, 1e-3);
    EXPECT_LT(made->carved->deviation, 0.01);
    EXPECT_TRUE(made->levels.empty());
    ASSERT_TRUE(made->look);
    EXPECT_NEAR(static_cast<double>(std::ranges::min(made->look->z)), -10.0, 0.4);
    EXPECT_THAT(made->program->listing->text, HasSubstr("TAPER"));
    // In bands of depth, from the top, which have all of the cut between them.
    ASSERT_GT(made->cuts.size(), 4U);
    double length = 0.0;
    for (std::size_t n = 0; n < made->cuts.size(); ++n) {
        ASSERT_TRUE(made->cuts[n].depth);
        EXPECT_NEAR(*made->cuts[n].depth, (static_cast<double>(n) + 0.5) / 1.6, 0.01);
        ASSERT_FALSE(made->cuts[n].path.empty());
        for (const auto& chunk : made->cuts[n].path.chunks) {
            for (std::size_t k = 1; k < chunk->points.size(); ++k) {
                if (chunk->points[k].kind() == gcode::PathKind::feed) {
                    length += (chunk->points[k].position() - chunk->points[k - 1].position()).norm();
                }
            }
        }
    }
    EXPECT_NEAR(
        length, 40.0 * std::sqrt(3.0) + 5.0 * 2.0, 0.1); // half a diagonal rises 1 in sqrt(2); plunges
    input.settings.origin = {30.0, 40.0};
    const auto moved = carved(input);
    EXPECT_LT((moved->path->at(2).at - made->path->at(2).at - Vec3(30.0, 40.0, 0.0)).norm(), 1e-9);
}

TEST(PlotCarving, OfAPictureIsOfWhatIsDark) {
    PlotInput input{"assets/samples/pictures/boat.png", {}};
    input.settings.use = PictureUse::carving;
    take_v_bit(input.settings);
    input.settings.size.width = 60.0;
    const auto made = carved(input);
    ASSERT_FALSE(made->failure) << to_text(*made->failure);
    ASSERT_TRUE(made->carved);
    EXPECT_GT(made->carved->deepest, 0.3);
    EXPECT_LT(made->carved->deviation, 0.01);
    ASSERT_TRUE(made->look);
}

TEST(PlotCarving, SaysWhatIsWrong) {
    const test::ScratchFolder scratch;
    PlotInput input = filled_square(scratch.path());
    input.settings.tip = {};
    const auto by_ball = carved(input);
    ASSERT_TRUE(by_ball->failure);
    EXPECT_THAT(to_text(*by_ball->failure), HasSubstr("ball:1 cannot carve"));
    std::ofstream(scratch / "open.plt") << "IN;SP1;PU0,0;PD800,0,800,800,0,800;PU;";
    input = filled_square(scratch.path());
    input.file = scratch / "open.plt";
    const auto open = carved(input);
    ASSERT_TRUE(open->failure);
    EXPECT_THAT(to_text(*open->failure), HasSubstr("no outline is closed"));
    EXPECT_THAT(to_text(*open->failure), HasSubstr("from (0.000, 0.000) to (0.000, 20.000) mm"));
}

} // namespace
} // namespace millwright::project
