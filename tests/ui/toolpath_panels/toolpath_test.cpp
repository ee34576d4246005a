// The Toolpath workspace driven by real mouse and keys, drawn in real OpenGL.
#include "core/plan/cut_study.h"
#include "tests/ui/person/person.h"
#include "ui/window/window.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <initializer_list>
#include <string>

namespace millwright::panels {
namespace {

using project::GridMethod;
using test::dome_project;
using test::Person;
using toolpath::CutterKind;

constexpr render::PixelSize tall{1600, 1400}; // so that the whole inspector is in sight

/// At the Toolpath workspace of a small dome.
class ToolpathWorkspace : public ::testing::Test {
protected:
    ToolpathWorkspace() {
        person_.open(dome_project);
        person_.app().edit("Change the grid",
                           [](project::Project& p) {
                               p.grid.nu = 6;
                               p.grid.nv = 8;
                           },
                           {});
        person_.press_key(render::Key::f4);
        person_.wait_idle();
    }

    /// Folds sections away, or opens those that are folded, so that all of the next ones are in sight.
    void fold(std::initializer_list<const char*> sections) {
        for (const char* section : sections) {
            person_.click(std::string("inspector/") + section);
        }
    }

    /// The part of the view that the tool covers, half way through the motion.
    [[nodiscard]] double share_of_tool() {
        person_.app().view_state().playback.time = 0.5 * person_.app().look().duration();
        person_.frames(3);
        const render::Picture with = person_.picture_of("view/iso");
        person_.app().run("view.layer_tool");
        person_.frames(3);
        const render::Picture without = person_.picture_of("view/iso");
        person_.app().run("view.layer_tool");
        person_.frames(3);
        EXPECT_EQ(person_.picture_of("view/iso"), with);
        return render::difference(with, without, 0).fraction;
    }

    [[nodiscard]] const plan::Plan& plan() { return person_.app().look().plan->plan; }

    Person person_{tall};
};

TEST_F(ToolpathWorkspace, AToolIsChosenAndItsFiguresAreThere) {
    fold({"strategy"});
    person_.wait_idle();
    EXPECT_FALSE(person_.sees("inspector/tool/diameter_mm"));
    EXPECT_FALSE(person_.sees("inspector/cut/deepest"));
    const auto point_path = person_.app().look().shown()->path_length;
    person_.choose("inspector/tool/cutter", "bull-nose");
    EXPECT_EQ(person_.project().tool.cutter, CutterKind::bull_nose);
    EXPECT_TRUE(person_.sees("inspector/tool/corner_radius_mm"));
    EXPECT_FALSE(person_.sees("inspector/tool/half_angle_deg"));
    EXPECT_FALSE(person_.sees("inspector/tool/holder_length_mm"));
    person_.fill_in("inspector/tool/holder_diameter_mm", "25");
    EXPECT_TRUE(person_.sees("inspector/tool/holder_length_mm"));
    person_.fill_in("inspector/tool/lead_deg", "10");
    person_.wait_idle();
    ASSERT_NE(plan().cut, nullptr);
    EXPECT_TRUE(person_.sees("inspector/cut/deepest"));
    EXPECT_NE(person_.app().look().shown()->path_length, point_path);
    person_.keep("toolpath-tool");
    person_.press_key(render::Key::z, true);
    person_.press_key(render::Key::z, true);
    person_.press_key(render::Key::z, true);
    person_.wait_idle();
    EXPECT_EQ(person_.project().tool, project::ToolInput{});
    EXPECT_EQ(plan().cut, nullptr);
    EXPECT_EQ(person_.app().look().shown()->path_length, point_path);
}

TEST_F(ToolpathWorkspace, WhereNoPassComesNearAtLeastSoMuchIsLeft) {
    fold({"strategy"});
    person_.choose("inspector/tool/cutter", "ball");
    person_.fill_in("inspector/tool/diameter_mm", "4"); // tracks are 25 mm apart
    person_.wait_idle();
    ASSERT_TRUE(plan().cut && plan().cut->scallops.not_cut > 0.0);
    EXPECT_TRUE(person_.sees("inspector/cut/scallop_cut")) << "the figure of what is cut stands beside it";
    person_.keep("toolpath-at-least");
    EXPECT_THAT(person_.desktop().ui().cut_texts(), ::testing::IsEmpty());
}

TEST_F(ToolpathWorkspace, AShapeThatCannotBeIsRefusedWithItsReason) {
    person_.choose("inspector/tool/cutter", "bull-nose");
    const auto before = plan().cut;
    ASSERT_NE(before, nullptr);
    person_.fill_in("inspector/tool/corner_radius_mm", "4");
    person_.wait_idle();
    EXPECT_EQ(person_.project().tool.corner_radius_mm, project::ToolInput().corner_radius_mm);
    EXPECT_NE(person_.app().view_state().log.back().find("does not fit into a diameter"), std::string::npos);
    EXPECT_EQ(plan().cut, before);
}

/// A cutter in its true size, in the part and at the machine.
TEST_F(ToolpathWorkspace, TheToolIsDrawnAsItIs) {
    person_.choose("inspector/tool/cutter", "ball");
    person_.fill_in("inspector/tool/diameter_mm", "14");
    person_.fill_in("inspector/tool/holder_diameter_mm", "30");
    person_.wait_idle();
    const double thick = share_of_tool();
    person_.keep("toolpath-tool-shape");
    person_.fill_in("inspector/tool/diameter_mm", "4");
    person_.wait_idle();
    const double thin = share_of_tool();
    EXPECT_GT(thin, 0.0);
    EXPECT_GT(thick, thin);
    person_.press_key(render::Key::f6);
    person_.wait_idle();
    person_.keep("machine-tool-shape");
}

TEST_F(ToolpathWorkspace, MorePointsAreAddedWhereTheAxesTurnFast) {
    fold({"error", "strategy", "tool"});
    const std::size_t before = person_.app().look().shown()->toolpath.points.size();
    person_.choose("inspector/sequencing/goal", "error");
    EXPECT_EQ(person_.project().sequencing.goal, toolpath::SequencingGoal::error);
    person_.fill_in("inspector/sequencing/largest_step_deg", "10");
    person_.wait_idle();
    EXPECT_GT(person_.app().look().shown()->toolpath.points.size(), before);
    person_.keep("toolpath-sequencing");
}

/// A ball that is too thick for the valleys between the two bells.
TEST_F(ToolpathWorkspace, GougesAreMarkedAndListedAndAClickGoesThere) {
    person_.app().edit("Open the two bells",
                       [](project::Project& p) {
                           p.surface = project::project_from_preset("two-bell").surface;
                           p.machine.file = "router-xyz";
                           p.grid.method = GridMethod::uniform;
                           p.tool = {.cutter = CutterKind::ball, .diameter_mm = 60.0, .length_mm = 100.0};
                       },
                       {});
    person_.app().view_state().shown = GridMethod::uniform;
    person_.wait_idle();
    ASSERT_TRUE(plan().cut);
    ASSERT_FALSE(plan().cut->bites.empty());
    person_.click("lower/tabs/gouges");
    const plan::BlockBite& first = plan().cut->bites.front();
    const std::string row = "lower/gouges/cutter_" + std::to_string(first.block);
    ASSERT_TRUE(person_.sees(row));
    person_.click(row);
    EXPECT_EQ(person_.app().look().block(), first.block);
    person_.keep("toolpath-gouges");
    person_.app().run("view.layer_scallops");
    person_.frames(3);
    person_.keep("toolpath-scallops");
    const render::Picture with = person_.picture_of("view/iso");
    person_.app().run("view.layer_gouges");
    person_.frames(3);
    EXPECT_NE(person_.picture_of("view/iso"), with);
}

TEST_F(ToolpathWorkspace, TheBestPlaceIsSearchedMarkedAndAccepted) {
    fold({"error", "strategy", "tool", "setup", "set_up_search"});
    EXPECT_FALSE(person_.refusal("inspector/set_up_search/set_up_accept").empty());
    person_.fill_in("inspector/set_up_search/places", "5");
    person_.app().view_state().set_up.settings.nodes = 6;
    person_.click("inspector/set_up_search/set_up_search");
    person_.wait_idle();
    const auto found = person_.app().look().set_up;
    ASSERT_TRUE(found && found->study);
    EXPECT_TRUE(person_.sees("inspector/set_up_search/map"));
    person_.keep("toolpath-set-up");
    const double before = person_.app().look().evaluation(GridMethod::uniform)->closest.mean;
    person_.click("inspector/set_up_search/set_up_accept");
    person_.wait_idle();
    EXPECT_EQ(person_.project().machine.workpiece_offset, Vec3(found->study->search.best.place.head<3>()));
    EXPECT_LT(person_.app().look().evaluation(GridMethod::uniform)->closest.mean, before);
    const std::string accept = "inspector/set_up_search/set_up_accept";
    EXPECT_EQ(person_.refusal(accept), "The part is already there.");
    person_.keep("toolpath-set-up-accepted");
    person_.press_key(render::Key::z, true);
    person_.wait_idle();
    EXPECT_TRUE(person_.refusal(accept).empty());
    EXPECT_NE(person_.project().machine.workpiece_offset, Vec3(found->study->search.best.place.head<3>()));
}

TEST_F(ToolpathWorkspace, ASearchInVainSaysThatNoPlaceIsInReach) {
    person_.app().edit("Enlarge the part",
                       [](project::Project& p) {
                           for (geometry::ControlNet& net : p.surface.patches) {
                               for (Vec3& point : net.points) {
                                   point *= 20.0;
                               }
                           }
                       },
                       {});
    fold({"error", "strategy", "tool", "setup", "set_up_search"});
    person_.fill_in("inspector/set_up_search/places", "3");
    person_.app().view_state().set_up.settings.nodes = 4;
    person_.click("inspector/set_up_search/set_up_search");
    person_.wait_idle();
    EXPECT_TRUE(person_.sees("inspector/set_up_search/failure"));
    EXPECT_FALSE(person_.sees("inspector/set_up_search/map"));
    EXPECT_FALSE(person_.refusal("inspector/set_up_search/set_up_accept").empty());
    person_.keep("toolpath-set-up-out-of-reach");
}

TEST_F(ToolpathWorkspace, APlaceOnTheMapIsMarkedByAClick) {
    fold({"error", "strategy", "tool", "setup", "set_up_search"});
    person_.app().view_state().set_up.settings.nodes = 5;
    person_.app().view_state().set_up.settings.places = 5;
    person_.click("inspector/set_up_search/set_up_search");
    person_.wait_idle();
    const toolpath::SetUpPlace best = person_.app().look().set_up_place();
    const widgets::Rect map = person_.place("inspector/set_up_search/map");
    person_.click_at({map.x + 0.5F * map.w, map.y + 0.5F * map.h});
    const toolpath::SetUpPlace marked = person_.app().look().set_up_place();
    EXPECT_NE(marked.head<2>(), best.head<2>());
    EXPECT_EQ(marked[2], best[2]);
    person_.click("inspector/set_up_search/set_up_accept");
    EXPECT_EQ(person_.project().machine.workpiece_offset, Vec3(marked.head<3>()));
}

TEST_F(ToolpathWorkspace, BothResultsOfAComparisonHaveTheirMarks) {
    person_.app().edit("Change the tool",
                       [](project::Project& p) {
                           p.tool.cutter = CutterKind::ball;
                           p.tool.diameter_mm = 60.0;
                       },
                       {});
    person_.wait_idle();
    person_.choose("inspector/error/beside", "uniform");
    const auto look = [&] { return person_.app().look(); };
    const auto right = plan().cut_of(look().project, look().shown().get());
    const auto left = plan().cut_of(look().project, plan().grid(GridMethod::uniform).evaluation.get());
    ASSERT_TRUE(left && right);
    EXPECT_NE(left, right);
    EXPECT_FALSE(left->bites.empty());
    EXPECT_FALSE(right->bites.empty());
    person_.keep("toolpath-beside-gouges");
    const render::Picture with_left = person_.picture_of("view/left/left");
    const render::Picture with_right = person_.picture_of("view/right/right");
    person_.app().run("view.layer_gouges");
    person_.frames(3);
    EXPECT_NE(person_.picture_of("view/left/left"), with_left);
    EXPECT_NE(person_.picture_of("view/right/right"), with_right);
}

TEST_F(ToolpathWorkspace, AnyTwoResultsStandBesideEachOtherInTheSameColours) {
    person_.choose("inspector/error/beside", "uniform");
    EXPECT_TRUE(person_.sees("view/left/left"));
    EXPECT_TRUE(person_.sees("view/right/right"));
    person_.keep("toolpath-beside");
    person_.click("inspector/error/view_keep_result");
    ASSERT_TRUE(person_.app().view_state().kept);
    EXPECT_TRUE(person_.app().view_state().compare_with.kept);
    const auto kept = person_.app().view_state().kept->evaluation;
    person_.app().edit("Choose the machine", [](project::Project& p) { p.machine.file = "ac-table"; }, {});
    person_.wait_idle();
    EXPECT_EQ(person_.app().view_state().kept->evaluation, kept);
    EXPECT_NE(person_.app().look().shown(), kept);
    person_.keep("toolpath-beside-machines");
    person_.choose("inspector/error/beside", "nothing");
    EXPECT_FALSE(person_.sees("view/left/left"));
}

TEST_F(ToolpathWorkspace, TwoSetUpsAreToldApartAndHaveTheSameLegendsAndMaps) {
    person_.app().edit("Choose the machine", [](project::Project& p) { p.machine.file = "ac-table"; }, {});
    person_.wait_idle();
    person_.app().run("set_up.search");
    person_.wait_idle();
    person_.keep("toolpath-set-up-map");
    person_.click("inspector/error/view_keep_result");
    person_.app().edit("Move the part on the table",
                       [](project::Project& p) { p.machine.workpiece_offset = Vec3(12.5, 0.0, 30.0); },
                       {});
    person_.wait_idle();
    const auto& kept = *person_.app().view_state().kept;
    EXPECT_NE(kept.place, person_.app().look().part_place());
    EXPECT_EQ(person_.app().look().part_place(), "part at 12.5, 0, 30 mm");
    for (const char* legend : {"view/legend", "view/set_up_legend"}) {
        const widgets::Rect place = person_.place(legend);
        for (const char* picture : {"view/left/left", "view/right/right"}) {
            EXPECT_GE(place.y, person_.place(picture).bottom()) << legend << " over " << picture;
        }
    }
    EXPECT_NEAR(person_.place("view/left/left").h, person_.place("view/right/right").h, 1.0F);
    person_.keep("toolpath-beside-set-ups");
}

/// Of the view and of what covers it.
TEST(SmallToolpath, LegendsLeaveMostOfTheViewFree) {
    Person person({1100, 700});
    person.open("assets/projects/two-bell.json");
    person.app().run("view.toolpath");
    person.app().run("set_up.search");
    person.wait_idle();
    const widgets::Rect view = person.place("view");
    float covered = 0.0F;
    for (const char* legend : {"view/legend", "view/set_up_legend"}) {
        const widgets::Rect place = person.place(legend);
        covered += place.w * place.h;
        EXPECT_GE(place.y, view.bottom() - 40.0F) << "in a strip";
    }
    EXPECT_LT(covered, 0.1F * view.w * view.h);
    person.keep("small-set-up-map");
}

} // namespace
} // namespace millwright::panels
