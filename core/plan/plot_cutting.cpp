#include "core/plan/internal/plot_cutting.h"

#include "core/base/error.h"
#include "core/plan/internal/plot_view.h"
#include "core/plot/cut_path.h"
#include "core/plot/linking.h"
#include "core/plot/ordering.h"
#include "core/plot/picture/engraving.h"
#include "core/plot/picture/relief_plan.h"
#include "core/plot/picture/trace.h"
#include "core/plot/point_file.h"
#include "core/plot/stroke_plan.h"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string>
#include <utility>

namespace millwright::plan {

namespace {

using project::PictureUse;
using project::PlotSettings;

/// mm, of a pixel of the picture.
double pitch_of(const PlotStageWork& work) {
    return plot::pixel_pitch(work.settings().size, *work.parts.picture);
}

plot::CutSettings cut_of(const PlotSettings& settings, std::vector<plot::Level> levels) {
    plot::CutSettings cut;
    cut.levels = std::move(levels);
    cut.safe_height = settings.safe_height;
    // The path is moved to the origin as a whole.
    cut.change_position = settings.change_position - Vec3(settings.origin.x(), settings.origin.y(), 0.0);
    cut.change_position.z() = std::max(cut.change_position.z(), cut.safe_height);
    return cut;
}

/// Those that are set, and one like `level` for each other pen.
std::vector<plot::Level> levels_of(const PlotSettings& settings, const plot::Strokes& strokes) {
    std::vector<plot::Level> levels;
    for (const plot::Level& usual : plot::levels_for(strokes, settings.level)) {
        bool set = false;
        for (const plot::Level& level : settings.levels) {
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

std::vector<plot::Level> with_tabs(const PlotSettings& settings, std::vector<plot::Level> levels) {
    return plot::with_tab_widths(std::move(levels), settings.strokes.tool_diameter);
}

/// What is cut along its lines, or carved; null: it is neither.
std::shared_ptr<const plot::Strokes> drawn_strokes(const PlotStageWork& work) {
    const PlotSettings& settings = work.settings();
    if (!work.parts.picture) {
        return work.parts.read_strokes;
    }
    const bool carves = settings.use == PictureUse::carving;
    if (!carves && settings.use != PictureUse::outlines) {
        return nullptr;
    }
    return std::make_shared<const plot::Strokes>(
        plot::strokes_of(plot::trace(*work.parts.picture, settings.tracing),
                         pitch_of(work),
                         carves ? plot::carving_chords(settings.carving_tolerance) : settings.chords));
}

plot::Strokes planned_strokes(const PlotStageWork& work, const plot::Strokes& as_drawn) {
    const PlotSettings& settings = work.settings();
    const plot::StrokePlan plan = plot::with_cutters(settings.strokes, levels_of(settings, as_drawn));
    const plot::Strokes drawn = plot::outlines_for(as_drawn, plan);
    plot::ShapedStrokes shaped = plot::shaped(drawn, plan);
    if (std::string unprocessed_strokes = plot::unprocessed_strokes(drawn, shaped, plan);
        !unprocessed_strokes.empty()) {
        work.note(Diagnostic{.place = {}, .message = std::move(unprocessed_strokes), .hint = {}});
    }
    if (settings.strokes.order) {
        shaped.strokes = plot::ordered(shaped.strokes,
                                       cut_of(settings, levels_of(settings, shaped.strokes)),
                                       Vec2::Zero(),
                                       work.parts.end,
                                       work.progress);
    }
    return plot::linked(shaped.strokes, drawn, plan);
}

plot::CutPath relief(const PlotStageWork& work) {
    const PlotSettings& settings = work.settings();
    const double pitch = pitch_of(work);
    plot::ReliefPlan plan;
    plan.relief.tip = settings.tip;
    plan.relief.step_over = settings.step_over.value_or(plot::usual_step_over(settings.tip, pitch));
    work.result.step_over = *plan.relief.step_over;
    plan.relief.merge_tolerance = settings.merge;
    if (settings.depth_per_pass) {
        plan.relief.roughing =
            plot::Roughing{*settings.depth_per_pass, settings.allowance, settings.rough_step_over};
    }
    plan.relief.cutting = settings.level.cutting;
    plan.relief.plunging = settings.level.plunging;
    plan.relief.safe_height = settings.safe_height;
    plan.plate = settings.frame;
    plan.frame_margin = settings.frame_margin;
    plan.tabs = settings.frame_tabs;
    plan.through = settings.through;
    work.note(plot::frame_notice(plan));
    const plot::HeightField field = plot::height_field(*work.parts.picture, pitch, settings.depth);
    if (!plot::is_cut(field) && !settings.frame) {
        throw Error("the picture is entirely black or transparent: the relief would cut nothing",
                    work.result.input.file,
                    "try Invert under Picture");
    }
    return plot::relief_path(field, plan, work.progress);
}

plot::CutPath dots(const PlotStageWork& work) {
    const PlotSettings& settings = work.settings();
    plot::Level level = settings.level;
    level.depth = settings.depth;
    const plot::Strokes strokes = plot::dithered(
        *work.parts.picture, pitch_of(work), {.pitch = settings.dot_pitch, .join = settings.join_dots});
    return plot::cut_path(strokes, cut_of(settings, {level}));
}

plot::CutPath halftone(const PlotStageWork& work) {
    const PlotSettings& settings = work.settings();
    return plot::halftone(*work.parts.picture,
                          pitch_of(work),
                          {.pitch = settings.dot_pitch,
                           .angle = settings.dot_angle,
                           .tip = settings.tip,
                           .plunging = settings.level.plunging,
                           .safe_height = settings.safe_height});
}

plot::CutPath carving(const PlotStageWork& work) {
    const PlotSettings& settings = work.settings();
    plot::Carving made = plot::v_carving(*work.parts.drawn,
                                         {.tip = settings.tip,
                                          .largest_depth = settings.largest_depth,
                                          .depth_per_pass = settings.depth_per_pass,
                                          .clear_floor = settings.clear_floor,
                                          .step_over = settings.step_over,
                                          .tolerance = settings.carving_tolerance,
                                          .close_gaps = settings.close_gaps,
                                          .cutting = settings.level.cutting,
                                          .plunging = settings.level.plunging,
                                          .safe_height = settings.safe_height},
                                         work.progress);
    for (Diagnostic& notice : made.notices) {
        work.note(std::move(notice));
    }
    work.result.carved = made;
    return std::move(made.path);
}

/// Of a path that changes tools.
void note_raised_change(const PlotStageWork& work, const plot::CutPath& path) {
    const PlotSettings& settings = work.settings();
    const bool changes = std::ranges::any_of(
        path, [](const plot::CutPoint& point) { return point.move == plot::CutMove::tool_change; });
    if (changes && settings.change_position.z() < settings.safe_height) {
        work.note(
            Diagnostic{{},
                       fmt::format("tools are changed at Z {:g} mm, the safe height, because Tool change Z, "
                                   "{:g} mm, is below it",
                                   settings.safe_height,
                                   settings.change_position.z()),
                       "raise Tool change Z, or lower the safe height, under Work"});
    }
}

void cut_strokes(const PlotStageWork& work) {
    const PlotSettings& settings = work.settings();
    const plot::CutSettings cut = cut_of(settings, with_tabs(settings, work.result.levels));
    PlotParts& parts = work.parts;
    parts.cut = std::make_shared<const plot::CutPath>(plot::cut_path(*parts.planned, cut));
    auto as_drawn = std::make_shared<const plot::CutPath>(plot::cut_path(*parts.drawn, cut));
    work.result.cut_as_drawn = *as_drawn == *parts.cut;
    parts.cut_as_drawn = work.result.cut_as_drawn ? parts.cut : std::move(as_drawn);
    note_raised_change(work, *parts.cut);
}

plot::CutPath path_of(const PlotStageWork& work) {
    const PlotSettings& settings = work.settings();
    if (work.parts.points) { // speeds are those of the usual level: they have none before a period is chosen
        return plot::path_of_points(work.parts.points->read.points,
                                    {.cutting = settings.level.cutting,
                                     .plunging = settings.level.plunging,
                                     .safe_height = settings.safe_height});
    }
    if (work.parts.drawn) {
        return carving(work);
    }
    if (!work.parts.picture) {
        return work.parts.read_path;
    }
    switch (settings.use) {
    case PictureUse::halftone:
        return halftone(work);
    case PictureUse::dots:
        return dots(work);
    case PictureUse::relief:
    case PictureUse::outlines: // strokes, which are there
    case PictureUse::carving:
        break;
    }
    return relief(work);
}

} // namespace

void plan_strokes(const PlotStageWork& work) {
    work.parts.drawn = drawn_strokes(work);
    if (!work.parts.drawn || project::is_carved(work.result.input)) {
        return;
    }
    const PlotSettings& settings = work.settings();
    const plot::Strokes& drawn = *work.parts.drawn;
    plot::Strokes planned = planned_strokes(work, drawn);
    work.result.drawn_strokes = drawn.size();
    work.result.levels = levels_of(settings, planned);
    const Vec2& end = work.parts.end;
    work.result.as_drawn = plot::work_time(drawn, levels_of(settings, drawn), {}, Vec2::Zero(), end);
    work.result.as_planned = plot::work_time(planned, work.result.levels, {}, Vec2::Zero(), end);
    work.parts.planned = std::make_shared<const plot::Strokes>(std::move(planned));
}

void make_cut(const PlotStageWork& work) {
    if (work.parts.planned) {
        cut_strokes(work);
    } else {
        work.parts.cut = std::make_shared<const plot::CutPath>(path_of(work));
    }
}

bool changes_tools(const project::PlotInput& input) {
    if (project::is_picture_file(input.file)) {
        return input.settings.use == PictureUse::outlines || input.settings.use == PictureUse::dots;
    }
    return !project::is_carved(input);
}

std::shared_ptr<const plot::CutPath> at_origin(const std::shared_ptr<const plot::CutPath>& path,
                                               const Vec2& origin) {
    if (!path || origin == Vec2::Zero()) {
        return path;
    }
    auto moved = std::make_shared<plot::CutPath>(*path);
    for (plot::CutPoint& point : *moved) {
        point.at += Vec3(origin.x(), origin.y(), 0.0);
    }
    return moved;
}

std::vector<PlotResult::LevelPath> cuts_by_level(const PlotStageWork& work) {
    const PlotSettings& settings = work.settings();
    std::vector<PlotResult::LevelPath> cuts;
    if (work.parts.planned) {
        std::vector<plot::Level> in_order = work.result.levels;
        std::ranges::stable_sort(in_order, {}, &plot::Level::order);
        for (const plot::Level& level : in_order) {
            if (level.enabled) {
                const plot::CutPath path =
                    plot::cut_path(*work.parts.planned, cut_of(settings, with_tabs(settings, {level})));
                cuts.push_back({.pen = level.pen, .path = cuts_of(path, settings.origin)});
                work.progress.check();
            }
        }
    } else if (work.result.carved) {
        cuts = cuts_by_depth(*work.parts.cut, settings.origin);
    }
    if (!cuts.empty()) {
        return cuts;
    }
    std::set<int> tools;
    for (const plot::CutPoint& point : *work.result.path) {
        tools.insert(point.tool);
    }
    for (const int tool : tools) {
        cuts.push_back({.pen = tool, .path = cuts_with(*work.result.path, tool)});
    }
    return cuts;
}

} // namespace millwright::plan
