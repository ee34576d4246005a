#include "core/plan/internal/plot_stages.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/kinematics/machine_file.h"
#include "core/plan/internal/failure.h"
#include "core/plan/internal/plot_cutting.h"
#include "core/plan/internal/plot_reading.h"
#include "core/plan/internal/plot_view.h"
#include "core/plan/internal/posted_plot.h"
#include "core/plan/internal/program_reading.h"
#include "core/plan/plot_time.h"
#include "core/plot/linking.h"
#include "core/plot/picture/finished_look.h"
#include "core/plot/plot_program.h"
#include "core/project/assets.h"
#include "core/project/gcode_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <set>
#include <system_error>
#include <utility>

namespace millwright::plan {

namespace fs = std::filesystem;

namespace {

using project::PlotSettings;
using Kind = PlotStageKind;

// What a person should know of the spindle of a program.

bool same_spindle(const PlotSource& then, const PlotSource& now) {
    return then.input.settings.spindle_rpm == now.input.settings.spindle_rpm;
}

void make_spindle(const PlotStageWork& work) {
    if (!project::is_gcode_file(work.result.input.file)) {
        return;
    }
    const double of_program = work.result.program_rpm;
    if (of_program > 0.0 && std::abs(of_program - work.result.spindle_rpm()) > 0.5) {
        work.note(Diagnostic{
            {},
            fmt::format("the program sets the spindle to {:.0f} rpm, but here it is set to {:.0f} rpm",
                        of_program,
                        work.result.spindle_rpm()),
            "change it in the field Spindle speed under Work; its arrow restores the speed of the "
            "program"});
    }
    if (!(of_program > 0.0) && !work.settings().spindle_rpm) {
        work.note(Diagnostic{{},
                             fmt::format("the program sets no spindle speed: {:.0f} rpm is used here",
                                         work.result.spindle_rpm()),
                             "set another speed under Work"});
    }
}

void clear_nothing(PlotResult& /*result*/, PlotParts& /*parts*/) {}

// The picture for people to look at, where it lies on the machine.

bool same_shown_picture(const PlotSource& then, const PlotSource& now) {
    const PlotSettings &a = then.input.settings, &b = now.input.settings;
    return a.size == b.size && a.origin == b.origin;
}

void make_shown_picture(const PlotStageWork& work) {
    if (!work.parts.picture) {
        return;
    }
    const PlotSettings& settings = work.settings();
    const plot::Picture& picture = *work.parts.picture;
    const double pitch = plot::pixel_pitch(settings.size, picture);
    const double pixel = pitch / picture.file_pixels; // side of a square one, mm
    work.result.picture_size = pitch * Vec2(picture.width, picture.height);
    auto shown = std::make_shared<ShownPicture>();
    shown->picture = work.parts.pixels.picture;
    const int side = shown->picture.file_pixels;
    const plot::PixelRegion region = settings.picture.region.value_or(plot::PixelRegion{});
    const int below = region.height > 0 ? side * shown->picture.height - region.top - region.height : 0;
    const Vec2 of_pixel(pixel * work.parts.pixels.pixel_width,
                        pixel * work.parts.pixels.pixel_height * settings.picture.pixel_aspect);
    shown->cell = side * of_pixel;
    const Vec2 middle = 0.5 * (shown->cell - of_pixel); // of a square, from that of its first pixel
    shown->corner = settings.origin + middle - Vec2(region.left, below).cwiseProduct(of_pixel);
    work.result.shown_picture = std::move(shown);
}

void clear_shown_picture(PlotResult& result, PlotParts& /*parts*/) {
    result.picture_size = Vec2::Zero();
    result.shown_picture = nullptr;
}

// The strokes, and the path that cuts it, before it is moved to the origin.

/// Without what only later stages read.
PlotSettings of_cut(PlotSettings settings) {
    const PlotSettings usual;
    settings.plate = usual.plate;
    settings.half_light = usual.half_light;
    settings.spindle_rpm = usual.spindle_rpm;
    settings.machine = usual.machine;
    settings.post = usual.post;
    settings.change_position -= Vec3(settings.origin.x(), settings.origin.y(), 0.0); // as the path has it
    settings.origin = usual.origin;
    return settings;
}

bool same_cut(const PlotSource& then, const PlotSource& now) {
    PlotSettings a = of_cut(then.input.settings);
    PlotSettings b = of_cut(now.input.settings);
    if (!changes_tools(now.input)) {
        a.change_position = b.change_position;
    }
    return a == b;
}

bool same_strokes(const PlotSource& then, const PlotSource& now) {
    PlotSettings a = of_cut(then.input.settings);
    PlotSettings b = of_cut(now.input.settings);
    if (!b.strokes.order) {
        a.change_position = b.change_position;
    }
    return a == b;
}

void clear_strokes(PlotResult& result, PlotParts& parts) {
    result.drawn_strokes = 0;
    result.levels.clear();
    result.as_drawn = result.as_planned = {};
    parts.drawn = parts.planned = nullptr;
}

void clear_cut(PlotResult& result, PlotParts& parts) {
    result.step_over = 0.0;
    result.carved.reset();
    result.cut_as_drawn = false;
    parts.cut = parts.cut_as_drawn = nullptr;
}

// The same where it lies on the machine.

bool same_place(const PlotSource& then, const PlotSource& now) {
    return then.input.settings.origin == now.input.settings.origin;
}

void make_path(const PlotStageWork& work) {
    PlotResult& result = work.result;
    const Vec2& origin = result.input.settings.origin;
    result.path = at_origin(work.parts.cut, origin);
    result.cuts = cuts_by_level(work);
    if (work.parts.points) {
        auto points = std::make_shared<PlotPoints>(*work.parts.points);
        for (Vec3& point : points->read.points) {
            point += Vec3(origin.x(), origin.y(), 0.0);
        }
        result.points = std::move(points);
    }
    result.lengths = plot::lengths(*result.path);
    result.air = travel_of(*result.path);
    if (result.path->empty()) {
        throw Error("there is nothing to cut", result.input.file);
    }
}

void clear_path(PlotResult& result, PlotParts& /*parts*/) {
    result.path = nullptr;
    result.points = nullptr;
    result.lengths = {};
    result.cuts.clear();
    result.air = {};
}

bool same_plate(const PlotSource& then, const PlotSource& now) {
    const PlotSettings &a = then.input.settings, &b = now.input.settings;
    return exactly_equal(a.plate, b.plate) && a.through == b.through;
}

void check_plate(const PlotStageWork& work) {
    const PlotSettings& settings = work.settings();
    if (settings.plate > 0.0 && !settings.through) {
        plot::expect_within_plate(*work.result.path, settings.plate);
    }
}

// How the finished work looks: none where nothing is cut, or where a point cuts.

constexpr int look_squares = 160;

void make_look(const PlotStageWork& work) {
    const plot::ToolTips tips = tips_of(work.result);
    const bool cuts = std::ranges::any_of(*work.result.path,
                                          [](const plot::CutPoint& point) { return point.at.z() < 0.0; });
    if (cuts && tips.usual.kind != plot::TipKind::point) {
        work.result.look = std::make_shared<plot::HeightField>(
            plot::finished_by(*work.result.path, tips, look_squares, work.progress));
    }
}

bool same_light(const PlotSource& then, const PlotSource& now) {
    const PlotSettings &a = then.input.settings, &b = now.input.settings;
    return exactly_equal(a.plate, b.plate) && exactly_equal(a.half_light, b.half_light);
}

void make_light(const PlotStageWork& work) {
    if (!work.result.look) {
        return;
    }
    const PlotSettings& settings = work.settings();
    constexpr double spare = 0.5;
    const double plate = settings.plate > 0.0
                             ? settings.plate
                             : spare - static_cast<double>(std::ranges::min(work.result.look->z));
    work.result.light = plot::against_light(*work.result.look, plate, settings.half_light);
}

// The machine, and the program for it.

bool same_machine(const PlotSource& then, const PlotSource& now) {
    return then.input.settings.machine == now.input.settings.machine && then.machine == now.machine;
}

/// Notes the speeds that the machine does not reach.
void check_speeds(const PlotStageWork& work) {
    const kinematics::MachineModel machine = kinematics::read_machine(
        project::machine_path(work.settings().machine, work.result.input.file.parent_path(), work.assets));
    work.note(plot::speeds_not_reached(*work.result.path, machine));
}

bool same_program(const PlotSource& then, const PlotSource& now) {
    return same_machine(then, now) && same_spindle(then, now) && then.post == now.post &&
           then.input.settings.post == now.input.settings.post;
}

void make_program(const PlotStageWork& work) {
    PostedPlot posted = posted_plot(work.result, *work.result.path, work.assets);
    PlotProgram made;
    made.name = work.result.input.file.stem().string() + ".ngc";
    made.program = std::make_shared<const program::Program>(std::move(posted.released.program));
    made.listing = std::make_shared<const program::Listing>(std::move(posted.released.listing));
    work.result.program = std::make_shared<const PlotProgram>(std::move(made));
    work.result.opened = nullptr;
}

void clear_program(PlotResult& result, PlotParts& /*parts*/) {
    result.program = nullptr;
    result.opened = nullptr;
}

/// How long the drawing takes without filling, order and links; says in a notice why it cannot be run.
void make_time_as_drawn(const PlotStageWork& work) {
    if (!work.parts.cut_as_drawn || work.parts.cut_as_drawn->empty() || work.result.cut_as_drawn) {
        return;
    }
    auto failure = failure_of([&] {
        const auto path = at_origin(work.parts.cut_as_drawn, work.settings().origin);
        const PostedPlot posted = posted_plot(work.result, *path, work.assets);
        work.result.drawn_seconds =
            seconds_of_text(posted.released, posted.format, posted.machine, posted.file, work.progress);
    });
    if (failure) {
        failure->message = "the time as drawn cannot be computed: " + failure->message;
    }
    work.note(std::move(failure));
}

/// Reads the text of the program and plans its motion, as of every G-code file that is opened.
void make_motion(const PlotStageWork& work) {
    PlotResult& result = work.result;
    OpenedProgram now;
    now.file = result.program->name;
    now.choice.machine = result.input.settings.machine;
    const auto show = [&] {
        work.progress.check();
        ++now.revision;
        result.opened = std::make_shared<const OpenedProgram>(now);
        work.show();
    };
    now.text = std::make_shared<const ProgramText>(result.program->listing, work.progress.part(0.0, 0.1));
    ProgramReading(now, result.input.file.parent_path(), work.assets, show)
        .read(work.progress.part(0.1, 1.0));
    now.finished = true;
    ++now.revision;
    result.opened = std::make_shared<const OpenedProgram>(std::move(now));
}

PlotSource::FileState state_of(const fs::path& file) {
    std::error_code failure;
    const auto written = fs::last_write_time(file, failure);
    const auto bytes = failure ? std::uintmax_t{0} : fs::file_size(file, failure);
    return failure ? PlotSource::FileState{} : PlotSource::FileState{written, bytes};
}

std::vector<PlotStage> stages_to_path() {
    return {
        {.kind = Kind::reading,
         .share = 0.15,
         .same = same_reading,
         .make = make_reading,
         .clear = clear_reading},
        {.kind = Kind::spindle,
         .reads = {Kind::reading},
         .same = same_spindle,
         .make = make_spindle,
         .clear = clear_nothing},
        {.kind = Kind::shown_picture,
         .reads = {Kind::reading},
         .same = same_shown_picture,
         .make = make_shown_picture,
         .clear = clear_shown_picture},
        {.kind = Kind::strokes,
         .share = 0.15,
         .reads = {Kind::reading},
         .same = same_strokes,
         .make = plan_strokes,
         .clear = clear_strokes},
        {.kind = Kind::cut,
         .share = 0.15,
         .reads = {Kind::reading, Kind::strokes},
         .same = same_cut,
         .make = make_cut,
         .clear = clear_cut},
        {.kind = Kind::path,
         .share = 0.05,
         .reads = {Kind::cut},
         .same = same_place,
         .make = make_path,
         .clear = clear_path},
        {.kind = Kind::plate,
         .reads = {Kind::path},
         .same = same_plate,
         .make = check_plate,
         .clear = clear_nothing,
         .shown = true},
    };
}

std::vector<PlotStage> stages_of_path() {
    return {
        {.kind = Kind::look,
         .share = 0.2,
         .reads = {Kind::path},
         .make = make_look,
         .clear = [](PlotResult& result, PlotParts&) { result.look = nullptr; }},
        {.kind = Kind::light,
         .reads = {Kind::look},
         .same = same_light,
         .make = make_light,
         .clear = [](PlotResult& result, PlotParts&) { result.light = {}; }},
        {.kind = Kind::speeds,
         .reads = {Kind::path},
         .same = same_machine,
         .make = check_speeds,
         .clear = clear_nothing,
         .shown = true},
        {.kind = Kind::program,
         .title = "Writing the program",
         .share = 0.1,
         .reads = {Kind::path},
         .same = same_program,
         .make = make_program,
         .clear = clear_program,
         .of_program = true},
        {.kind = Kind::time_as_drawn,
         .share = 0.1,
         .reads = {Kind::path},
         .same = same_program,
         .make = make_time_as_drawn,
         .clear = [](PlotResult& result, PlotParts&) { result.drawn_seconds.reset(); },
         .of_program = true,
         .finishes = true},
        {.kind = Kind::motion,
         .share = 0.1,
         .reads = {Kind::program},
         .make = make_motion,
         .clear = [](PlotResult& result, PlotParts&) { result.opened = nullptr; },
         .of_program = true,
         .shown = true},
    };
}

} // namespace

void PlotStageWork::note(std::optional<Diagnostic> notice) const {
    if (notice) {
        notice->place.file = result.input.file;
        notices.push_back(std::move(*notice));
    }
}

PlotSource plot_source_of(const project::PlotInput& input, const fs::path& assets) {
    const fs::path folder = input.file.parent_path();
    PlotSource source{.input = input, .file = state_of(input.file)};
    try { // what is not found is reported where it is read
        source.machine = state_of(project::machine_path(input.settings.machine, folder, assets));
        source.post = state_of(project::post_path(input.settings.post, folder, assets));
    } catch (const Error&) {
    }
    return source;
}

std::span<const PlotStage> plot_stages() {
    static const std::vector<PlotStage> stages = [] {
        std::vector<PlotStage> all = stages_to_path();
        std::ranges::move(stages_of_path(), std::back_inserter(all));
        return all;
    }();
    return stages;
}

} // namespace millwright::plan
