#include "core/plan/plot_work.h"

#include "core/base/error.h"
#include "core/kinematics/machine_file.h"
#include "core/plan/opened_program.h"
#include "core/plan/plot_time.h"
#include "core/plot/path_file.h"
#include "core/project/assets.h"
#include "core/project/plot_settings.h"
#include "tests/support/bmp_shape.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <chrono>
#include <cstdint>
#include <fstream>
#include <set>
#include <string>
#include <string_view>
#include <thread>
#include <vector>

namespace millwright::plan {
namespace {

namespace fs = std::filesystem;
using testing::HasSubstr;

std::shared_ptr<const PlotResult> derived(const project::PlotInput& input) {
    PlotWorker worker("assets", [] {});
    worker.request(input);
    worker.wait_idle();
    return worker.latest();
}

const fs::path everyday = "assets/samples/plot/everyday.plt";

TEST(PlotWork, LevelsThatAreNotSetAreLikeTheUsualOne) {
    project::PlotInput input{"assets/samples/plot/hatched-sign.plt", {}}; // of two pens
    input.settings.level.depth = 2.5;
    const auto usual = derived(input);
    ASSERT_FALSE(usual->failure);
    ASSERT_GE(usual->levels.size(), 2U);
    EXPECT_DOUBLE_EQ(usual->levels[1].depth, 2.5);
    input.settings.levels = {usual->levels[0]};
    input.settings.levels[0].depth = 0.5;
    const auto set = derived(input);
    EXPECT_DOUBLE_EQ(set->levels[0].depth, 0.5);
    EXPECT_DOUBLE_EQ(set->levels[1].depth, 2.5);
}

TEST(PlotWork, TheOriginMovesEverythingThatIsCut) {
    project::PlotInput input{everyday, {}};
    const auto here = derived(input);
    input.settings.origin = {30.0, 40.0};
    const auto there = derived(input);
    ASSERT_EQ(here->path->size(), there->path->size());
    for (std::size_t n = 0; n < here->path->size(); ++n) {
        EXPECT_LT(((*there->path)[n].at - (*here->path)[n].at - Vec3(30.0, 40.0, 0.0)).norm(), 1e-9);
    }
    const Vec3 drawn = there->cuts.front().path.chunks.front()->points.front().position();
    const Vec3 before = here->cuts.front().path.chunks.front()->points.front().position();
    EXPECT_LT((drawn - before - Vec3(30.0, 40.0, 0.0)).norm(), 1e-4); // kept as floats
}

/// Dashed, filled, with an arc, a wrapped number and a closed stroke.
void write_drawing(const fs::path& file) {
    std::ofstream(file) << "IN;SP1;LT2,1;PU0,0;PD2000,0;LT;PU400,400;PD;AA800,400,180;PU;"
                           "PU2000,2000;FT3,80,0;RA2800,2800;SP2;PU40\n0,3000;PD1200,3000,1200,3800,400,3800,"
                           "400,3000;PU;PU1210,3000;PD1400,3000;PU;";
}

/// What a person sees of it: path, look and light, as text that differs where one of them does.
std::string seen(const project::PlotInput& input) {
    const auto made = derived(input);
    if (made->failure) {
        return to_text(*made->failure);
    }
    std::string text = plot::path_file_text(*made->path) + made->input.settings.post;
    text += made->program->listing->text;
    for (const std::uint8_t pixel : made->light.pixels) {
        text += static_cast<char>(pixel);
    }
    return text;
}

/// An L, and a square that ends 0.3 mm before its beginning.
constexpr const char* outlines_with_a_gap = "IN;SP1;PU0,0;PD1600,0,1600,800,800,800,800,1600,0,1600,0,0;"
                                            "PU2000,0;PD2400,0,2400,400,2000,400,2000,12;PU;";

project::PlotInput picture_input(project::PictureUse use) {
    project::PlotInput input{"assets/samples/pictures/boat.png", {}};
    input.settings.use = use;
    input.settings.size.width = 20.0;
    input.settings.step_over = 1.0;
    input.settings.tip.diameter = 2.0;
    input.settings.tip.kind = use == project::PictureUse::halftone ? plot::TipKind::v : plot::TipKind::ball;
    return input;
}

// A field of the window that changed nothing would be a lie.
TEST(PlotWork, EveryNumberOfTheSettingsCounts) {
    const test::ScratchFolder scratch;
    write_drawing(scratch / "drawing.plt");
    project::PlotInput drawing{scratch / "drawing.plt", {}};
    project::PlotInput turned = drawing;
    turned.settings.strokes.hatch_pitch = 1.0;
    turned.settings.strokes.side = plot::CutterSide::inside;
    project::PlotInput framed = picture_input(project::PictureUse::relief);
    framed.settings.frame = 3.0;
    framed.settings.depth_per_pass = 0.4;
    framed.settings.origin = {20.0, 20.0}; // or the frame would leave the table
    project::PlotInput natural = picture_input(project::PictureUse::relief);
    natural.settings.size = {};
    natural.settings.picture.region = plot::PixelRegion{300, 190, 40, 40};
    project::PlotInput coned = picture_input(project::PictureUse::halftone);
    struct Case {
        const project::PlotInput& input;
        std::string_view id;
        double value;
    };
    const project::PlotInput outlines = picture_input(project::PictureUse::outlines);
    const project::PlotInput relief = picture_input(project::PictureUse::relief);
    const project::PlotInput dots = picture_input(project::PictureUse::dots);
    std::ofstream(scratch / "arc.ngc") << "G21 G90\nG0 X10 Y10\nG1 Z-1 F300\nG2 X20 I5\nG0 Z5\nM2\n";
    const project::PlotInput arc{scratch / "arc.ngc", {}};
    project::PlotInput tools = drawing;
    for (int pen = 1; pen <= 2; ++pen) {
        tools.settings.levels.push_back({.pen = pen, .order = pen, .tool = pen});
    }
    std::ofstream(scratch / "outlines.plt") << outlines_with_a_gap;
    project::PlotInput carved{scratch / "outlines.plt", {}};
    carved.settings.drawing_use = project::DrawingUse::carving;
    carved.settings.tip = {plot::TipKind::v, 30.0, 1.0};
    carved.settings.largest_depth = 3.0;
    const std::vector<Case> cases = {{carved, "largest_depth_mm", 2.0},
                                     {carved, "tip_end_mm", 0.5},
                                     {carved, "tip_end_radius_mm", 0.4},
                                     {carved, "tip_angle_deg", 90.0},
                                     {carved, "carving_tolerance_mm", 0.1},
                                     {carved, "close_gaps_mm", 0.5},
                                     {carved, "step_over_mm", 1.0},
                                     {carved, "depth_per_pass_mm", 1.0},
                                     {carved, "safe_height_mm", 7.0},
                                     {tools, "change_x_mm", 7.0},
                                     {tools, "change_y_mm", 7.0},
                                     {tools, "change_z_mm", 40.0},
                                     {arc, "chord_length_mm", 5.0},
                                     {drawing, "unit_x_mm", 0.0249},
                                     {drawing, "unit_y_mm", 0.0249},
                                     {drawing, "arc_tolerance_mm", 0.001},
                                     {relief, "width_mm", 21.0},
                                     {natural, "dpi", 200.0},
                                     {natural, "pixel_mm", 0.3},
                                     {natural, "region_left_px", 305.0},
                                     {natural, "region_top_px", 195.0},
                                     {natural, "region_width_px", 30.0},
                                     {natural, "region_height_px", 0.0},
                                     {relief, "gray_steps", 4.0},
                                     {relief, "pixel_aspect", 1.5},
                                     {outlines, "threshold", 0.95},
                                     {outlines, "speckle_px", 5000.0},
                                     {outlines, "corner", 0.0},
                                     {outlines, "curve_tolerance_px", 5.0},
                                     {outlines, "chords_mm", 0.1},
                                     {relief, "depth_mm", 2.0},
                                     {dots, "dot_pitch_mm", 0.8},
                                     {coned, "dot_angle_deg", 30.0},
                                     {relief, "tip_diameter_mm", 1.0},
                                     {coned, "tip_angle_deg", 90.0},
                                     {relief, "step_over_mm", 0.5},
                                     {relief, "merge_mm", 0.2},
                                     {relief, "depth_per_pass_mm", 0.3},
                                     {framed, "allowance_mm", 0.1},
                                     {framed, "rough_step_over_mm", 0.7},
                                     {framed, "frame_mm", 4.0},
                                     {framed, "frame_margin_mm", 2.0},
                                     {framed, "frame_tabs", 2.0},
                                     {framed, "frame_tab_width_mm", 4.0},
                                     {framed, "frame_tab_height_mm", 0.5},
                                     {turned, "tool_mm", 2.0},
                                     {drawing, "hatch_mm", 1.5},
                                     {turned, "hatch_angle_deg", 30.0},
                                     {drawing, "contours_mm", 3.0},
                                     {drawing, "link_mm", 21.0},
                                     {drawing, "safe_height_mm", 7.0},
                                     {drawing, "plate_mm", 0.5},
                                     {relief, "half_light_mm", 0.5},
                                     {drawing, "spindle_rpm", 5000.0},
                                     {drawing, "origin_x_mm", 3.0},
                                     {drawing, "origin_y_mm", 3.0}};
    std::set<std::string_view> tried;
    for (const Case& one : cases) {
        project::PlotInput changed = one.input;
        project::plot_number(one.id).set(changed.settings, one.value);
        EXPECT_TRUE(seen(changed) != seen(one.input)) << one.id;
        tried.insert(one.id);
    }
    for (const auto& setting : project::plot_numbers()) {
        EXPECT_TRUE(tried.contains(setting.id)) << setting.id;
    }
}

// The gray map has the file's own rows, which a region counts; the cut has square pixels.
TEST(PlotWork, APictureWhosePixelsAreNotSquareIsShownAsItIsCut) {
    const test::ScratchFolder scratch;
    test::write_bmp(scratch / "high.bmp", 256, 256, 10'000, 5'000); // each 0.1 x 0.2 mm
    project::PlotInput input = picture_input(project::PictureUse::relief);
    input.file = scratch / "high.bmp";
    input.settings.size = {};
    const auto whole = derived(input);
    ASSERT_FALSE(whole->failure) << to_text(*whole->failure);
    ASSERT_TRUE(whole->shown_picture);
    EXPECT_EQ(whole->shown_picture->picture.height, 256);
    EXPECT_LT((whole->shown_picture->cell - Vec2(0.1, 0.2)).norm(), 1e-9);
    EXPECT_LT((whole->picture_size - Vec2(25.6, 51.2)).norm(), 1e-9);
    input.settings.picture.region = plot::PixelRegion{30, 100, 60, 50};
    const auto part = derived(input);
    ASSERT_FALSE(part->failure) << to_text(*part->failure);
    EXPECT_LT((part->picture_size - Vec2(6.0, 10.0)).norm(), 1e-9);
    // Its lower left pixel is at the origin: 30 pixels are at its left, 106 below.
    EXPECT_LT((part->shown_picture->corner - input.settings.origin - Vec2(-3.0, -21.2)).norm(), 1e-9);
    input.settings.picture.pixel_aspect = 0.5; // times what the file says
    EXPECT_LT((derived(input)->shown_picture->cell - Vec2(0.1, 0.1)).norm(), 1e-9);
}

TEST(PlotWork, ToolsAreChangedAtAPlaceOfTheMachine) {
    const test::ScratchFolder scratch;
    write_drawing(scratch / "drawing.plt");
    project::PlotInput input{scratch / "drawing.plt", {}};
    for (int pen = 1; pen <= 2; ++pen) {
        input.settings.levels.push_back({.pen = pen, .order = pen, .tool = pen});
    }
    input.settings.change_position = {3.0, 4.0, 30.0};
    input.settings.origin = {50.0, 60.0};
    const auto made = derived(input);
    ASSERT_FALSE(made->failure) << to_text(*made->failure);
    int changes = 0;
    for (const plot::CutPoint& point : *made->path) {
        if (point.move == plot::CutMove::tool_change && point.tool == 2) {
            EXPECT_LT((point.at - Vec3(3.0, 4.0, 30.0)).norm(), 1e-9);
            ++changes;
        }
    }
    EXPECT_EQ(changes, 1);
    const auto says_raised = [&] {
        const auto now = derived(input);
        return std::ranges::any_of(now->notices, [](const Diagnostic& notice) {
            return notice.message ==
                   "tools are changed at Z 5 mm, the safe height, because Tool change Z, 4 mm, is below it";
        });
    };
    EXPECT_FALSE(says_raised());
    input.settings.change_position.z() = 4.0; // it was raised without a word
    EXPECT_TRUE(says_raised());
    input.settings.levels[1].tool = 1;
    EXPECT_FALSE(says_raised()) << "no tool is changed";
}

TEST(PlotWork, EveryChoiceOfTheSettingsCounts) {
    const test::ScratchFolder scratch;
    write_drawing(scratch / "drawing.plt");
    const project::PlotInput drawing{scratch / "drawing.plt", {}};
    const auto differs = [](const project::PlotInput& input, auto change) {
        project::PlotInput changed = input;
        change(changed.settings);
        return seen(changed) != seen(input);
    };
    EXPECT_TRUE(differs(drawing, [](project::PlotSettings& s) { s.hpgl.fill = hpgl::FillMode::outline; }));
    EXPECT_TRUE(differs(drawing, [](project::PlotSettings& s) { s.hpgl.fill = hpgl::FillMode::none; }));
    EXPECT_TRUE(differs(drawing, [](project::PlotSettings& s) { s.hpgl.dashes = false; }));
    EXPECT_TRUE(
        differs(drawing, [](project::PlotSettings& s) { s.hpgl.line_ends = hpgl::LineEnds::separate; }));
    EXPECT_TRUE(differs(drawing, [](project::PlotSettings& s) { s.post = "grbl"; }));
    const project::PlotInput outlines = picture_input(project::PictureUse::outlines);
    EXPECT_TRUE(differs(outlines, [](project::PlotSettings& s) { s.picture.invert = true; }));
    project::PlotInput dots = picture_input(project::PictureUse::dots);
    EXPECT_TRUE(differs(dots, [](project::PlotSettings& s) { s.join_dots = true; }));
    EXPECT_TRUE(differs(drawing, [](project::PlotSettings& s) {
        s.drawing_use = project::DrawingUse::carving;
        project::take_v_bit(s);
    }));
    std::ofstream(scratch / "outlines.plt") << outlines_with_a_gap;
    project::PlotInput carved{scratch / "outlines.plt", {}};
    carved.settings.drawing_use = project::DrawingUse::carving;
    carved.settings.largest_depth = 2.0;
    project::take_v_bit(carved.settings);
    EXPECT_TRUE(differs(carved, [](project::PlotSettings& s) { s.clear_floor = false; }));
    project::PlotInput thin = drawing;
    thin.settings.plate = 0.5;
    EXPECT_TRUE(differs(thin, [](project::PlotSettings& s) { s.through = true; }));
    std::ofstream(scratch / "bad.plt") << "SP1;PU0,0;PD400,0;QX;";
    const project::PlotInput bad{scratch / "bad.plt", {}};
    EXPECT_TRUE(differs(bad, [](project::PlotSettings& s) { s.hpgl.strictness = hpgl::Strictness::strict; }));
}

/// Of so many points, back and forth over 100 mm.
void write_zigzag(const fs::path& file, std::size_t points) {
    std::ofstream out(file);
    out << "IN;SP1;PU0,0;PD";
    for (std::size_t n = 0; n < points; ++n) {
        out << (n > 0 ? "," : "") << n % 4000 << "," << 40 + n % 7 * 40;
    }
    out << ";PU0,0;SP;";
}

/// Where the program goes, blocks that cut and blocks in the air alike.
std::vector<Vec3> targets_of(const program::Program& program) {
    std::vector<Vec3> targets;
    for (const program::Block& block : program.blocks) {
        if (block.moves()) {
            targets.emplace_back(block.target[0], block.target[1], block.target[2]);
        }
    }
    return targets;
}

TEST(PlotWork, TheProgramIsAValueThatIsReadAndPlannedWithoutAFile) {
    const auto made = derived({everyday, {}}); // its worker is gone
    ASSERT_TRUE(made->program);
    EXPECT_EQ(made->program->name, "everyday.ngc");
    for (const plot::CutPoint& point : *made->path) {
        const auto near = [&](const Vec3& target) { return (target - point.at).norm() < 1e-3; };
        EXPECT_TRUE(std::ranges::any_of(targets_of(*made->program->program), near)) << point.at.transpose();
    }
    ASSERT_TRUE(made->opened);
    EXPECT_TRUE(made->opened->finished);
    EXPECT_EQ(made->opened->file, "everyday.ngc");
    EXPECT_EQ(made->opened->text->text().data(), made->program->listing->text.data()) << "no copy of it";
    ASSERT_TRUE(made->opened->motion) << made->opened->no_motion;
    EXPECT_TRUE(made->opened->findings.empty());
}

// A machine file beside the drawing, named without a folder.
TEST(PlotWork, TheMotionIsOfTheMachineThatTheProgramIsFor) {
    const test::ScratchFolder scratch;
    fs::copy_file(everyday, scratch / "a.plt");
    fs::copy_file("assets/machines/router-xyz.json", scratch / "mine.json");
    project::PlotInput input{scratch / "a.plt", {}};
    input.settings.machine = "mine.json";
    const auto made = derived(input);
    ASSERT_FALSE(made->failure) << to_text(*made->failure);
    EXPECT_TRUE(made->opened->motion) << to_text(made->opened->faults.front());
}

TEST(PlotWork, AMotionThatIsGivenUpIsNotStillBeingRead) {
    const test::ScratchFolder scratch;
    PlotWorker worker("assets", [] {});
    constexpr int tries = 20; // the motion may be there before it is cancelled: then once more
    bool met = false;
    for (int n = 0; n < tries && !met; ++n) {
        const fs::path file = scratch / ("long" + std::to_string(n) + ".plt");
        write_zigzag(file, most_points_at_once / 2);
        worker.request({file, {}});
        const auto of_it = [&](const auto& now) { return now && now->input.file == file; };
        while (worker.activity().busy && !(of_it(worker.latest()) && worker.latest()->opened)) {
            std::this_thread::sleep_for(std::chrono::milliseconds(1));
        }
        worker.cancel();
        const Activity after = worker.activity();
        EXPECT_TRUE(after.stopping || !after.busy) << "it is said that it is being cancelled";
        worker.wait_idle();
        ASSERT_TRUE(worker.latest()->opened);
        EXPECT_TRUE(worker.latest()->opened->finished);
        EXPECT_TRUE(worker.latest()->program);
        met = worker.latest()->opened->cancelled;
    }
    EXPECT_TRUE(met);
}

// The window plans the file, the command line said another time for the same program.
TEST(PlotWork, TheTimeOfThePlannerIsThatOfTheWrittenTextEverywhere) {
    for (const char* post : {"linuxcnc-xyz", "grbl"}) {
        project::PlotInput input{everyday, {}};
        input.settings.post = post;
        PlotWorker worker("assets", [] {});
        worker.request(input);
        worker.wait_idle();
        const auto made = worker.latest();
        ASSERT_FALSE(made->failure) << post << to_text(*made->failure);
        const auto opened = made->opened;
        ASSERT_TRUE(opened->motion) << post << opened->no_motion;
        posts::ReleasedText released;
        released.listing.text = made->program->listing->text;
        const auto machine =
            kinematics::read_machine(project::machine_path(input.settings.machine, ".", "assets"));
        EXPECT_NEAR(
            opened->motion->trajectory->duration(), seconds_of_text(released, {}, machine, "p.ngc"), 1e-6)
            << post;
    }
}

TEST(PlotWork, TheTimeAsDrawnIsThatOfItsOwnProgram) {
    const test::ScratchFolder scratch;
    std::ofstream(scratch / "far.plt")
        << "IN;SP1;PU4000,0;PD4400,0,4400,200;PU0,0;PD400,0,400,200;PU4000,400;PD4400,"
           "400;PU0,400;PD400,400;PU;";
    project::PlotInput input{scratch / "far.plt", {}};
    input.settings.strokes.order = true;
    const auto ordered = derived(input);
    ASSERT_TRUE(ordered->drawn_seconds);
    input.settings.strokes.order = false;
    PlotWorker worker("assets", [] {});
    worker.request(input);
    worker.wait_idle();
    posts::ReleasedText released;
    released.listing.text = worker.latest()->program->listing->text;
    const auto machine =
        kinematics::read_machine(project::machine_path(input.settings.machine, ".", "assets"));
    EXPECT_NEAR(*ordered->drawn_seconds, seconds_of_text(released, {}, machine, "p.ngc"), 1e-6);
}

TEST(PlotWork, APointFileIsCutAndKeepsItsPointsForTheTable) {
    const test::ScratchFolder folder;
    for (const char* name : {"points.csv", "points.txt"}) {
        const fs::path file = folder / name;
        std::ofstream(file) << "0.00,0.00,5.00\n10.00,10.00,5.00\n10.00,10.00,-1.00\n20.00,10.00,-1.00\n"
                               "20.00,10.00,5.00\n";
        ASSERT_TRUE(project::holds_points(file));
        project::PlotInput input{file, {}};
        input.settings.origin = {5.0, 5.0};
        const auto made = derived(input);
        ASSERT_FALSE(made->failure) << to_text(*made->failure);
        ASSERT_TRUE(made->points);
        ASSERT_EQ(made->points->read.points.size(), 5U);
        EXPECT_EQ(made->points->read.points[3], Vec3(25.0, 15.0, -1.0));
        EXPECT_NEAR(made->lengths.cut, 16.0, 1e-9); // down and across
        EXPECT_THAT(made->program->listing->text, HasSubstr("X25.0000"));
        std::ofstream(file, std::ios::app) << "a,b,c\n";
        const auto bad = derived(input);
        ASSERT_TRUE(bad->failure);
        EXPECT_EQ(bad->failure->place.line, 6);
    }
}

TEST(PlotWork, TheProgramOfALongPathIsWrittenWhereItIsAskedFor) {
    const test::ScratchFolder scratch;
    write_zigzag(scratch / "long.plt", most_points_at_once);
    PlotWorker worker("assets", [] {});
    worker.request({scratch / "long.plt", {}});
    worker.wait_idle();
    ASSERT_FALSE(worker.latest()->failure);
    EXPECT_TRUE(worker.latest()->finished);
    EXPECT_GT(worker.latest()->path->size(), most_points_at_once);
    EXPECT_FALSE(worker.latest()->program);
    EXPECT_FALSE(worker.latest()->opened);
    const auto revision = worker.latest()->revision;

    worker.request_program();
    worker.wait_idle();
    ASSERT_TRUE(worker.latest()->program);
    EXPECT_TRUE(worker.latest()->opened->motion);
    EXPECT_GT(worker.latest()->revision, revision);
    EXPECT_GT(worker.latest()->program->program->block_count(), std::ssize(*worker.latest()->path) / 2);

    const auto there = worker.latest();
    worker.request_program(); // it is there
    worker.wait_idle();
    EXPECT_EQ(worker.latest(), there);
}

TEST(PlotWork, TheProgramOfALongPathIsNotWrittenForAPathThatIsGone) {
    const test::ScratchFolder scratch;
    write_zigzag(scratch / "long.plt", most_points_at_once);
    PlotWorker worker("assets", [] {});
    worker.request({scratch / "long.plt", {}});
    worker.wait_idle();
    worker.request_program();
    worker.request({everyday, {}}); // in its place
    worker.wait_idle();
    ASSERT_FALSE(worker.latest()->failure);
    EXPECT_EQ(worker.latest()->input.file, everyday);
    EXPECT_EQ(worker.latest()->program->name, "everyday.ngc");
}

TEST(PlotWork, WhatCannotBeFollowedIsANotice) {
    const test::ScratchFolder scratch;
    std::ofstream(scratch / "pages.plt") << "IN;PC1;SP1;PU0,0;PD400,0;PG;";
    const auto made = derived({scratch / "pages.plt", {}});
    ASSERT_FALSE(made->failure);
    ASSERT_EQ(made->notices.size(), 2U);
    EXPECT_THAT(to_text(made->notices[0]), HasSubstr("1 PC ignored"));
}

TEST(PlotWork, WhatCannotBeCutIsAFailureWithItsReason) {
    const test::ScratchFolder scratch;
    std::ofstream(scratch / "empty.plt") << "IN;SP1;PU0,0;";
    EXPECT_THAT(to_text(*derived({scratch / "empty.plt", {}})->failure), HasSubstr("nothing to cut"));
    EXPECT_THAT(to_text(*derived({scratch / "gone.plt", {}})->failure), HasSubstr("gone.plt"));
    project::PlotInput thin{everyday, {}};
    thin.settings.plate = 0.5;
    EXPECT_TRUE(derived(thin)->failure);
    project::PlotInput nowhere{everyday, {}};
    nowhere.settings.machine = "no-such-machine";
    const auto made = derived(nowhere);
    EXPECT_THAT(to_text(*made->failure), HasSubstr("no-such-machine"));
    EXPECT_TRUE(made->path); // what there is stays to be looked at
    EXPECT_FALSE(made->program);
}

TEST(PlotWork, AProgramThatCutsFromAnUnknownPlaceIsAFailureWithItsLine) {
    const test::ScratchFolder scratch;
    std::ofstream(scratch / "part.ngc") << "G21 G90\nG0 Z5\nG1 Z-1 F100\nG1 X50\nG0 Z5\nM2\n";
    const auto found = derived({scratch / "part.ngc", {}});
    ASSERT_TRUE(found->failure);
    EXPECT_EQ(found->failure->place.line, 3);
    EXPECT_THAT(found->failure->message, HasSubstr("has stated where X and Y are"));
}

TEST(PlotWork, SpeedsThatTheMachineDoesNotReachAreANotice) {
    project::PlotInput hard{everyday, {}};
    const std::size_t of_the_reader = derived(hard)->notices.size();
    hard.settings.level.cutting = 24.0; // 1440 mm/min, of a chart for hardwood
    const auto made = derived(hard);
    ASSERT_EQ(made->notices.size(), of_the_reader + 1);
    EXPECT_THAT(to_text(made->notices.back()),
                HasSubstr("1440 mm/min exceeds the maximum speed of forming table: its axis"));
    hard.settings.machine = "router-xyz";
    EXPECT_EQ(derived(hard)->notices.size(), of_the_reader);
}

TEST(PlotWork, WhatTheSettingsLeaveOpenIsTold) {
    project::PlotInput relief = picture_input(project::PictureUse::relief);
    relief.settings.size = {.width = 40.0};
    relief.settings.tip = {.kind = plot::TipKind::ball, .diameter = 2.0};
    relief.settings.step_over.reset();
    const auto made = derived(relief);
    EXPECT_NEAR(made->picture_size.x(), 40.0, 1e-9);
    EXPECT_GT(made->picture_size.y(), 10.0);
    EXPECT_NEAR(made->step_over, 0.2, 1e-12);
}

} // namespace
} // namespace millwright::plan
