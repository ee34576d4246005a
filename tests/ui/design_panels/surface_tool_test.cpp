// Brush and outline on the surface in the Grid workspace: real mouse and keys, drawn in real OpenGL.
#include "core/plan/weight_map.h"
#include "tests/ui/person/dome_from_above.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>

namespace millwright::panels {
namespace {

using viewport::SurfaceToolKind;

class SurfaceTools : public test::DomeFromAbove {
protected:
    [[nodiscard]] const std::optional<grid::Field>& painted() {
        return person_.project().grid.elliptic.painted;
    }
    [[nodiscard]] const grid::Region& region() { return person_.project().grid.elliptic.region; }
};

TEST_F(SurfaceTools, PaintBesideAFormulaOfLargeValuesIsToldToBeFaintAndCanBeMadeToCount) {
    person_.app().edit("Weigh by a formula",
                       [](project::Project& p) {
                           p.grid.elliptic.weight = project::WeightSource::mixed;
                           p.grid.elliptic.mix = {
                               .error = 0.0, .painted = 1.0, .expression = 1.0, .high = 1e4};
                           p.grid.elliptic.expression = "10 + 900 * u";
                       },
                       {});
    person_.wait_idle();
    person_.click("inspector/surface_tool/tool/brush");
    person_.fill_in("inspector/surface_tool/radius", "12");
    EXPECT_FALSE(person_.sees("inspector/surface_tool/faint")) << "nothing is painted yet";
    person_.drag(at(0.45F, 0.5F), at(0.55F, 0.5F), 12);
    person_.wait_idle();
    EXPECT_TRUE(person_.sees("inspector/surface_tool/faint"));
    person_.keep("grid-faint-paint");
    const double before = person_.app().look().plan->plan.weight->high;
    person_.click("inspector/surface_tool/raise_paint");
    person_.wait_idle();
    EXPECT_GT(person_.app().look().plan->plan.weight->high, 1.1 * before);
    EXPECT_FALSE(person_.sees("inspector/surface_tool/faint"));
    person_.keep("grid-paint-raised");
}

// The grid stayed uniform, unsaid.
TEST_F(SurfaceTools, AMixWithoutAnyShareIsTold) {
    person_.app().edit("Weigh by a mix",
                       [](project::Project& p) {
                           p.grid.elliptic.weight = project::WeightSource::mixed;
                           p.grid.elliptic.mix = {.error = 0.0, .curvature = 1.0};
                       },
                       {});
    person_.wait_idle();
    EXPECT_FALSE(person_.sees("inspector/elliptic/mix/no_share"));
    for (const auto& [share, value] : {std::pair("curvature", "0"), std::pair("painted", "1")}) {
        person_.fill_in(std::string("inspector/elliptic/mix/") + share, value);
        person_.wait_idle();
        EXPECT_TRUE(person_.sees("inspector/elliptic/mix/no_share")) << share; // nothing is painted
    }
    EXPECT_FALSE(person_.app().look().plan->failure);
    person_.keep("grid-no-share");
}

// T20.
TEST_F(SurfaceTools, ABrushPaintsTheWeightInOneStepAStrokeAndErasesIt) {
    person_.click("inspector/surface_tool/tool/brush");
    ASSERT_EQ(person_.app().view_state().surface_tool.kind, SurfaceToolKind::brush);
    EXPECT_TRUE(person_.app().view_state().layers_now().colored.weight);
    person_.fill_in("inspector/surface_tool/radius", "12");
    person_.fill_in("inspector/surface_tool/strength", "1");
    person_.wait_idle();
    const auto weight = person_.app().look().plan->plan.weight;
    person_.hover(at(0.5F, 0.5F));
    const render::Picture with_ring = person_.picture_of("view/iso");
    person_.hover(at(0.02F, 0.02F));
    EXPECT_NE(person_.picture_of("view/iso"), with_ring)
        << "the ring of the brush is gone beside the surface";
    ASSERT_FALSE(painted());
    person_.drag(at(0.45F, 0.5F), at(0.55F, 0.5F), 12);
    ASSERT_TRUE(painted());
    EXPECT_EQ(person_.project().grid.elliptic.weight, project::WeightSource::mixed);
    EXPECT_GT(person_.project().grid.elliptic.mix.painted, 0.0);
    EXPECT_EQ(std::ranges::max(painted()->values), 1.0);
    EXPECT_EQ(painted()->values.front(), 0.0) << "not in the corner of the surface";
    person_.wait_idle();
    EXPECT_NE(person_.app().look().plan->plan.weight->values, weight->values);
    person_.hover(at(0.5F, 0.42F));
    person_.keep("grid-brush");
    const grid::Field once = *painted();
    person_.drag(at(0.5F, 0.55F), at(0.5F, 0.6F), 12);
    EXPECT_NE(*painted(), once);
    person_.press_key(render::Key::z, true);
    EXPECT_EQ(*painted(), once) << "a stroke is one step";
    person_.press_key(render::Key::z, true);
    EXPECT_FALSE(painted());
    EXPECT_EQ(person_.project().grid.elliptic.weight, project::WeightSource::error);
    person_.press_key(render::Key::y, true);
    ASSERT_TRUE(painted());
    person_.wait_idle(); // the plan with the paint moves what is below it
    person_.choose("inspector/surface_tool/stroke", "erase");
    person_.fill_in("inspector/surface_tool/radius", "40");
    person_.wait_idle();
    person_.drag(at(0.45F, 0.5F), at(0.55F, 0.5F), 12);
    EXPECT_EQ(std::ranges::max(painted()->values), 0.0);
    person_.click("inspector/surface_tool/clear_paint");
    EXPECT_FALSE(painted());
}

// A stroke changed nothing where the program used the track optimiser, as it does at first.
TEST_F(SurfaceTools, SayThatTheProgramsGridFollowsNoPaintAndHelp) {
    ASSERT_EQ(person_.project().grid.method, project::GridMethod::tracks);
    for (const char* const tool : {"brush", "outline"}) {
        person_.click("inspector/surface_tool/tool/" + std::string(tool));
        EXPECT_TRUE(person_.sees("inspector/surface_tool/no_weight")) << tool;
    }
    person_.click("inspector/surface_tool/tool/brush");
    person_.keep("grid-brush-no-effect");
    person_.click("inspector/surface_tool/use_elliptic");
    person_.wait_idle();
    EXPECT_EQ(person_.project().grid.method, project::GridMethod::elliptic);
    EXPECT_FALSE(person_.sees("inspector/surface_tool/no_weight"));
    person_.drag(at(0.45F, 0.5F), at(0.55F, 0.5F), 12);
    person_.wait_idle();
    EXPECT_NE(person_.app().look().plan->plan.weight, nullptr);
    person_.app().edit("Choose the path",
                       [](project::Project& p) {
                           p.toolpath.strategy = project::StrategyInput::constant_scallop;
                           p.tool.cutter = toolpath::CutterKind::ball;
                       },
                       {});
    person_.wait_idle();
    EXPECT_TRUE(person_.sees("inspector/surface_tool/own_points"));
    person_.click("inspector/surface_tool/use_zigzag");
    EXPECT_EQ(person_.project().toolpath.strategy, project::StrategyInput::zigzag);
    person_.app().run("grid.use_harmonic");
    person_.wait_idle();
    EXPECT_FALSE(person_.sees("inspector/surface_tool/no_weight"));
}

TEST_F(SurfaceTools, AnOutlineIsClickedClosedAndDragged) {
    person_.click("inspector/surface_tool/tool/outline");
    for (const auto& [x, y] : {std::pair{0.42F, 0.42F}, {0.58F, 0.42F}, {0.58F, 0.58F}, {0.42F, 0.58F}}) {
        person_.click_at(at(x, y));
    }
    EXPECT_EQ(person_.app().view_state().surface_tool.draft.size(), 4U);
    EXPECT_TRUE(region().everywhere()) << "not before it is closed";
    person_.click("view/corner(0)");
    ASSERT_EQ(region().outline.size(), 4U);
    EXPECT_TRUE(person_.app().view_state().surface_tool.draft.empty());
    person_.wait_idle();
    const auto everywhere = person_.app().look().plan->plan.weight;
    person_.keep("grid-outline");
    const Vec2 before = region().outline[1];
    person_.drag(person_.place("view/corner(1)").centre(), at(0.64F, 0.38F), 8);
    EXPECT_NE(region().outline[1], before);
    EXPECT_EQ(region().outline.size(), 4U) << "dragged, not added";
    const Vec2 after = region().outline[1];
    person_.press_key(render::Key::z, true);
    EXPECT_EQ(region().outline[1], before) << "a drag is one step";
    person_.press_key(render::Key::y, true);
    EXPECT_EQ(region().outline[1], after);
    person_.fill_in("inspector/surface_tool/border_mm", "3");
    EXPECT_EQ(region().border_mm, 3.0);
    person_.wait_idle();
    EXPECT_NE(person_.app().look().plan->plan.weight->values, everywhere->values);
    person_.click("inspector/surface_tool/clear_outline");
    EXPECT_TRUE(region().everywhere());
}

TEST_F(SurfaceTools, AnOutlineWithoutAreaIsToldAndItsCornersStay) {
    person_.click("inspector/surface_tool/tool/outline");
    const std::vector<Vec2> line{{0.4, 0.5}, {0.6, 0.5}, {0.5, 0.5}};
    person_.app().view_state().surface_tool.draft = line;
    person_.wait_idle();
    person_.click("view/corner(0)");
    person_.wait_idle();
    EXPECT_TRUE(region().everywhere());
    EXPECT_EQ(person_.app().view_state().surface_tool.draft, line);
    EXPECT_TRUE(person_.sees("notices/1"));
    person_.keep("grid-outline-in-a-line");
}

TEST_F(SurfaceTools, EscDropsAnOutlineInTheMaking) {
    person_.click("inspector/surface_tool/tool/outline");
    person_.click_at(at(0.45F, 0.45F));
    person_.click_at(at(0.55F, 0.45F));
    EXPECT_EQ(person_.app().view_state().surface_tool.draft.size(), 2U);
    person_.press_key(render::Key::escape);
    EXPECT_TRUE(person_.app().view_state().surface_tool.draft.empty());
    person_.click_at(at(0.45F, 0.45F));
    person_.click("inspector/surface_tool/tool/none");
    EXPECT_TRUE(person_.app().view_state().surface_tool.draft.empty());
    EXPECT_TRUE(region().everywhere());
}

} // namespace
} // namespace millwright::panels
