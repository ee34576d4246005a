// The simulation of material removal in the window, driven by real mouse and keys, drawn in real OpenGL.
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/geometry/glb.h"
#include "core/project/project_file.h"
#include "tests/ui/person/person.h"
#include "ui/simulation_panels/simulation_notices.h"
#include "ui/workspaces/stock_workspace.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <chrono>
#include <cstdlib>
#include <filesystem>
#include <memory>
#include <numeric>
#include <string>

namespace millwright::panels {
namespace {

using test::Person;

constexpr const char* in_panel = "inspector/simulation/";

/// A small dome with a ball, in the Toolpath workspace, with the section of the simulation open.
class SimulationPanel : public ::testing::Test {
protected:
    SimulationPanel() { begin({1600, 1000}); }

    void begin(const render::PixelSize& screen) {
        person_.reset(); // its context goes before the next one comes
        person_ = std::make_unique<Person>(screen);
        person().app().edit(
            "Take a ball",
            [](project::Project& p) {
                p.tool = {.cutter = toolpath::CutterKind::ball, .diameter_mm = 12.0, .length_mm = 60.0};
            },
            {});
        person().app().view_state().stock.settings.resolution = 1.5;
        person().press_key(render::Key::f4);
        person().wait_idle();
        person().click("inspector/simulation");
        person().frames(3);
    }

    void simulate() {
        person().click(at("simulation_run"));
        person().wait_idle();
        ASSERT_NE(stock().view().result, nullptr);
        ASSERT_NE(stock().view().picture, nullptr);
    }

    /// At a resolution that takes far longer than the frames of a test.
    void begin_long_simulation() {
        person().fill_in(at("resolution"), "0.06");
        person().app().run("simulation.run");
        person().frames(2);
        ASSERT_TRUE(stock().activity().busy);
    }

    [[nodiscard]] bool ends() {
        return person().live_until([this] { return !stock().activity().busy; });
    }

    [[nodiscard]] static std::string at(const std::string& id) { return in_panel + id; }
    [[nodiscard]] Person& person() { return *person_; }
    [[nodiscard]] actions::StockWorkspace& stock() { return person().app().stock(); }
    [[nodiscard]] actions::ViewState& view_state() { return person().app().view_state(); }
    [[nodiscard]] int program_end() { return person().app().look().program()->block_count(); }

    std::unique_ptr<Person> person_;
};

TEST_F(SimulationPanel, ShowsWhatIsLeftWithItsFiguresAndLegend) {
    EXPECT_FALSE(person().sees("view/stock_legend"));
    EXPECT_FALSE(person().sees(at("removed")));
    simulate();
    EXPECT_EQ(stock().view().picture->block, program_end()) << "a new result is shown at its end";
    for (const char* figure : {"removed", "gouge", "excess", "within", "air"}) {
        EXPECT_TRUE(person().sees(at(figure))) << figure;
    }
    EXPECT_TRUE(person().sees("view/stock_legend"));
    person().keep("simulation-dark-1600x1000");
    const render::Picture with = person().picture_of("view/iso");
    person().click(at("shown"));
    person().frames(3);
    EXPECT_NE(person().picture_of("view/iso"), with);
    EXPECT_FALSE(person().sees("view/stock_legend"));
}

/// What is drawn in place of the surface leaves the top row of the view as it is.
TEST_F(SimulationPanel, AStockIsNotCutOffAtTheTop) {
    simulate();
    const render::Picture with = person().picture_of("view/iso");
    person().click(at("shown"));
    person().frames(3);
    const render::Picture without = person().picture_of("view/iso");
    ASSERT_NE(with, without);
    const auto differ = [&](int x) {
        constexpr int slight = 24; // of 255: what is drawn differs by more from the background
        const render::Pixel a = with.at(x, 1), b = without.at(x, 1);
        return std::abs(a[0] - b[0]) > slight || std::abs(a[1] - b[1]) > slight ||
               std::abs(a[2] - b[2]) > slight;
    };
    for (int x = 0; x < with.size.width; ++x) {
        ASSERT_FALSE(differ(x)) << "column " << x;
    }
}

TEST_F(SimulationPanel, TheForecastFollowsTheResolutionAndForbidsWhatDoesNotFit) {
    ASSERT_TRUE(stock().forecast());
    const std::size_t before = stock().forecast()->bytes;
    person().fill_in(at("resolution"), "0.75");
    person().wait_idle();
    EXPECT_NEAR(static_cast<double>(stock().forecast()->bytes) / static_cast<double>(before), 4.0, 0.3);
    EXPECT_TRUE(person().refusal(at("simulation_run")).empty());
    person().fill_in(at("resolution"), "0.002");
    person().wait_idle();
    EXPECT_NE(person().refusal(at("simulation_run")).find("memory"), std::string::npos);
    person().click(at("auto"));
    person().wait_idle();
    EXPECT_FALSE(view_state().stock.settings.resolution);
    EXPECT_TRUE(person().refusal(at("simulation_run")).empty());
}

TEST_F(SimulationPanel, FollowsTheTimelineForwardsAndBack) {
    simulate();
    const auto end = stock().view().picture;
    const render::Picture whole = person().picture_of("view/iso");
    view_state().playback.time = 0.5 * person().app().look().duration();
    person().wait_idle();
    const auto half = stock().view().picture;
    EXPECT_EQ(half->block, person().app().look().block());
    EXPECT_LT(half->block, end->block);
    EXPECT_NE(half->mesh.points, end->mesh.points);
    EXPECT_NE(person().picture_of("view/iso"), whole);
    person().keep("simulation-half");
    person().app().run("play.forward");
    person().wait_idle();
    EXPECT_EQ(stock().view().picture->block, person().app().look().block());
    EXPECT_GT(stock().view().picture->block, half->block);
    person().app().run("play.last");
    person().wait_idle();
    EXPECT_EQ(stock().view().picture->block, end->block);
    EXPECT_EQ(stock().view().picture->mesh.points, end->mesh.points);
}

TEST_F(SimulationPanel, TheToleranceChangesColoursAndShares) {
    simulate();
    ASSERT_TRUE(stock().comparison());
    const double within = stock().comparison()->within;
    const render::Picture before = person().picture_of("view/iso");
    person().fill_in(at("tolerance"), "1");
    person().wait_idle();
    EXPECT_GT(stock().comparison()->within, within);
    EXPECT_NE(person().picture_of("view/iso"), before);
}

TEST_F(SimulationPanel, TheHeightUnderTheMouseIsNamed) {
    simulate();
    person().hover(person().place("view/iso").centre());
    person().frames(3);
    EXPECT_TRUE(person().sees("view/hint") || person().sees("view/iso/hint"));
    person().keep("simulation-hint");
}

TEST_F(SimulationPanel, ACollisionIsListedAndAClickGoesThere) {
    person().app().edit("Take a short tool with a wide holder",
                        [](project::Project& p) {
                            p.tool.length_mm = 14.0;
                            p.tool.holder_diameter_mm = 80.0;
                            p.tool.holder_length_mm = 40.0;
                        },
                        {});
    person().wait_idle();
    simulate();
    const auto& events = stock().view().result->events;
    ASSERT_FALSE(events.empty());
    ASSERT_EQ(events.front().kind, plan::StockEventKind::collision);
    person().click(at("list"));
    person().frames(3);
    EXPECT_EQ(view_state().lower_tab_now(), actions::LowerTab::collisions);
    ASSERT_TRUE(person().sees("lower/collisions/event_0"));
    person().click("lower/collisions/event_0");
    person().frames(3);
    const auto trajectory = person().app().look().trajectory();
    EXPECT_DOUBLE_EQ(view_state().playback.time,
                     trajectory->time_at(events.front().block, events.front().fraction));
    person().wait_idle();
    person().keep("simulation-collisions");
    EXPECT_THAT(person().desktop().ui().cut_texts(), ::testing::IsEmpty());
}

TEST_F(SimulationPanel, AStockThatNoMoveMeetsIsWarnedOf) {
    simulate();
    EXPECT_FALSE(person().sees(at("warning_0")));
    person().choose(at("stock"), "text");
    person().fill_in(at("stock_text"), "box:30,40,50@300,300,-50");
    person().wait_idle();
    simulate();
    ASSERT_EQ(stock().view().result->warnings.size(), 1U);
    person().keep("simulation-misses-the-stock");
    EXPECT_TRUE(person().sees(at("warning_0")));
}

TEST_F(SimulationPanel, WhatWasNotCheckedCanBeListedWithoutAnyCollision) {
    person().fill_in(at("clearance"), "0");
    person().choose(at("stock"), "text");
    person().fill_in(at("stock_text"), "box:5,5,2@48,48,0.5"); // below every move
    person().wait_idle();
    simulate();
    const auto& events = stock().view().result->events;
    ASSERT_TRUE(events.empty()) << events.front().bodies;
    ASSERT_FALSE(stock().view().result->unchecked.empty()) << "the tool has no holder";
    person().click(at("list"));
    person().frames(3);
    EXPECT_EQ(view_state().lower_tab_now(), actions::LowerTab::collisions);
    person().keep("simulation-unchecked");
    EXPECT_THAT(person().desktop().ui().cut_texts(), ::testing::IsEmpty());
}

TEST_F(SimulationPanel, WhatWasChosenSinceIsSaidToNeedAnotherSimulation) {
    simulate();
    const auto height_above = [this] {
        return person().place(at("removed")).y - person().place(at("clearance")).y;
    };
    const float before = height_above();
    person().fill_in(at("clearance"), "2");
    person().frames(3);
    EXPECT_GT(height_above(), before) << "a note comes in above the figures";
    person().keep("simulation-other-settings");
    person().fill_in(at("clearance"), "1");
    person().frames(3);
    EXPECT_FLOAT_EQ(height_above(), before);
}

TEST_F(SimulationPanel, WhatIsCancelledLeavesTheProjectAndTheLastResult) {
    simulate();
    const auto before = stock().view().result;
    const project::Project project = person().project();
    person().fill_in(at("resolution"), "0.1");
    person().app().run("simulation.run");
    EXPECT_TRUE(stock().activity().busy);
    person().frames(2);
    ASSERT_TRUE(person().sees(at("work")));
    person().app().run("simulation.cancel");
    person().wait_idle();
    EXPECT_EQ(stock().view().result, before);
    EXPECT_EQ(person().project(), project);
}

TEST_F(SimulationPanel, AChangedProgramTakesThePictureAway) {
    simulate();
    person().app().edit("More nodes", [](project::Project& p) { p.grid.nu = 7; }, {});
    person().wait_idle();
    EXPECT_FALSE(actions::stock_is_current(person().app().look()));
    EXPECT_FALSE(person().sees("view/stock_legend"));
    EXPECT_FALSE(person().sees(at("removed")));
}

// Its figures were those of the result before, whose blocks the new program does not have.
TEST_F(SimulationPanel, AResultThatComesBetweenFramesIsShownWholeFromTheNextOnwards) {
    simulate();
    const auto before = stock().view().result;
    person().app().edit("More nodes", [](project::Project& p) { p.grid.nu = 7; }, {});
    person().wait_idle();
    person().app().run("simulation.run");
    stock().wait_idle(); // no frame since
    EXPECT_EQ(stock().view().result, before);
    EXPECT_FALSE(actions::stock_is_current(person().app().look()));
    person().frames(3);
    EXPECT_NE(stock().view().result, before);
    EXPECT_TRUE(actions::stock_is_current(person().app().look()));
}

TEST_F(SimulationPanel, WhatChangesTheProgramMeanwhileCancelsIt) {
    begin_long_simulation();
    person().app().edit("More nodes", [](project::Project& p) { p.grid.nu = 7; }, {});
    ASSERT_TRUE(ends());
    person().wait_idle();
    EXPECT_EQ(stock().view().result, nullptr);
    EXPECT_THAT(view_state().log, ::testing::Contains(::testing::HasSubstr("Simulation cancelled")));
    person().fill_in(at("resolution"), "1.5");
    simulate();
    EXPECT_TRUE(actions::stock_is_current(person().app().look()));
}

TEST_F(SimulationPanel, AnotherProjectCancelsItAndBeginsAnew) {
    simulate();
    const auto before = stock().view().result;
    begin_long_simulation();
    person().app().open(test::dome_project);
    ASSERT_TRUE(ends());
    person().wait_idle();
    EXPECT_EQ(stock().view().result, before);
    EXPECT_EQ(stock().view().picture, nullptr) << "its memory is needed no more";
    EXPECT_FALSE(actions::stock_is_current(person().app().look()));
    EXPECT_FALSE(person().sees("view/stock_legend"));
    EXPECT_NE(person().refusal(at("simulation_run")).find("point"), std::string::npos);
}

TEST_F(SimulationPanel, TheWindowClosesWhileItRuns) {
    begin_long_simulation();
    const auto begin = std::chrono::steady_clock::now();
    person_.reset();
    EXPECT_LT(std::chrono::steady_clock::now() - begin, std::chrono::seconds(20));
}

TEST_F(SimulationPanel, APointAndAWrongStockAreRefused) {
    person().app().edit("Take a point", [](project::Project& p) { p.tool = {}; }, {});
    person().wait_idle();
    EXPECT_NE(person().refusal(at("simulation_run")).find("point"), std::string::npos);
    person().choose(at("stock"), "text");
    const project::StockInput before = person().project().stock;
    person().fill_in(at("stock_text"), "brick");
    person().wait_idle();
    EXPECT_EQ(person().project().stock, before);
}

TEST_F(SimulationPanel, TheStockIsOfTheProjectAndCanBeUndone) {
    simulate();
    const project::StockInput before = person().project().stock;
    const auto program = person().app().look().program();
    person().choose(at("stock"), "text");
    person().fill_in(at("stock_text"), "cylinder:120,40@50,50,-10");
    person().wait_idle();
    EXPECT_FALSE(person().project().stock.around_part);
    EXPECT_EQ(person().project().stock.shape, "cylinder:120,40@50,50,-10");
    EXPECT_EQ(person().app().look().program(), program) << "no plan depends on the stock";
    EXPECT_TRUE(person().app().look().program_is_final());
    const auto file = person().folder() / "saved.json";
    person().app().save(file);
    EXPECT_EQ(project::read_project(file).stock, person().project().stock);
    person().app().run("edit.undo");
    person().app().run("edit.undo");
    person().wait_idle();
    EXPECT_EQ(person().project().stock, before);
    person().app().run("edit.redo");
    person().app().run("edit.redo");
    person().wait_idle();
    simulate();
    EXPECT_EQ(stock().view().result->stock_text.find("cylinder"), 0U) << stock().view().result->stock_text;
}

TEST_F(SimulationPanel, AFlatPartIsRefusedAtTheButton) {
    person().app().edit("Flatten",
                        [](project::Project& p) {
                            for (geometry::ControlNet& net : p.surface.patches) {
                                for (Vec3& point : net.points) {
                                    point.z() = 0.0;
                                }
                            }
                        },
                        {});
    person().wait_idle();
    EXPECT_EQ(person().refusal(at("simulation_run")), "");
    person().fill_in(at("allowance"), "0");
    person().wait_idle();
    EXPECT_THAT(person().refusal(at("simulation_run")), ::testing::HasSubstr("flat"));
    person().keep("simulation-flat");
}

TEST_F(SimulationPanel, TheHistogramIsOfTheWholeArea) {
    EXPECT_TRUE(stock().histogram().shares.empty());
    simulate();
    const auto& shares = stock().histogram().shares;
    EXPECT_NEAR(std::accumulate(shares.begin(), shares.end(), 0.0), 1.0, 1e-9);
    double gouged = 0.0;
    for (std::size_t n = 0; n < shares.size() / 2; ++n) {
        gouged += shares[n];
    }
    EXPECT_LT(gouged, 0.5) << "a ball leaves more than it gouges";
    EXPECT_TRUE(person().sees(at("histogram")));
    EXPECT_TRUE(person().sees(at("left")));
}

TEST_F(SimulationPanel, RemovalRateAndEngagementAreOverTheTimeline) {
    person().press_key(render::Key::f5);
    person().wait_idle();
    view_state().lower_tab_now() = actions::LowerTab::motion;
    person().frames(3);
    EXPECT_FALSE(person().sees("lower/shown/rate"));
    simulate();
    person().frames(3);
    person().click("lower/shown/rate");
    person().frames(3);
    person().keep("simulation-rate");
    const render::Picture rate = person().picture_of("lower/motion");
    person().click("lower/shown/engagement");
    person().frames(3);
    EXPECT_NE(person().picture_of("lower/motion"), rate);
    person().keep("simulation-engagement");
    EXPECT_THAT(person().desktop().ui().cut_texts(), ::testing::IsEmpty());
    person().app().edit("More nodes", [](project::Project& p) { p.grid.nu = 7; }, {});
    person().wait_idle();
    EXPECT_FALSE(person().sees("lower/shown/rate")) << "it is of another program";
}

TEST_F(SimulationPanel, ASectionLooksInsideAndCanBeMoved) {
    simulate();
    const render::Picture whole = person().picture_of("view/iso");
    person().click(at("section"));
    person().frames(3);
    const render::Picture middle = person().picture_of("view/iso");
    EXPECT_NE(middle, whole);
    person().keep("simulation-section");
    person().fill_in(at("section_at"), "20");
    person().frames(3);
    EXPECT_DOUBLE_EQ(view_state().stock.section.at, 20.0);
    EXPECT_NE(person().picture_of("view/iso"), middle);
    person().choose(at("section_axis"), "x");
    person().frames(3);
    person().keep("simulation-section-x");
    EXPECT_EQ(view_state().stock.section.axis, 0);
    person().click(at("section"));
    person().frames(3);
    EXPECT_EQ(person().picture_of("view/iso"), whole);
}

TEST_F(SimulationPanel, TheLayerListShowsAndHidesTheStock) {
    person().click("view/layers");
    EXPECT_NE(person().refusal("view/layers/stock"), "") << "nothing has been simulated";
    person().click("outline");
    simulate();
    person().click("view/layers");
    person().click("view/layers/stock");
    person().frames(3);
    EXPECT_FALSE(view_state().stock.shown);
    EXPECT_FALSE(person().sees("view/stock_legend"));
    person().keep("simulation-layers");
}

TEST_F(SimulationPanel, TheCutPartIsExportedWithItsColours) {
    EXPECT_NE(person().app().catalogue().find("simulation.export").permission(person().app().look()).reason,
              "");
    simulate();
    const std::filesystem::path folder = person().folder();
    person().click(at("simulation_export"));
    person().frames(3);
    ASSERT_TRUE(person().sees("dialogs/files/name"));
    person().keep("simulation-export");
    person().press_key(render::Key::escape);
    const auto& mesh = stock().view().picture->mesh;
    stock().export_cut(folder / "cut.stl", 0.1);
    EXPECT_EQ(std::filesystem::file_size(folder / "cut.stl"), 84 + 50 * mesh.triangles.size());
    stock().export_cut(folder / "cut.ply", 0.1);
    EXPECT_EQ(read_file(folder / "cut.ply").rfind("ply\n", 0), 0U);
    stock().export_cut(folder / "cut.glb", 0.1);
    const auto bodies = geometry::parse_glb(read_file(folder / "cut.glb"), "cut.glb");
    ASSERT_EQ(bodies.size(), 1U);
    std::size_t triangles = 0;
    for (const geometry::SolidMesh& part : bodies.front().meshes) {
        triangles += part.triangles.size();
    }
    EXPECT_EQ(triangles, mesh.triangles.size());
    EXPECT_GT(bodies.front().meshes.size(), 2U) << "cut, within and excess differ";
    EXPECT_THROW(stock().export_cut(folder / "cut.txt", 0.1), Error);
}

TEST_F(SimulationPanel, IsInTheProgramWorkspaceToo) {
    simulate();
    person().press_key(render::Key::f5);
    person().wait_idle();
    EXPECT_TRUE(person().sees("view/stock_legend"));
    EXPECT_TRUE(person().sees("inspector/simulation"));
    person().keep("simulation-program");
}

TEST_F(SimulationPanel, FitsSmallScreensInBothThemes) {
    begin({1280, 800});
    simulate();
    EXPECT_THAT(person().desktop().ui().cut_texts(), ::testing::IsEmpty());
    person().keep("simulation-dark-1280x800");
    view_state().theme = widgets::Theme::light;
    person().frames(4);
    EXPECT_THAT(person().desktop().ui().cut_texts(), ::testing::IsEmpty());
    person().keep("simulation-light-1280x800");
}

} // namespace
} // namespace millwright::panels
