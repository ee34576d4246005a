#include "core/plan/internal/plot_reading.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/numbers.h"
#include "core/gcode_programs/cut_program.h"
#include "core/hpgl/reader.h"
#include "core/plot/path_file.h"
#include "core/project/gcode_file.h"

#include <filesystem>
#include <memory>
#include <utility>

namespace millwright::plan {

namespace {

using project::PlotSettings;

void read_drawing(const PlotStageWork& work) {
    const PlotSettings& settings = work.settings();
    hpgl::HpglSettings reading = settings.hpgl;
    if (project::is_carved(work.result.input)) { // whole outlines
        reading.fill = reading.fill == hpgl::FillMode::hatched ? hpgl::FillMode::outline : reading.fill;
        reading.dashes = false;
        reading.arc_tolerance =
            reading.arc_tolerance.value_or(plot::carving_chords(settings.carving_tolerance));
    }
    hpgl::Plot read = hpgl::read_hpgl_file(work.result.input.file, reading);
    work.notices = hpgl::notices(read, work.result.input.file);
    work.parts.read_strokes = std::make_shared<const plot::Strokes>(std::move(read.strokes));
    work.parts.end = read.end;
}

void read_program(const PlotStageWork& work) {
    gcode::CutProgram read =
        gcode::read_cut_program_file(work.result.input.file, {.chord_length = work.settings().chord_length});
    if (!read.unplaced.empty()) {
        throw Error(read.unplaced.front());
    }
    work.notices = read.notices;
    work.result.program_rpm = read.spindle_rpm;
    work.parts.read_path = std::move(read.path);
}

void read_points(const PlotStageWork& work) {
    PlotPoints points;
    points.text = read_file(work.result.input.file);
    points.read = plot::read_points(points.text, work.result.input.file);
    if (!points.read.diagnostics.empty()) { // a table goes to no place that was guessed
        throw Error(points.read.diagnostics.front());
    }
    work.parts.points = std::move(points);
}

void read_picture(const PlotStageWork& work) {
    const PlotSettings& settings = work.settings();
    plot::PictureSettings reading = settings.picture;
    reading.ground = settings.use == project::PictureUse::relief ? plot::relief_top : plot::white;
    plot::ReadPicture read =
        plot::read_picture_file(work.result.input.file, reading, work.progress.part(0.0, 0.8));
    work.notices = std::move(read.notices);
    work.parts.picture = std::move(read.picture);
    plot::PictureSettings whole = reading;
    whole.region.reset();
    whole.most_pixels = 1 << 16;
    work.parts.pixels = plot::read_file_pixels(work.result.input.file, whole, work.progress.part(0.8, 1.0));
}

} // namespace

bool same_reading(const PlotSource& then, const PlotSource& now) {
    const PlotSettings &a = then.input.settings, &b = now.input.settings;
    const bool carved = project::is_carved(now.input);
    return then.input.file == now.input.file && then.file == now.file && a.hpgl == b.hpgl &&
           a.picture == b.picture &&
           (a.use == project::PictureUse::relief) == (b.use == project::PictureUse::relief) &&
           a.chord_length == b.chord_length && project::is_carved(then.input) == carved &&
           (!carved || exactly_equal(a.carving_tolerance, b.carving_tolerance));
}

void make_reading(const PlotStageWork& work) {
    const std::filesystem::path& file = work.result.input.file;
    work.result.picture = project::is_picture_file(file);
    if (project::is_path_file(file)) {
        work.parts.read_path = plot::read_path(read_file(file), file);
    } else if (project::holds_points(file)) {
        read_points(work);
    } else if (project::is_gcode_file(file)) {
        read_program(work);
    } else if (work.result.picture) {
        read_picture(work);
    } else {
        read_drawing(work);
    }
}

void clear_reading(PlotResult& result, PlotParts& parts) {
    result.picture = false;
    result.program_rpm = 0.0;
    parts.read_strokes = nullptr;
    parts.picture.reset();
    parts.pixels = {};
    parts.read_path.clear();
    parts.points.reset();
    parts.end = Vec2::Zero();
}

} // namespace millwright::plan
