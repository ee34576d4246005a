// The Plot & Picture workspace with real mouse and keys in real OpenGL.
#include "core/base/files.h"
#include "core/emulators/stream/stream_emulator.h"
#include "core/jobs/recovery.h"
#include "core/kinematics/machine_file.h"
#include "core/plan/plot_time.h"
#include "core/plot/path_file.h"
#include "core/project/assets.h"
#include "tests/ui/person/at_machine.h"
#include "tests/ui/person/plot_person.h"
#include "tests/ui/person/table_bench.h"
#include "ui/window/window.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <ranges>
#include <string>
#include <utility>
#include <vector>

namespace millwright::panels {
namespace {

using actions::FrameState;
using actions::Workspace;
using test::Person;
using testing::HasSubstr;

namespace fs = std::filesystem;

using test::PlotPerson;

TEST(PlotWorkspace, OpensWhatIsDroppedAndShowsEveryPart) {
    PlotPerson bench("assets/samples/plot/hatched-sign.plt");
    EXPECT_EQ(bench.person.app().view_state().workspace, Workspace::plot);
    ASSERT_FALSE(bench.made().failure);
    for (const char* path : {"layers/levels",
                             "layers/level/depth_mm",
                             "layers/figures/compared/thesis",
                             "layers/figures/compared/planner",
                             "inspector/cutter/tool_mm",
                             "inspector/fill/hatch_mm",
                             "inspector/travel/link_mm",
                             "lower/materials",
                             "timeline/timeline/play"}) {
        EXPECT_TRUE(bench.person.sees(path)) << path;
    }
    EXPECT_TRUE(bench.person.app().look().in_file()); // its program can be played
    EXPECT_GT(bench.person.app().look().duration(), 60.0);
    bench.person.keep("plot");
}

// As on the command line, which plans the written text.
TEST(PlotWorkspace, TheTimeOfThePlannerIsThatOfTheTextThatIsWritten) {
    PlotPerson bench("assets/samples/plot/hatched-sign.plt", {1600, 1200});
    const auto of_text = [&] {
        posts::ReleasedText released;
        released.listing.text = bench.made().program->listing->text;
        const auto machine =
            kinematics::read_machine(project::machine_path(bench.plot().settings().machine, ".", "assets"));
        return plan::seconds_of_text(released, {}, machine, "p.ngc");
    };
    const double before = of_text();
    EXPECT_NEAR(bench.person.app().look().duration(), before, 1e-6);
    bench.person.fill_in("inspector/travel/link_mm", "3");
    bench.settle();
    EXPECT_TRUE(bench.plot().is_current(bench.made()));
    const double linked = of_text();
    EXPECT_LT(linked, 0.95 * before) << "fewer lifts";
    EXPECT_NEAR(bench.person.app().look().duration(), linked, 1e-6);
    // The path with all its decimals takes another time than what is written of it.
    bench.person.fill_in("inspector/work/origin_x_mm", "30.123456");
    bench.settle();
    EXPECT_TRUE(bench.plot().is_current(bench.made()));
    EXPECT_GT(std::abs(of_text() - linked), 0.01);
    EXPECT_NEAR(bench.person.app().look().duration(), of_text(), 1e-6);
}

TEST(PlotWorkspace, PlayingShowsWhereTheToolIsHowFarItHasGoneAndWhatRemains) {
    PlotPerson bench("assets/samples/plot/everyday.plt", {1600, 1200});
    for (const char* path : {"layers/position/gone", "layers/position/left", "layers/position"}) {
        EXPECT_TRUE(bench.person.sees(path)) << path;
    }
    const FrameState begun = bench.person.app().look();
    ASSERT_GT(begun.duration(), 0.0);
    EXPECT_DOUBLE_EQ(begun.time(), 0.0);
    bench.person.click("timeline/timeline/last");
    bench.person.frames(3);
    const FrameState done = bench.person.app().look();
    EXPECT_NEAR(done.time(), begun.duration(), 1e-6);
    const motion::Trajectory& way = *done.opened->motion->trajectory;
    EXPECT_NEAR(way.part_length_at(done.time()), way.part_length(), 1e-6);
    EXPECT_GT(way.part_length(), 250.0); // what the plot draws, and travel
}

// "Travelled" and "Travel incl. lifts": one number, of the program that is played.
TEST(PlotWorkspace, TheWayThatIsToldIsTheOneThatIsGone) {
    PlotPerson bench("assets/samples/plot/hatched-sign.plt");
    const auto differ = [&] {
        const motion::Trajectory& gone = *bench.person.app().look().opened->motion->trajectory;
        const plot::PathLengths told = bench.made().lengths;
        return std::abs(told.cut + told.travel - gone.part_length());
    };
    EXPECT_LT(differ(), 0.1); // targets have four decimals
    bench.person.fill_in("inspector/work/origin_x_mm", "30");
    bench.settle();
    EXPECT_LT(differ(), 0.1);
}

TEST(PlotWorkspace, LinkingAndShorteningAreSeenAtOnceInLiftsAndTime) {
    PlotPerson bench("assets/samples/plot/hatched-sign.plt");
    const plot::WorkTime before = bench.made().as_planned;
    bench.person.fill_in("inspector/travel/link_mm", "3");
    bench.settle();
    const plot::WorkTime linked = bench.made().as_planned;
    EXPECT_LT(linked.runs, before.runs);
    EXPECT_LT(linked.seconds, before.seconds);
    EXPECT_NEAR(linked.distance(), before.distance(), 1e-6); // as in the thesis
    bench.person.click("inspector/travel/order");
    bench.settle();
    EXPECT_LT(bench.made().as_planned.seconds, linked.seconds);
}

TEST(PlotWorkspace, ThePlannersTimeIsToldWithLinksAndWithout) {
    PlotPerson bench("assets/samples/plot/hatched-sign.plt");
    EXPECT_TRUE(bench.made().cut_as_drawn);
    const double alone = bench.person.app().look().duration();
    bench.person.fill_in("inspector/travel/link_mm", "3");
    bench.settle();
    EXPECT_FALSE(bench.made().cut_as_drawn);
    ASSERT_TRUE(bench.made().drawn_seconds);
    EXPECT_NEAR(*bench.made().drawn_seconds, alone, 3e-3 * alone); // that of the file is rounded and read
    EXPECT_LT(bench.person.app().look().duration(), alone);
    bench.person.keep("plot-planner");
}

TEST(PlotWorkspace, ADrawingBeyondTheTableSaysWhichOriginWouldDo) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    ASSERT_FALSE(bench.made().failure);
    bench.person.fill_in("inspector/work/origin_x_mm", "600");
    bench.settle();
    ASSERT_TRUE(bench.made().failure);
    EXPECT_THAT(to_text(*bench.made().failure), testing::HasSubstr("axis X would have to move to"));
    EXPECT_THAT(to_text(*bench.made().failure), testing::HasSubstr("set the origin to"));
    bench.person.frames(3);
    EXPECT_TRUE(bench.person.sees("layers/failure"));
    EXPECT_NE(bench.person.refusal("inspector/plot_to_machine"), "");
    bench.person.click("lower/tabs/notices");
    bench.person.frames();
    EXPECT_TRUE(bench.person.sees("lower/what_is_wrong"));
    bench.person.fill_in("inspector/work/origin_x_mm", "300");
    bench.settle();
    EXPECT_FALSE(bench.made().failure);
    bench.person.frames(3);
    EXPECT_FALSE(bench.person.sees("lower/what_is_wrong"));
    EXPECT_FALSE(bench.person.sees("layers/failure"));
    EXPECT_EQ(bench.person.refusal("inspector/plot_to_machine"), "");
}

TEST(PlotWorkspace, EachAxisHasItsUnit) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    const auto farthest_cut = [&](Eigen::Index axis) {
        double most = 0.0;
        for (const plot::CutPoint& point : *bench.made().path) {
            most = point.move == plot::CutMove::cut ? std::max(most, point.at[axis]) : most;
        }
        return most;
    };
    const double x = farthest_cut(0);
    const double y = farthest_cut(1);
    bench.person.fill_in("inspector/source/unit_y_mm", "0.05");
    bench.settle();
    EXPECT_NEAR(farthest_cut(0), x, 1e-9);
    EXPECT_NEAR(farthest_cut(1), 2.0 * y, 1e-9);
}

bool yellow(int r, int g, int b) {
    return r > 180 && g > 160 && b < 130;
}

// What lies beyond the machine's travel has no program, and was out of sight as well, since the view stayed.
TEST(PlotWorkspace, ADrawingThatIsMovedStaysInSight) {
    PlotPerson bench("assets/samples/plot/hatched-sign.plt");
    const int before = bench.pixels_like(yellow);
    ASSERT_GT(before, 1000);
    bench.person.fill_in("inspector/work/origin_x_mm", "400");
    bench.settle();
    ASSERT_TRUE(bench.made().failure);                // X ends at 480
    ASSERT_TRUE(bench.person.sees("layers/failure")); // it stood below the levels, out of sight
    EXPECT_LT(bench.person.place("layers/failure").bottom(), 400.0F);
    const int moved = bench.pixels_like(yellow);
    EXPECT_NEAR(moved, before, 0.15 * before);
    bench.person.keep("plot-beyond");
    bench.person.fill_in("inspector/work/origin_x_mm", "0");
    bench.settle();
    EXPECT_NEAR(bench.pixels_like(yellow), before, 0.02 * before); // as it was
    bench.person.fill_in("inspector/source/unit_x_mm", "0.1");     // four times as wide
    bench.settle();
    EXPECT_GT(bench.pixels_like(yellow), before / 2);
}

TEST(PlotWorkspace, LevelsAreEnabledOrderedAndRepeatedByHand) {
    PlotPerson bench("assets/samples/plot/hatched-sign.plt", {1600, 1200});
    const auto levels = bench.plot().levels();
    ASSERT_GE(levels.size(), 2U);
    bench.person.fill_in("layers/level/depth_mm", "2.5");
    bench.settle();
    EXPECT_DOUBLE_EQ(bench.made().levels.front().depth, 2.5);
    const double cut = bench.made().lengths.cut;
    bench.person.click("layers/level/enabled");
    bench.settle();
    EXPECT_FALSE(bench.made().levels.front().enabled);
    EXPECT_LT(bench.made().lengths.cut, cut);
    bench.person.click("layers/level/enabled");
    bench.settle();
    bench.person.click("layers/level/again");
    bench.settle();
    EXPECT_EQ(bench.made().levels.size(), levels.size() + 1);
    EXPECT_GT(bench.made().lengths.cut, cut);
}

TEST(PlotWorkspace, PicturesBecomeReliefsWithALivePreview) {
    PlotPerson bench("assets/samples/pictures/snail.png");
    ASSERT_FALSE(bench.made().failure);
    EXPECT_TRUE(bench.made().picture);
    ASSERT_TRUE(bench.made().look);
    bench.person.fill_in("inspector/source/width_mm", "60");
    bench.settle();
    bench.person.fill_in("inspector/source/depth_mm", "2");
    bench.settle();
    EXPECT_NEAR(static_cast<double>(std::ranges::min(bench.made().look->z)), -2.0, 0.3);
    bench.person.click("inspector/plot_space");
    bench.settle();
    bench.person.keep("plot-relief");
    const auto gray = [&] {
        return bench.pixels_like(
            [](int r, int g, int b) { return std::abs(r - g) < 3 && std::abs(g - b) < 3 && r > 60; });
    };
    const int lit = gray();
    bench.person.click("inspector/light");
    bench.settle();
    EXPECT_GT(gray(), 2 * lit + 1000);
    bench.person.keep("plot-light");
}

TEST(PlotWorkspace, ARegionOfThePictureIsCutAloneAndInItsSize) {
    PlotPerson bench("assets/samples/pictures/snail.png", {1600, 1200});
    bench.person.click("inspector/source/size");
    bench.person.frames();
    bench.person.fill_in("inspector/source/size/pixel_mm", "0.5");
    bench.settle();
    bench.person.fill_in("inspector/source/size/region_width_px", "40");
    bench.settle();
    bench.person.fill_in("inspector/source/size/region_height_px", "20");
    bench.settle();
    ASSERT_FALSE(bench.made().failure);
    const auto x = [](const plot::CutPoint& point) { return point.at.x(); };
    const auto y = [](const plot::CutPoint& point) { return point.at.y(); };
    EXPECT_NEAR(std::ranges::max(*bench.made().path | std::views::transform(x)), 39 * 0.5, 1e-9);
    EXPECT_NEAR(std::ranges::max(*bench.made().path | std::views::transform(y)), 19 * 0.5, 1e-9);
}

TEST(PlotWorkspace, EveryChangeIsAStepThatIsUndoneAndSaved) {
    PlotPerson bench("assets/samples/plot/hatched-sign.plt");
    const fs::path plot = bench.plot().file();
    const double before = bench.made().as_planned.seconds;
    bench.person.fill_in("inspector/travel/link_mm", "3");
    bench.settle();
    bench.person.fill_in("layers/level/depth_mm", "2.5");
    bench.settle();
    EXPECT_EQ(bench.person.app().look().undo_title, "Change Depth");
    const project::PlotInput set = bench.person.project().plot;
    EXPECT_TRUE(bench.person.app().look().changed());
    bench.person.app().save(bench.folder / "sign.json");
    EXPECT_FALSE(bench.person.app().look().changed());

    bench.person.press_key(render::Key::z, true);
    bench.settle();
    EXPECT_DOUBLE_EQ(bench.made().levels.front().depth, 1.0);
    EXPECT_LT(bench.made().as_planned.seconds, before);
    bench.person.press_key(render::Key::z, true);
    bench.settle();
    EXPECT_DOUBLE_EQ(bench.made().as_planned.seconds, before);
    EXPECT_EQ(bench.person.app().look().undo_title, "Open hatched-sign.plt");
    bench.person.press_key(render::Key::z, true);
    bench.settle();
    EXPECT_TRUE(bench.plot().file().empty());

    bench.person.open(bench.folder / "sign.json");
    bench.settle();
    EXPECT_EQ(bench.person.project().plot, set);
    EXPECT_EQ(bench.plot().file(), plot);
    EXPECT_DOUBLE_EQ(bench.made().levels.front().depth, 2.5);
}

TEST(PlotWorkspace, MaterialsGiveTheirValuesAndTheirSources) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    bench.person.click("lower/materials/material0");
    bench.settle();
    // Hardwood: 0.003 in for 1/8 inch, in proportion for 3 mm, two edges, 10,000 per minute.
    EXPECT_NEAR(bench.plot().settings().level.cutting, 24.0, 1e-9);
    EXPECT_NEAR(bench.made().levels.front().plunging, 8.0, 1e-9);
    EXPECT_EQ(bench.plot().settings().spindle_rpm, 10'000.0);
    const auto shade = [&bench] { // of its row, beside the words
        bench.person.hover({1.0F, 1.0F});
        bench.person.frames(2);
        const widgets::Rect row = bench.person.place("lower/materials/material0");
        return bench.person.picture().at(static_cast<int>(row.x) + 3, static_cast<int>(row.centre().y));
    };
    const auto chosen = shade();
    bench.person.app().edit(
        "Slower", [](project::Project& draft) { draft.plot.settings.levels.front().cutting = 5.0; }, {});
    bench.settle();
    EXPECT_NE(shade(), chosen) << "these are not its values any more";
}

TEST(PlotWorkspace, ToTheMachineWritesTheProgramAndReplacesNoFile) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    std::ofstream(bench.folder / "everyday.ngc") << "mine\n";
    bench.person.click("inspector/plot_to_machine");
    bench.settle();
    EXPECT_EQ(bench.person.app().view_state().workspace, Workspace::machine);
    EXPECT_TRUE(fs::exists(bench.folder / "everyday-2.ngc"));
    EXPECT_EQ(fs::file_size(bench.folder / "everyday.ngc"), 5U);
    EXPECT_EQ(bench.person.app().look().opened->file.filename(), "everyday-2.ngc");
    EXPECT_TRUE(bench.person.app().look().opened->findings.empty());
}

TEST(PlotWorkspace, WritesThePathThatIsReadBackExactlyAndReplacesNoFile) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    std::ofstream(bench.folder / "everyday.path") << "mine\n";
    bench.person.click("inspector/plot_write_path");
    bench.settle();
    const fs::path written = bench.folder / "everyday-2.path";
    ASSERT_TRUE(fs::exists(written));
    EXPECT_EQ(fs::file_size(bench.folder / "everyday.path"), 5U);
    const plot::CutPath drawn = *bench.made().path;
    EXPECT_EQ(plot::read_path(read_file(written), written), drawn);
    bench.drop(written); // and it is cut as it stands
    EXPECT_EQ(*bench.made().path, drawn);
}

/// Users do not look for programs in the folder of the shipped samples, which may not be writable.
TEST(PlotWorkspace, AProgramOfASampleGoesIntoTheUsersOwnFolder) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    const auto programs_there = [] {
        return std::ranges::count_if(fs::directory_iterator("assets/samples/plot"),
                                     [](const auto& entry) { return entry.path().extension() == ".ngc"; });
    };
    const auto before = programs_there();
    bench.drop(fs::absolute("assets/samples/plot/ticks.plt"));
    bench.person.click("inspector/plot_to_machine");
    bench.settle();
    EXPECT_EQ(bench.person.app().look().opened->file, bench.person.folder() / "programs/ticks.ngc");
    EXPECT_EQ(programs_there(), before);
}

/// Chooses a table at `port` that takes `pattern` and answers by `ok`; nothing is connected yet.
void choose_table(Person& person,
                  const std::string& port,
                  const std::string& pattern = drivers::RecordFormat().pattern) {
    auto& choice = person.app().view_state().manual.choice;
    choice.driver = "records";
    choice.address = port;
    choice.record.emplace();
    choice.record->pattern = pattern;
    choice.record->answer = "ok";
}

/// Runs what `button` begins, going on where it waits for a person, to its end.
jobs::JobOutcome outcome_of(Person& person, const std::string& button) {
    person.frames(3);
    EXPECT_EQ(person.refusal(button), "");
    test::press_run(person, button);
    EXPECT_TRUE(person.live_until(
        [&] {
            const actions::JobView job = person.app().look().job;
            if (job.running && job.report && job.report->driver.state == drivers::DriverState::holding) {
                person.app().run("machine.resume");
            }
            return !job.running && (job.outcome || job.failure);
        },
        60.0));
    const actions::JobView job = person.app().look().job;
    EXPECT_FALSE(job.failure) << to_text(*job.failure);
    return job.outcome.value_or(jobs::JobOutcome());
}

/// Moves of the opened program that records can tell: from where the table stood, by a digit at least.
std::int64_t moves_of(const program::Program& program, kinematics::AxisPositions at) {
    constexpr double half_a_digit = 0.5e-4;
    return std::ranges::count_if(program.blocks, [&](const program::Block& block) {
        const kinematics::AxisPositions from = std::exchange(at, block.moves() ? block.target : at);
        return (at - from).cwiseAbs().maxCoeff() >= half_a_digit;
    });
}

TEST(PlotWorkspace, ProgramsOfPlotsAndPathFilesAreSentByRecords) {
    test::TableBench table;
    PlotPerson bench("assets/samples/plot/autocad-7475.plt");
    bench.person.click("inspector/plot_to_machine");
    bench.settle();
    choose_table(bench.person, table.port());
    test::connect(bench.person);
    const auto start = bench.person.app().look().connection.status.position;
    const auto plot = bench.person.app().look().opened->motion->program;
    const jobs::JobOutcome sent = outcome_of(bench.person, "inspector/job/machine_run");
    EXPECT_EQ(sent.end, jobs::JobEnd::done) << sent.sentence;
    const std::int64_t of_plot = moves_of(*plot, start);
    EXPECT_GT(of_plot, 50);
    EXPECT_EQ(table.records(), of_plot);
    bench.person.keep("plot-by-records");

    // The next begins where the table stands, and goes through the queue.
    std::ofstream(bench.folder / "job.path")
        << "# millwright path 1: absolute; x mm, y mm, z mm, speed mm/s (0: rapid), move, tool\n"
           "1,2,5,0,rapid,1\n1,2,-1,2,plunge,1\n48,2,-1,10,cut,1\n48,2,5,0,rapid,1\n";
    bench.drop(bench.folder / "job.path");
    bench.person.click("inspector/plot_to_machine");
    bench.settle();
    bench.person.click("lower/tabs/queue");
    bench.person.click("lower/queue/queue_add");
    const jobs::JobOutcome queued = outcome_of(bench.person, "lower/queue/queue_run_next");
    EXPECT_EQ(queued.end, jobs::JobEnd::done) << queued.sentence;
    EXPECT_GE(table.records(), of_plot + 4);
    EXPECT_EQ(table.bad_lines(), 0);
    EXPECT_NEAR(table.position()[0], 48.0, 1e-9);
    EXPECT_NEAR(table.position()[1], 2.0, 1e-9);
}

TEST(PlotWorkspace, AJobThatTheTableCannotBeToldEndsInItsLogAndIsNotAskedAbout) {
    test::TableBench table;
    PlotPerson bench("assets/samples/plot/everyday.plt");
    bench.person.click("inspector/plot_to_machine");
    bench.settle();
    choose_table(bench.person, table.port(), "t {X} {Y} {a} {s}"); // Z is missing
    test::connect(bench.person);
    test::press_run(bench.person);
    ASSERT_TRUE(bench.person.live_until([&] { return bench.person.app().look().job.failure.has_value(); }));
    const std::string why = bench.person.app().look().job.failure->message;
    EXPECT_THAT(why, HasSubstr("Z"));
    EXPECT_EQ(table.records() + table.bad_lines(), 0);
    const auto jobs = jobs::read_job_folder(bench.person.folder() / "jobs");
    EXPECT_TRUE(jobs.unreadable.empty());
    for (const jobs::JobStory& job : jobs.jobs) {
        EXPECT_FALSE(job.broken_off()) << job.sentence;
    }
    Person next({1280, 800}, {}, bench.person.folder() / "jobs");
    next.wait_idle();
    EXPECT_FALSE(next.app().look().asks());
}

TEST(PlotWorkspace, ACoordinateStreamTakesNothingFromTheTableByRecords) {
    auto terminal = std::make_unique<links::PseudoTerminal>();
    terminal->open();
    const std::string port = terminal->path().string();
    std::vector<std::unique_ptr<links::Link>> links;
    links.push_back(std::move(terminal));
    auto emulator = std::make_unique<emulators::StreamEmulator>();
    const auto& stream = *emulator;
    const SteadyClock clock;
    emulators::EmulatorServer server(std::move(links), clock, std::move(emulator));
    PlotPerson bench("assets/samples/plot/everyday.plt");
    bench.person.click("inspector/plot_to_machine");
    bench.settle();
    choose_table(bench.person, "");
    bench.person.choose("inspector/connection/driver", "stream");
    bench.person.app().view_state().manual.choice.address = port;
    test::connect(bench.person);
    test::press_run(bench.person);
    const auto truth = [&] {
        return server.with_emulator([&](emulators::Emulator&) { return stream.truth(); });
    };
    ASSERT_TRUE(bench.person.live_until([&] { return truth().samples > 50; })) << truth().first_fault;
    EXPECT_EQ(truth().bad_lines, 0) << truth().first_fault;
    bench.person.app().run("machine.stop");
    ASSERT_TRUE(bench.person.live_until([&] { return !bench.person.app().look().job.running; }));
}

TEST(PlotWorkspace, APathFileShowsItsStrokesOfEachToolAndItsTravel) {
    PlotPerson drawing("assets/samples/plot/hatched-sign.plt");
    plot::CutPath path = *drawing.made().path;
    for (std::size_t n = path.size() / 2; n < path.size(); ++n) {
        path[n].tool = 2;
    }
    const fs::path file = drawing.folder / "sign.path";
    std::ofstream(file) << plot::path_file_text(path);
    PlotPerson bench(file);
    ASSERT_FALSE(bench.made().failure);
    ASSERT_EQ(bench.made().cuts.size(), 2U);
    const auto red = [](int r, int g, int b) { return r > g + 60 && r > b + 60; };
    bench.person.keep("plot-path-file");
    const int drawn = bench.pixels_like(red);
    bench.person.app().view_state().layers_now().path.intended = false;
    bench.person.frames(3);
    EXPECT_GT(drawn, bench.pixels_like(red) + 1000);
    EXPECT_THAT(bench.person.refusal("inspector/fill/hatch_mm"), HasSubstr("cut unchanged"));
    EXPECT_THAT(bench.person.refusal("inspector/travel/order"), HasSubstr("cut unchanged"));
    EXPECT_THAT(bench.person.refusal("inspector/cutter/tool_mm"), testing::IsEmpty()); // how wide it cuts
}

// Elsewhere G-code is a program for the machine; where parts are made of drawings it is one of these.
TEST(PlotWorkspace, GCodeThatIsDroppedHereIsCutAsItStands) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    fs::copy_file("assets/samples/gcode/thesis-3d.ngc", bench.folder / "thesis-3d.ngc");
    bench.drop(bench.folder / "thesis-3d.ngc");
    EXPECT_EQ(bench.person.app().view_state().workspace, Workspace::plot);
    ASSERT_FALSE(bench.made().failure) << to_text(*bench.made().failure);
    EXPECT_NEAR(bench.made().lengths.cut, 438.2848, 1e-2);
    EXPECT_NEAR(bench.made().lengths.travel, 80.2905, 1e-3);
    EXPECT_EQ(bench.made().path->front().at, Vec3(10, 10, 10));
    EXPECT_THAT(bench.person.refusal("inspector/fill/hatch_mm"), HasSubstr("cut unchanged"));
    EXPECT_THAT(bench.person.refusal("inspector/plot_to_machine"), testing::IsEmpty());
    EXPECT_TRUE(bench.person.app().look().in_file()); // its program can be played
    bench.person.keep("plot-gcode");
    bench.person.choose("layers/sample", "thesis-simple.ngc");
    bench.settle();
    EXPECT_NEAR(bench.made().lengths.cut, 74.0, 1e-6);
    std::ofstream(bench.folder / "turn.ngc") << "G0 X0 Y0 Z5\nG1 Z-1 F60\nG1 X9 B20\nM2\n";
    bench.drop(bench.folder / "turn.ngc");
    ASSERT_TRUE(bench.made().failure);
    EXPECT_THAT(to_text(*bench.made().failure), HasSubstr("turn.ngc:3:7"));
    bench.person.press_key(render::Key::f4); // the Toolpath workspace
    bench.drop(bench.folder / "thesis-3d.ngc");
    EXPECT_EQ(bench.person.app().view_state().workspace, Workspace::program);
}

TEST(PlotWorkspace, SaysWhatIsWrongWithAFileAndKeepsWorking) {
    PlotPerson bench("assets/samples/plot/everyday.plt");
    std::ofstream(bench.folder / "junk.png") << "this is no picture";
    bench.drop(bench.folder / "junk.png");
    ASSERT_TRUE(bench.made().failure);
    EXPECT_THAT(to_text(*bench.made().failure), HasSubstr("junk.png"));
    EXPECT_THAT(bench.person.refusal("inspector/plot_to_machine"), HasSubstr("junk.png"));
    bench.drop(bench.folder / "everyday.plt");
    EXPECT_FALSE(bench.made().failure);
}

} // namespace
} // namespace millwright::panels
