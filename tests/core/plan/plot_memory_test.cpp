// What a plot keeps from one change to the next: never anything but what a plot that is derived anew has.
#include "core/plan/plot_work.h"
#include "core/plot/path_file.h"
#include "core/project/plot_settings.h"
#include "tests/support/bmp_shape.h"
#include "tests/support/scratch_folder.h"

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <functional>
#include <memory>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::plan {
namespace {

namespace fs = std::filesystem;
using project::PlotInput;
using project::PlotSettings;

std::shared_ptr<const PlotResult> derive(PlotWorker& worker, const PlotInput& input) {
    worker.request(input);
    worker.wait_idle();
    return worker.latest();
}

std::shared_ptr<const PlotResult> derived_anew(const PlotInput& input) {
    PlotWorker worker("assets", [] {});
    return derive(worker, input);
}

void add_path(std::string& text, const gcode::PreviewPath& path) {
    for (const auto& chunk : path.chunks) {
        for (const auto& point : chunk->points) {
            const Vec3 at = point.position();
            text += fmt::format("{},{},{};", at.x(), at.y(), at.z());
        }
    }
    text += '\n';
}

/// All of it but what is inside of the motion, as text.
std::string all_of(const PlotResult& made) {
    std::string text = made.failure ? to_text(*made.failure) : "no failure";
    for (const Diagnostic& notice : made.notices) {
        text += "\n" + to_text(notice);
    }
    text +=
        fmt::format("\npicture {} {} {} rpm {} {} step over {} strokes {} as drawn {} seconds {} cut {}\n",
                    made.picture,
                    made.picture_size.x(),
                    made.picture_size.y(),
                    made.program_rpm,
                    made.spindle_rpm(),
                    made.step_over,
                    made.drawn_strokes,
                    made.cut_as_drawn,
                    made.drawn_seconds.value_or(-1.0),
                    made.lengths.cut);
    text += made.path ? plot::path_file_text(*made.path) : "no path";
    for (const plot::Level& level : made.levels) {
        text += fmt::format("pen {} tool {} depth {}\n", level.pen, level.tool, level.depth);
    }
    for (const auto& level : made.cuts) {
        text += fmt::format("pen {} depth {}\n", level.pen, level.depth.value_or(-1.0));
        add_path(text, level.path);
    }
    add_path(text, made.air);
    if (made.shown_picture) {
        const ShownPicture& shown = *made.shown_picture;
        text += fmt::format("{} {} at {} {} of {} gray {}\n",
                            shown.cell.x(),
                            shown.cell.y(),
                            shown.corner.x(),
                            shown.corner.y(),
                            shown.picture.width,
                            shown.gray(shown.picture.height / 2, shown.picture.width / 2));
    }
    text += made.points ? fmt::format("first point {}\n", made.points->read.points.front().x()) : "";
    text += made.carved ? fmt::format("carved {} mm deep\n", made.carved->deepest) : "";
    for (const float z : made.look ? made.look->z : decltype(made.look->z)()) {
        text += fmt::format("{} ", z);
    }
    text.append(made.light.pixels.begin(), made.light.pixels.end());
    text += made.program ? made.program->listing->text : "no program";
    const bool moves = made.opened && made.opened->motion;
    text += fmt::format("\nmotion {}", moves ? made.opened->motion->trajectory->duration() : -1.0);
    return text;
}

/// Dashed, filled, with an arc and two pens.
constexpr const char* drawing_text = "IN;SP1;LT2,1;PU0,0;PD2000,0;LT;PU400,400;PD;AA800,400,180;PU;"
                                     "PU2000,2000;FT3,80,0;RA2800,2800;SP2;PU400,3000;PD1200,3000,1200,3800,"
                                     "400,3800,400,3000;PU;PU1210,3000;PD1400,3000;PU;";

class PlotMemory : public testing::Test {
protected:
    fs::path write(std::string_view name, std::string_view text) {
        std::ofstream(scratch_ / name) << text;
        return scratch_ / name;
    }

    /// 48 x 48 pixels.
    PlotInput small_picture(project::PictureUse use) {
        test::write_bmp(scratch_ / "picture.bmp", 48, 48, 4'000, 4'000);
        PlotInput input{scratch_ / "picture.bmp", {}};
        input.settings.use = use;
        input.settings.size.width = 12.0;
        input.settings.step_over = 1.5;
        input.settings.tip.diameter = 3.0;
        input.settings.tip.kind =
            use == project::PictureUse::halftone ? plot::TipKind::v : plot::TipKind::ball;
        return input;
    }

    /// One of every way in which something is cut.
    std::vector<PlotInput> every_kind() {
        PlotInput drawing{write("drawing.plt", drawing_text), {}};
        PlotInput ordered = drawing;
        ordered.settings.strokes.order = true;
        for (int pen = 1; pen <= 2; ++pen) {
            ordered.settings.levels.push_back({.pen = pen, .order = pen, .tool = pen});
        }
        PlotInput carved{write("outlines.plt", "IN;SP1;PU0,0;PD800,0,800,800,0,800,0,0;PU;"), {}};
        carved.settings.drawing_use = project::DrawingUse::carving;
        carved.settings.tip = {plot::TipKind::v, 30.0, 1.0};
        return {
            drawing,
            ordered,
            carved,
            {write("arc.ngc", "G21 G90\nG0 X10 Y10\nG1 Z-1 F300\nG2 X20 I5\nG0 Z5\nM2\n"), {}},
            {write("points.csv", "0.00,0.00,5.00\n9.00,9.00,5.00\n9.00,9.00,-1.00\n20.00,9.00,5.00\n"), {}},
            small_picture(project::PictureUse::relief),
            small_picture(project::PictureUse::outlines),
            small_picture(project::PictureUse::halftone),
            small_picture(project::PictureUse::dots)};
    }

private:
    test::ScratchFolder scratch_;
};

void change_number(const project::NumberSetting<PlotSettings>& number, PlotSettings& settings) {
    const double value = number.value(settings);
    const double other = value + 0.3 * (1.0 + std::abs(value));
    number.set(settings, std::clamp(number.whole() ? std::ceil(other) : other, number.min, number.max));
}

// A setting that a stage forgets to compare would leave a stale result on the screen.
TEST_F(PlotMemory, AChangeOfAnyNumberGivesWhatIsDerivedAnew) {
    for (const PlotInput& input : every_kind()) {
        PlotWorker worker("assets", [] {});
        EXPECT_EQ(all_of(*derive(worker, input)), all_of(*derived_anew(input)));
        for (const auto& number : project::plot_numbers()) {
            PlotInput changed = input;
            change_number(number, changed.settings);
            EXPECT_TRUE(all_of(*derive(worker, changed)) == all_of(*derived_anew(changed)))
                << number.id << " of " << input.file;
        }
        EXPECT_TRUE(all_of(*derive(worker, input)) == all_of(*derived_anew(input))) << "and back";
    }
}

TEST_F(PlotMemory, AChangeOfAnyChoiceGivesWhatIsDerivedAnew) {
    const std::vector<std::function<void(PlotSettings&)>> changes = {
        [](PlotSettings& s) { s.hpgl.fill = hpgl::FillMode::outline; },
        [](PlotSettings& s) { s.hpgl.dashes = false; },
        [](PlotSettings& s) { s.picture.invert = true; },
        [](PlotSettings& s) { s.use = project::PictureUse::carving; },
        [](PlotSettings& s) { s.use = project::PictureUse::relief; },
        [](PlotSettings& s) { s.drawing_use = project::DrawingUse::carving; },
        [](PlotSettings& s) { s.drawing_use = project::DrawingUse::strokes; },
        [](PlotSettings& s) { s.tip.kind = plot::TipKind::flat; },
        [](PlotSettings& s) { s.strokes.order = !s.strokes.order; },
        [](PlotSettings& s) { s.strokes.side = plot::CutterSide::inside; },
        [](PlotSettings& s) { s.plate = 0.5; },
        [](PlotSettings& s) { s.through = true; },
        [](PlotSettings& s) { s.post = "grbl"; },
        [](PlotSettings& s) { s.post = "none"; },
        [](PlotSettings& s) { s.machine = "router-xyz"; },
        [](PlotSettings& s) { s.machine = "none"; }};
    for (const PlotInput& input : every_kind()) {
        PlotWorker worker("assets", [] {});
        for (const auto& change : changes) {
            PlotInput changed = input;
            change(changed.settings);
            EXPECT_TRUE(all_of(*derive(worker, changed)) == all_of(*derived_anew(changed)))
                << &change - changes.data() << " of " << input.file;
        }
    }
}

TEST_F(PlotMemory, OnlyWhatDependsOnAChangeIsMadeAgain) {
    PlotWorker worker("assets", [] {});
    PlotInput input = small_picture(project::PictureUse::relief);
    const auto first = derive(worker, input);
    ASSERT_FALSE(first->failure) << to_text(*first->failure);

    input.settings.half_light *= 2.0;
    const auto lighter = derive(worker, input);
    EXPECT_NE(lighter->light.pixels, first->light.pixels);
    EXPECT_EQ(lighter->look, first->look);
    EXPECT_EQ(lighter->path, first->path);
    EXPECT_EQ(lighter->program, first->program);
    EXPECT_EQ(lighter->opened, first->opened);
    EXPECT_GT(lighter->revision, first->revision);

    input.settings.post = "grbl";
    const auto posted = derive(worker, input);
    EXPECT_NE(posted->program, first->program);
    EXPECT_NE(posted->opened, first->opened);
    EXPECT_EQ(posted->look, first->look);
    EXPECT_EQ(posted->path, first->path);
    EXPECT_EQ(posted->shown_picture, first->shown_picture);

    input.settings.depth *= 0.5;
    const auto flatter = derive(worker, input);
    EXPECT_NE(flatter->path, first->path);
    EXPECT_EQ(flatter->shown_picture, first->shown_picture) << "the picture is read once";
}

TEST_F(PlotMemory, AFileThatHasChangedIsReadAgain) {
    PlotWorker worker("assets", [] {});
    const PlotInput input{write("a.plt", "IN;SP1;PU0,0;PD400,0;PU;"), {}};
    const auto before = derive(worker, input);
    EXPECT_EQ(derive(worker, input)->path, before->path);
    write("a.plt", "IN;SP1;PU0,0;PD400,0,400,800;PU;");
    const auto after = derive(worker, input);
    ASSERT_FALSE(after->failure);
    EXPECT_NE(after->path, before->path);
    EXPECT_EQ(all_of(*after), all_of(*derived_anew(input)));

    worker.request_anew(input);
    worker.wait_idle();
    EXPECT_NE(worker.latest()->path, after->path) << "read again where a person asks for it";
    EXPECT_EQ(all_of(*worker.latest()), all_of(*after));
}

TEST_F(PlotMemory, WhatWasStoppedIsMadeByTheNextRequest) {
    PlotWorker worker("assets", [] {});
    PlotInput input = small_picture(project::PictureUse::relief);
    derive(worker, input);
    for (int n = 0; n < 10; ++n) {
        PlotInput other = input;
        other.settings.depth = 0.5 + 0.1 * n;
        worker.request(other);
        worker.cancel();
        input.settings.half_light += 0.1;
        EXPECT_TRUE(all_of(*derive(worker, input)) == all_of(*derived_anew(input))) << n;
    }
}

TEST_F(PlotMemory, TheProgramOfALongPathStaysWhereItHolds) {
    std::string text = "IN;SP1;PU0,0;PD0,40";
    for (std::size_t n = 1; n < most_points_at_once; ++n) {
        text += fmt::format(",{},{}", n % 4000, 40 + n % 7 * 40);
    }
    PlotInput input{write("long.plt", text + ";PU0,0;SP;"), {}};
    PlotWorker worker("assets", [] {});
    EXPECT_FALSE(derive(worker, input)->program);
    worker.request_program();
    worker.wait_idle();
    const auto asked_for = worker.latest();
    ASSERT_TRUE(asked_for->program);
    input.settings.half_light *= 2.0;
    EXPECT_EQ(derive(worker, input)->program, asked_for->program);
    input.settings.level.depth *= 0.5;
    EXPECT_FALSE(derive(worker, input)->program) << "of another path it was not asked for";
}

} // namespace
} // namespace millwright::plan
