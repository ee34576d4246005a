// Points that the Plot & Picture workspace plays to a table, with real mouse and keys in real OpenGL.
#include "core/jobs/job_log.h"
#include "core/links/link.h"
#include "tests/support/reason.h"
#include "tests/ui/person/plot_person.h"
#include "tests/ui/person/table_bench.h"
#include "ui/plot_panels/table_pane.h"
#include "ui/window/view_panel.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <filesystem>
#include <fstream>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::panels {
namespace {

using test::PlotPerson;
using testing::HasSubstr;

TEST(PlotTable, PointsArePlayedWithTheirReadOutAndStoppedAtOnce) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    bench.person.click("lower/tabs/table");
    bench.person.frames();
    bench.person.click("lower/plot_play_table");
    ASSERT_TRUE(bench.person.live_until([&] { return bench.plot().table().view().status.points > 3; }));
    EXPECT_TRUE(bench.person.sees("lower/read_out/X"));
    EXPECT_TRUE(bench.person.sees("lower/histogram"));
    bench.person.frames(2);
    const actions::FrameState moving = bench.person.app().look();
    EXPECT_EQ(table_text(moving), "simulated table: moving");
    ASSERT_TRUE(moving.table_tip());
    EXPECT_NE(*moving.table_tip(), Vec3::Zero());
    EXPECT_TRUE(scene_of(moving).table_tip);
    EXPECT_FALSE(scene_of(moving).opened_now); // the timeline is elsewhere
    EXPECT_TRUE(bench.person.sees("layers/position/points"));
    EXPECT_EQ(bench.person.refusal("timeline/timeline/play"), "The view follows the table.");
    bench.person.keep("plot-table");
    bench.person.click("emergency/machine_emergency_stop");
    ASSERT_TRUE(bench.person.live_until([&] { return !bench.plot().table().playing(); }));
    const auto stopped = bench.plot().table().view();
    // The tool stays where the table is until the timeline goes elsewhere.
    actions::FrameState after = bench.person.app().look();
    EXPECT_EQ(table_text(after), "");
    EXPECT_EQ(after.table_tip(), stopped.status.position);
    bench.person.frames(2);
    bench.person.click("timeline/timeline/last");
    bench.person.frames(2);
    EXPECT_FALSE(bench.person.app().look().table_tip());
    EXPECT_EQ(stopped.status.state, drivers::PlayState::emergency_stop);
    EXPECT_LT(stopped.status.points, stopped.total);
    EXPECT_THAT(stopped.status.sentence, HasSubstr("emergency stop"));
    ASSERT_TRUE(stopped.outcome);
    const jobs::ReadLog log = jobs::read_job_log(stopped.outcome->log_file);
    EXPECT_EQ(log.start.driver, "points");
    EXPECT_EQ(log.end(), jobs::JobEnd::fault);
}

/// Six squares beside each other, a pen each.
void write_six_squares(const std::filesystem::path& file) {
    std::ofstream out(file);
    out << "IN;";
    for (int pen = 1; pen <= 6; ++pen) {
        const int x = 400 * pen;
        out << "SP" << pen << ";PU" << x << ",400;PD" << x + 200 << ",400," << x + 200 << ",600," << x
            << ",600," << x << ",400;PU;";
    }
    out << "SP;";
}

// It was played at Z 0 in the order of the file, pens that are off too, and with one tool.
TEST(PlotTable, PlaysTheLevelsThatAreShownAndRestsAtToolChanges) {
    test::TableBench table({.keep = true});
    PlotPerson bench("assets/samples/plot/everyday.plt");
    write_six_squares(bench.folder / "six.plt");
    bench.drop(bench.folder / "six.plt");
    std::vector<plot::Level> levels = bench.plot().levels();
    ASSERT_EQ(levels.size(), 6U);
    for (plot::Level& level : levels) {
        level.enabled = level.pen != 2;
        level.order = -level.pen;
        level.depth = 0.25 * level.pen;
        level.tool = level.pen == 1 ? 2 : 1;
    }
    bench.person.app().edit("Levels",
                            [&](project::Project& draft) {
                                draft.plot.settings.levels = levels;
                                draft.plot.settings.machine = "router-xyz"; // a faster one
                            },
                            {});
    bench.settle();
    actions::TableChoice choice;
    choice.decoding.velocity = 45.0;
    choice.port = table.port();
    choice.record = {};
    choice.record.answer = "ok";
    bench.plot().set_table(choice);
    bench.person.click("lower/tabs/table");
    bench.person.frames();
    bench.person.click("lower/plot_play_table");
    const auto held = [&] {
        const actions::TableView now = bench.plot().table().view();
        return now.playing && now.status.state == drivers::PlayState::holding;
    };
    ASSERT_TRUE(bench.person.live_until(held, 20.0));
    EXPECT_THAT(bench.plot().table().view().status.sentence, HasSubstr("put in tool 1"));
    EXPECT_EQ(table.records(), 0);
    bench.person.frames(2);
    EXPECT_EQ(table_text(bench.person.app().look()), "table at " + table.port() + ": held");
    EXPECT_EQ(bench.person.refusal("lower/plot_play_table"), "The table is held. Press Resume to continue.");
    // The tip of a button is not over the line that says which tool to put in.
    const widgets::Rect play = bench.person.place("lower/plot_play_table");
    bench.person.hover({play.x + 10.0F, play.y + 5.0F});
    ASSERT_TRUE(bench.person.live_until([&] { return bench.person.sees("tip"); }, 5.0));
    const widgets::Rect tip = bench.person.place("tip");
    const widgets::Rect waiting = bench.person.place("lower/waiting");
    EXPECT_TRUE(tip.bottom() <= waiting.y || tip.y >= waiting.bottom()) << tip.y << " " << waiting.y;
    bench.person.keep("plot-table-tool");
    bench.person.click("lower/plot_resume_table");
    ASSERT_TRUE(bench.person.live_until([&] { return table.records() > 0; }, 20.0));
    ASSERT_TRUE(bench.person.live_until(held, 120.0));
    EXPECT_THAT(bench.plot().table().view().status.sentence, HasSubstr("change to tool 2"));
    bench.person.press_key(render::Key::f11); // as every other machine
    ASSERT_TRUE(bench.person.live_until([&] { return !bench.plot().table().playing(); }, 60.0));
    const actions::TableView end = bench.plot().table().view();
    ASSERT_TRUE(end.outcome) << (end.failure ? to_text(*end.failure) : "");
    EXPECT_EQ(end.outcome->end, jobs::JobEnd::done) << end.outcome->sentence;
    EXPECT_NO_THROW(links::make_link(table.port())->open()); // given back
    std::vector<int> squares;                                // as they were cut
    for (const std::vector<double>& at : table.positions()) {
        const int square = static_cast<int>(at[0] / 10.0);
        if (at[2] < -0.01) {
            EXPECT_GE(at[2], -0.25 * square - 1e-6);
            if (squares.empty() || squares.back() != square) {
                squares.push_back(square);
            }
        }
    }
    EXPECT_THAT(squares, testing::ElementsAre(6, 5, 4, 3, 1));
    const jobs::ReadLog log = jobs::read_job_log(end.outcome->log_file);
    EXPECT_EQ(log.end(), jobs::JobEnd::done);
    EXPECT_EQ(log.start.address, table.port());
}

TEST(PlotTable, ATableIsLedFromWhereItStoppedWithoutAJump) {
    test::TableBench table({.keep = true});
    PlotPerson bench("assets/samples/plot/moves.plt");
    actions::TableChoice choice;
    choice.port = table.port();
    choice.record = {};
    choice.record.answer = "ok";
    bench.person.app().plot().set_table(choice);
    bench.person.click("lower/tabs/table");
    bench.person.frames();
    EXPECT_TRUE(bench.person.sees("lower/begins"));
    bench.person.click("lower/plot_play_table");
    const auto cuts = [&] { return table.position()[0] > 5.0 && table.position()[2] < 0.5; };
    bench.person.frames(3);
    ASSERT_FALSE(bench.plot().table().view().failure) << to_text(*bench.plot().table().view().failure);
    ASSERT_TRUE(bench.person.live_until(cuts, 60.0)) << table.position()[0];
    // The port is the table's while it plays, and anybody's afterwards.
    const std::unique_ptr<links::Link> anybody = links::make_link(table.port());
    EXPECT_THAT(test::reason([&] { anybody->open(); }), HasSubstr("in use, but the system does not report"));
    bench.person.click("lower/plot_stop_table");
    ASSERT_TRUE(bench.person.live_until([&] { return !bench.plot().table().playing(); }));
    EXPECT_NO_THROW(anybody->open());
    anybody->close();
    EXPECT_EQ(bench.plot().table().view().status.state, drivers::PlayState::stopped);
    bench.person.frames(2);
    EXPECT_TRUE(bench.person.sees("lower/begins"));
    const auto first = static_cast<std::size_t>(table.records());
    // What is refused moves no table, nor does what is played for the eyes alone.
    const std::optional<Vec3> place = bench.plot().table().place(choice.port);
    ASSERT_TRUE(place);
    actions::TableChoice other = choice;
    other.decoding.velocity = 500.0;
    for (const bool port : {true, false}) {
        other.port = port ? choice.port : "";
        bench.plot().set_table(other);
        bench.person.frames(2);
        bench.person.click("lower/plot_play_table");
        ASSERT_TRUE(bench.person.live_until([&] { return bench.plot().table().view().failure.has_value(); }));
        EXPECT_EQ(bench.plot().table().place(choice.port), place);
    }
    EXPECT_EQ(static_cast<std::size_t>(table.records()), first);
    bench.plot().set_table(choice);
    bench.person.frames(2);
    bench.person.click("lower/plot_play_table");
    ASSERT_TRUE(bench.person.live_until(
        [&] { return table.records() > static_cast<std::int64_t>(first) + 100; }, 60.0));
    bench.person.app().plot().table().stop();
    const auto went = table.positions();
    const double step = choice.decoding.velocity * choice.decoding.period;
    for (std::size_t n = first; n < first + 100; ++n) {
        const Vec3 before(went[n - 1][0], went[n - 1][1], went[n - 1][2]);
        const Vec3 now(went[n][0], went[n][1], went[n][2]);
        ASSERT_LT((now - before).norm(), 1.01 * step + 1e-3) << n - first;
        if (n < first + 30) { // up first
            ASSERT_LT((now - before).head<2>().norm(), 1e-6) << n - first;
        }
    }
}

// As its program does, above the last stroke.
TEST(PlotTable, PointsEndAtTheSafeHeight) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    std::ofstream(bench.folder / "away.plt") << "IN;SP1;PU400,0;PD800,0;PU;SP;";
    bench.drop(bench.folder / "away.plt");
    bench.person.fill_in("inspector/work/origin_x_mm", "10");
    bench.settle();
    actions::TableChoice choice;
    choice.speed = 100.0;
    bench.plot().set_table(choice);
    bench.person.click("lower/tabs/table");
    bench.person.frames();
    bench.person.click("lower/plot_play_table");
    ASSERT_TRUE(bench.person.live_until(
        [&] { return bench.plot().table().view().status.state == drivers::PlayState::done; }));
    EXPECT_EQ(bench.plot().table().view().status.position,
              Vec3(30.0, 0.0, bench.plot().settings().safe_height));
}

// Programs, path files and reliefs have a path with heights of its own.
TEST(PlotTable, GCodeIsPlayedAtItsOwnHeights) {
    test::TableBench table({.keep = true});
    PlotPerson bench("assets/samples/plot/everyday.plt");
    std::ofstream(bench.folder / "step.ngc") << "G21 G90\nG0 Z4\nG0 X2 Y3\nG1 Z-1 F600\nX12\nG0 Z4\nM2\n";
    bench.drop(bench.folder / "step.ngc");
    ASSERT_FALSE(bench.made().failure) << to_text(*bench.made().failure);
    actions::TableChoice choice;
    choice.port = table.port();
    choice.record = {};
    choice.record.answer = "ok";
    bench.plot().set_table(choice);
    bench.person.click("lower/tabs/table");
    bench.person.frames();
    EXPECT_TRUE(bench.person.sees("lower/begins"));
    EXPECT_EQ(bench.person.refusal("lower/plot_play_table"), "");
    bench.person.click("lower/plot_play_table");
    bench.person.frames(3);
    ASSERT_FALSE(bench.plot().table().view().failure) << to_text(*bench.plot().table().view().failure);
    ASSERT_TRUE(bench.person.live_until(
        [&] { return bench.plot().table().view().status.state == drivers::PlayState::done; }, 60.0));
    const auto went = table.positions();
    EXPECT_EQ(went.front(), (std::vector<double>{0.0, 0.0, 4.0}));
    EXPECT_EQ(went.back(), (std::vector<double>{12.0, 3.0, 4.0}));
    const auto lowest = std::ranges::min_element(went, {}, [](const auto& at) { return at[2]; });
    EXPECT_DOUBLE_EQ((*lowest)[2], -1.0);
    bench.person.keep("plot-table-gcode");
}

// The file that plot decode writes: it was opened as G-code, with an error on each line.
TEST(PlotTable, APointFileIsOpenedShownAndPlayedAsItIs) {
    test::TableBench table({.keep = true});
    PlotPerson bench("assets/samples/plot/everyday.plt");
    std::vector<Vec3> points{{1.0, 2.0, 5.0}};
    for (int n = 0; n < 40; ++n) {
        points.emplace_back(1.0 + 0.1 * n, 2.0, n % 2 == 0 ? -0.5 : -0.4);
        points.back().z() = std::max(points.back().z(), points[points.size() - 2].z() - 0.15);
    }
    {
        std::ofstream out(bench.folder / "points.csv");
        for (const Vec3& point : points) {
            out << point.x() << "," << point.y() << "," << point.z() << "\n";
        }
    }
    bench.drop(bench.folder / "points.csv");
    ASSERT_FALSE(bench.made().failure) << to_text(*bench.made().failure);
    ASSERT_TRUE(bench.made().points);
    EXPECT_FALSE(bench.made().cuts.empty());
    actions::TableChoice choice;
    choice.port = table.port();
    choice.record = {};
    choice.record.answer = "ok";
    bench.plot().set_table(choice);
    bench.person.click("lower/tabs/table");
    bench.person.frames();
    EXPECT_TRUE(bench.person.sees("lower/period"));
    EXPECT_FALSE(bench.person.sees("lower/velocity")); // the points have theirs
    EXPECT_EQ(bench.plot().table_start(), points.front());
    bench.person.click("lower/plot_play_table");
    bench.person.frames(3);
    ASSERT_FALSE(bench.plot().table().view().failure) << to_text(*bench.plot().table().view().failure);
    ASSERT_TRUE(bench.person.live_until(
        [&] { return bench.plot().table().view().status.state == drivers::PlayState::done; }, 60.0));
    const auto went = table.positions();
    ASSERT_EQ(went.size(), points.size());
    for (std::size_t n = 0; n < points.size(); ++n) {
        EXPECT_LT((Vec3(went[n][0], went[n][1], went[n][2]) - points[n]).norm(), 1e-4) << n;
    }
    bench.person.keep("plot-table-points");
}

TEST(PlotTable, WhatIsRefusedIsToldWholeAndInTheWordsOfThePane) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    actions::TableChoice choice;
    choice.decoding.velocity = 500.0;
    bench.plot().set_table(choice);
    bench.person.click("lower/tabs/table");
    bench.person.frames();
    bench.person.click("lower/plot_play_table");
    ASSERT_TRUE(bench.person.live_until([&] { return bench.plot().table().view().failure.has_value(); }));
    bench.person.frames(2);
    EXPECT_TRUE(bench.person.sees("lower/table_failure"));
    const auto failure = bench.plot().table().view().failure;
    ASSERT_TRUE(failure);
    EXPECT_THAT(to_text(*failure), HasSubstr("point 2: axis"));
    EXPECT_THAT(to_text(*failure), HasSubstr("set a lower Velocity"));
    EXPECT_THAT(to_text(*failure), testing::Not(HasSubstr("decode")));
    bench.person.keep("plot-table-refused");
}

} // namespace
} // namespace millwright::panels
