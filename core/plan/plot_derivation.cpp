#include "core/plan/internal/plot_derivation.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/gcode_programs/cut_program.h"
#include "core/hpgl/reader.h"
#include "core/kinematics/machine_file.h"
#include "core/plan/internal/failure.h"
#include "core/plan/internal/plot_view.h"
#include "core/plan/internal/posted_plot.h"
#include "core/plan/internal/program_reading.h"
#include "core/plan/plot_time.h"
#include "core/plot/cut_path.h"
#include "core/plot/linking.h"
#include "core/plot/ordering.h"
#include "core/plot/path_file.h"
#include "core/plot/picture/engraving.h"
#include "core/plot/picture/finished_look.h"
#include "core/plot/picture/picture.h"
#include "core/plot/picture/relief_plan.h"
#include "core/plot/picture/trace.h"
#include "core/plot/plot_program.h"
#include "core/plot/point_file.h"
#include "core/plot/stroke_plan.h"
#include "core/project/assets.h"
#include "core/project/gcode_file.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <set>
#include <string>
#include <utility>

namespace millwright::plan {

namespace fs = std::filesystem;

namespace {

constexpr int look_squares = 160;

} // namespace

const std::vector<PlotDerivation::Stage>& PlotDerivation::stages() {
    static const std::vector<Stage> rows = {
        {.share = 0.5, .make = &PlotDerivation::make_path, .shown = true},
        {.share = 0.2, .make = &PlotDerivation::make_look},
        {.make = &PlotDerivation::check_speeds, .shown = true},
        {.title = "Writing the program",
         .share = 0.1,
         .make = &PlotDerivation::make_program,
         .of_program = true},
        {.share = 0.1, .make = &PlotDerivation::time_as_drawn, .of_program = true, .finishes = true},
        {.share = 0.1, .make = &PlotDerivation::make_motion, .of_program = true, .shown = true},
    };
    return rows;
}

void PlotDerivation::run(const Publish& publish) {
    whole_.report(0.0, "Cutting " + result_.input.file.filename().string());
    run(stages(), publish);
}

void PlotDerivation::run_program(const Publish& publish) {
    std::vector<Stage> of_program = stages();
    std::erase_if(of_program, [](const Stage& stage) { return !stage.of_program; });
    asked_for_ = true;
    run(of_program, publish);
}

void PlotDerivation::run(const std::vector<Stage>& stages, const Publish& publish) {
    double work = 0.0;
    for (const Stage& stage : stages) {
        work += stage.share;
    }
    double done = 0.0;
    result_.failure = failure_of([&] {
        for (const Stage& stage : stages) {
            progress_ = whole_.part(done / work, (done + stage.share) / work);
            done += stage.share;
            if (!stage.of_program || wants_program()) {
                make(stage, publish);
            } else {
                result_.program = nullptr;
                result_.opened = nullptr;
            }
        }
    });
    if (result_.failure) {
        result_.program = nullptr;
        result_.opened = nullptr;
    }
    if (result_.failure || !result_.finished) {
        whole_.check(); // no longer needed: what is there stays
        result_.finished = true;
        publish();
    }
}

void PlotDerivation::make(const Stage& stage, const Publish& publish) {
    progress_.check();
    progress_.report(0.0, stage.title);
    (this->*stage.make)(publish);
    progress_.check(); // no longer needed: what is there stays
    result_.finished = result_.finished || stage.finishes;
    if (stage.shown || stage.finishes) {
        publish();
    }
}

void PlotDerivation::make_path(const Publish&) {
    result_.picture = project::is_picture_file(result_.input.file);
    if (project::is_path_file(result_.input.file)) {
        use(plot::read_path(read_file(result_.input.file), result_.input.file));
    } else if (project::holds_points(result_.input.file)) {
        cut_points();
    } else if (project::is_gcode_file(result_.input.file)) {
        cut_program();
    } else if (result_.picture) {
        cut_picture();
    } else {
        cut_drawing();
    }
    if (result_.path->empty()) {
        throw Error("there is nothing to cut", result_.input.file);
    }
    if (settings_.plate > 0.0 && !settings_.through) {
        plot::expect_within_plate(*result_.path, settings_.plate);
    }
}

void PlotDerivation::check_speeds(const Publish&) {
    const kinematics::MachineModel machine = kinematics::read_machine(
        project::machine_path(settings_.machine, result_.input.file.parent_path(), assets_));
    note(plot::speeds_not_reached(*result_.path, machine));
}

void PlotDerivation::note(std::optional<Diagnostic> notice) {
    if (notice) {
        notice->place.file = result_.input.file;
        result_.notices.push_back(std::move(*notice));
    }
}

void PlotDerivation::make_look(const Publish&) {
    const plot::ToolTips tips = tips_of(result_);
    const bool cuts =
        std::ranges::any_of(*result_.path, [](const plot::CutPoint& point) { return point.at.z() < 0.0; });
    if (!cuts || tips.usual.kind == plot::TipKind::point) {
        return;
    }
    auto look =
        std::make_shared<plot::HeightField>(plot::finished_by(*result_.path, tips, look_squares, progress_));
    constexpr double spare = 0.5;
    const double plate =
        settings_.plate > 0.0 ? settings_.plate : spare - static_cast<double>(std::ranges::min(look->z));
    result_.light = plot::against_light(*look, plate, settings_.half_light);
    result_.look = std::move(look);
}

void PlotDerivation::make_program(const Publish&) {
    PostedPlot posted = posted_plot(result_, *result_.path, assets_);
    PlotProgram made;
    made.name = result_.input.file.stem().string() + ".ngc";
    made.program = std::make_shared<const program::Program>(std::move(posted.released.program));
    made.listing = std::make_shared<const program::Listing>(std::move(posted.released.listing));
    result_.program = std::make_shared<const PlotProgram>(std::move(made));
    result_.opened = nullptr;
}

void PlotDerivation::make_motion(const Publish& publish) {
    OpenedProgram now;
    now.file = result_.program->name;
    now.choice.machine = settings_.machine;
    const auto show = [&] {
        progress_.check();
        ++now.revision;
        result_.opened = std::make_shared<const OpenedProgram>(now);
        publish();
    };
    now.text = std::make_shared<const ProgramText>(result_.program->listing, progress_.part(0.0, 0.1));
    ProgramReading(now, result_.input.file.parent_path(), assets_, show).read(progress_.part(0.1, 1.0));
    now.finished = true;
    ++now.revision;
    result_.opened = std::make_shared<const OpenedProgram>(std::move(now));
}

void PlotDerivation::time_as_drawn(const Publish&) {
    if (as_drawn_.empty() || result_.cut_as_drawn) {
        return;
    }
    auto failure = failure_of([&] {
        const PostedPlot posted = posted_plot(result_, as_drawn_, assets_);
        result_.drawn_seconds =
            seconds_of_text(posted.released, posted.format, posted.machine, posted.file, progress_);
    });
    if (failure) {
        failure->message = "the time as drawn cannot be computed: " + failure->message;
    }
    note(std::move(failure));
}

void PlotDerivation::cut_drawing() {
    hpgl::HpglSettings reading = settings_.hpgl;
    const bool carved = project::is_carved(result_.input);
    if (carved) { // whole outlines
        reading.fill = reading.fill == hpgl::FillMode::hatched ? hpgl::FillMode::outline : reading.fill;
        reading.dashes = false;
        reading.arc_tolerance =
            reading.arc_tolerance.value_or(plot::carving_chords(settings_.carving_tolerance));
    }
    const hpgl::Plot read = hpgl::read_hpgl_file(result_.input.file, reading);
    result_.notices = hpgl::notices(read, result_.input.file);
    if (carved) {
        return carve_strokes(read.strokes);
    }
    cut_strokes(read.strokes, read.end);
}

/// As it stands, like a path file.
void PlotDerivation::cut_program() {
    const gcode::CutProgram read =
        gcode::read_cut_program_file(result_.input.file, {.chord_length = settings_.chord_length});
    if (!read.unplaced.empty()) {
        throw Error(read.unplaced.front());
    }
    result_.notices = read.notices;
    result_.program_rpm = read.spindle_rpm;
    if (read.spindle_rpm > 0.0 && std::abs(read.spindle_rpm - result_.spindle_rpm()) > 0.5) {
        note(Diagnostic{
            {},
            fmt::format("the program sets the spindle to {:.0f} rpm, but here it is set to {:.0f} rpm",
                        read.spindle_rpm,
                        result_.spindle_rpm()),
            "change it in the field Spindle speed under Work; its arrow restores the speed of the program"});
    }
    if (!(read.spindle_rpm > 0.0) && !settings_.spindle_rpm) {
        note(Diagnostic{
            {},
            fmt::format("the program sets no spindle speed: {:.0f} rpm is used here", result_.spindle_rpm()),
            "set another speed under Work"});
    }
    use(read.path);
}

/// Speeds are those of the usual level: the points have none before a period is chosen.
void PlotDerivation::cut_points() {
    auto points = std::make_shared<PlotPoints>();
    points->text = read_file(result_.input.file);
    points->read = plot::read_points(points->text, result_.input.file);
    if (!points->read.diagnostics.empty()) { // a table goes to no place that was guessed
        throw Error(points->read.diagnostics.front());
    }
    use(plot::path_of_points(points->read.points,
                             {.cutting = settings_.level.cutting,
                              .plunging = settings_.level.plunging,
                              .safe_height = settings_.safe_height}));
    for (Vec3& point : points->read.points) {
        point += Vec3(settings_.origin.x(), settings_.origin.y(), 0.0);
    }
    result_.points = std::move(points);
}

void PlotDerivation::cut_picture() {
    plot::PictureSettings reading = settings_.picture;
    reading.ground = settings_.use == project::PictureUse::relief ? plot::relief_top : plot::white;
    plot::ReadPicture read = plot::read_picture_file(result_.input.file, reading, progress_.part(0.0, 0.4));
    result_.notices = std::move(read.notices);
    const plot::Picture& picture = read.picture;
    const double pitch = plot::pixel_pitch(settings_.size, picture);
    result_.picture_size = pitch * Vec2(picture.width, picture.height);
    show_picture(reading, pitch / picture.file_pixels);
    switch (settings_.use) {
    case project::PictureUse::relief:
        return cut_relief(picture, pitch);
    case project::PictureUse::outlines:
        return cut_strokes(plot::strokes_of(plot::trace(picture, settings_.tracing), pitch, settings_.chords),
                           Vec2::Zero());
    case project::PictureUse::carving:
        return carve_strokes(plot::strokes_of(plot::trace(picture, settings_.tracing),
                                              pitch,
                                              plot::carving_chords(settings_.carving_tolerance)));
    case project::PictureUse::halftone:
        return use(plot::halftone(picture,
                                  pitch,
                                  {.pitch = settings_.dot_pitch,
                                   .angle = settings_.dot_angle,
                                   .tip = settings_.tip,
                                   .plunging = settings_.level.plunging,
                                   .safe_height = settings_.safe_height}));
    case project::PictureUse::dots:
        break;
    }
    plot::Level level = settings_.level;
    level.depth = settings_.depth;
    use(plot::cut_path(
        plot::dithered(picture, pitch, {.pitch = settings_.dot_pitch, .join = settings_.join_dots}),
        cut_of({level})));
}

void PlotDerivation::carve_strokes(const plot::Strokes& drawn) {
    plot::Carving made = plot::v_carving(drawn,
                                         {.tip = settings_.tip,
                                          .largest_depth = settings_.largest_depth,
                                          .depth_per_pass = settings_.depth_per_pass,
                                          .clear_floor = settings_.clear_floor,
                                          .step_over = settings_.step_over,
                                          .tolerance = settings_.carving_tolerance,
                                          .close_gaps = settings_.close_gaps,
                                          .cutting = settings_.level.cutting,
                                          .plunging = settings_.level.plunging,
                                          .safe_height = settings_.safe_height},
                                         progress_.part(0.4, 1.0));
    for (Diagnostic& notice : made.notices) {
        note(std::move(notice));
    }
    result_.carved = made;
    result_.cuts = cuts_by_depth(made.path, settings_.origin);
    use(std::move(made.path));
}

/// `pixel`: side of a square one, mm.
void PlotDerivation::show_picture(const plot::PictureSettings& reading, double pixel) {
    plot::PictureSettings whole = reading;
    whole.region.reset();
    whole.most_pixels = 1 << 16;
    plot::FilePixels read = plot::read_file_pixels(result_.input.file, whole, progress_.part(0.3, 0.4));
    auto shown = std::make_shared<ShownPicture>();
    shown->picture = std::move(read.picture);
    const int side = shown->picture.file_pixels;
    const plot::PixelRegion region = reading.region.value_or(plot::PixelRegion{});
    const int below = region.height > 0 ? side * shown->picture.height - region.top - region.height : 0;
    const Vec2 of_pixel(pixel * read.pixel_width, pixel * read.pixel_height * reading.pixel_aspect);
    shown->cell = side * of_pixel;
    const Vec2 middle = 0.5 * (shown->cell - of_pixel); // of a square, from that of its first pixel
    shown->corner = settings_.origin + middle - Vec2(region.left, below).cwiseProduct(of_pixel);
    result_.shown_picture = std::move(shown);
}

void PlotDerivation::cut_relief(const plot::Picture& picture, double pitch) {
    plot::ReliefPlan plan;
    plan.relief.tip = settings_.tip;
    plan.relief.step_over = settings_.step_over.value_or(plot::usual_step_over(settings_.tip, pitch));
    result_.step_over = *plan.relief.step_over;
    plan.relief.merge_tolerance = settings_.merge;
    if (settings_.depth_per_pass) {
        plan.relief.roughing =
            plot::Roughing{*settings_.depth_per_pass, settings_.allowance, settings_.rough_step_over};
    }
    plan.relief.cutting = settings_.level.cutting;
    plan.relief.plunging = settings_.level.plunging;
    plan.relief.safe_height = settings_.safe_height;
    plan.plate = settings_.frame;
    plan.frame_margin = settings_.frame_margin;
    plan.tabs = settings_.frame_tabs;
    plan.through = settings_.through;
    note(plot::frame_notice(plan));
    const plot::HeightField field = plot::height_field(picture, pitch, settings_.depth);
    if (!plot::is_cut(field) && !settings_.frame) {
        throw Error("the picture is entirely black or transparent: the relief would cut nothing",
                    result_.input.file,
                    "try Invert under Picture");
    }
    use(plot::relief_path(field, plan, progress_.part(0.4, 1.0)));
}

plot::CutSettings PlotDerivation::cut_of(std::vector<plot::Level> levels) const {
    plot::CutSettings cut;
    cut.levels = std::move(levels);
    cut.safe_height = settings_.safe_height;
    // The path is moved to the origin as a whole.
    cut.change_position = settings_.change_position - Vec3(settings_.origin.x(), settings_.origin.y(), 0.0);
    cut.change_position.z() = std::max(cut.change_position.z(), cut.safe_height);
    return cut;
}

/// Those that are set, and one like `level` for each other pen.
std::vector<plot::Level> PlotDerivation::levels_of(const plot::Strokes& strokes) const {
    std::vector<plot::Level> levels;
    for (const plot::Level& usual : plot::levels_for(strokes, settings_.level)) {
        bool set = false;
        for (const plot::Level& level : settings_.levels) {
            if (level.pen == usual.pen) {
                levels.push_back(level);
                set = true;
            }
        }
        if (!set) {
            levels.push_back(usual);
        }
    }
    return levels;
}

plot::Strokes PlotDerivation::plan_strokes(const plot::Strokes& as_drawn, const Vec2& end) {
    const plot::StrokePlan plan = plot::with_cutters(settings_.strokes, levels_of(as_drawn));
    const plot::Strokes drawn = plot::outlines_for(as_drawn, plan);
    plot::ShapedStrokes shaped = plot::shaped(drawn, plan);
    if (const std::string unprocessed_strokes = plot::unprocessed_strokes(drawn, shaped, plan);
        !unprocessed_strokes.empty()) {
        result_.notices.push_back(
            {.place = {.file = result_.input.file}, .message = unprocessed_strokes, .hint = {}});
    }
    if (settings_.strokes.order) {
        shaped.strokes = plot::ordered(
            shaped.strokes, cut_of(levels_of(shaped.strokes)), Vec2::Zero(), end, progress_.part(0.4, 0.8));
    }
    return plot::linked(shaped.strokes, drawn, plan);
}

/// Of a path that changes tools.
void PlotDerivation::note_raised_change() {
    const bool changes = std::ranges::any_of(
        *result_.path, [](const plot::CutPoint& point) { return point.move == plot::CutMove::tool_change; });
    if (changes && settings_.change_position.z() < settings_.safe_height) {
        note(Diagnostic{{},
                        fmt::format("tools are changed at Z {:g} mm, the safe height, because Tool change Z, "
                                    "{:g} mm, is below it",
                                    settings_.safe_height,
                                    settings_.change_position.z()),
                        "raise Tool change Z, or lower the safe height, under Work"});
    }
}

void PlotDerivation::cut_strokes(const plot::Strokes& drawn, const Vec2& end) {
    const plot::Strokes planned = plan_strokes(drawn, end);
    result_.drawn_strokes = drawn.size();
    result_.levels = levels_of(planned);
    result_.as_drawn = plot::work_time(drawn, levels_of(drawn), {}, Vec2::Zero(), end);
    result_.as_planned = plot::work_time(planned, result_.levels, {}, Vec2::Zero(), end);
    const auto standing = [&](std::vector<plot::Level> levels) {
        return plot::with_tab_widths(std::move(levels), settings_.strokes.tool_diameter);
    };
    std::vector<plot::Level> in_order = result_.levels;
    std::ranges::stable_sort(in_order, {}, &plot::Level::order);
    result_.cuts.clear();
    for (const plot::Level& level : in_order) {
        if (level.enabled) {
            result_.cuts.push_back(
                {.pen = level.pen,
                 .path = cuts_of(plot::cut_path(planned, cut_of(standing({level}))), settings_.origin)});
            progress_.check();
        }
    }
    const plot::CutSettings cut = cut_of(standing(result_.levels));
    as_drawn_ = placed(plot::cut_path(drawn, cut));
    use(plot::cut_path(planned, cut));
    note_raised_change();
    result_.cut_as_drawn = as_drawn_ == *result_.path;
}

/// Where it lies on the machine.
plot::CutPath PlotDerivation::placed(plot::CutPath path) const {
    for (plot::CutPoint& point : path) {
        point.at += Vec3(settings_.origin.x(), settings_.origin.y(), 0.0);
    }
    return path;
}

void PlotDerivation::use(plot::CutPath path) {
    path = placed(std::move(path));
    result_.lengths = plot::lengths(path);
    if (result_.cuts.empty()) {
        std::set<int> tools;
        for (const plot::CutPoint& point : path) {
            tools.insert(point.tool);
        }
        for (const int tool : tools) {
            result_.cuts.push_back({.pen = tool, .path = cuts_with(path, tool)});
        }
    }
    result_.air = travel_of(path);
    result_.path = std::make_shared<const plot::CutPath>(std::move(path));
}

} // namespace millwright::plan
