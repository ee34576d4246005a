#include "app/plots/stroke_cutting.h"

#include "app/command_line/option_values.h"
#include "app/command_line/origin_choice.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/plot/cut_path.h"
#include "core/plot/level_text.h"
#include "core/plot/linking.h"
#include "core/plot/ordering.h"
#include "core/plot/stroke_plan.h"
#include "core/plot/work_time.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <algorithm>
#include <cstdio>
#include <map>
#include <string>
#include <utility>

namespace millwright::app {

namespace {

using plot::CutterSide;
using plot::Strokes;

const std::map<std::string, CutterSide> sides = {
    {"on-line", CutterSide::on_line}, {"outside", CutterSide::outside}, {"inside", CutterSide::inside}};
const std::map<std::string, plot::Corners> corner_kinds = {{"sharp", plot::Corners::sharp},
                                                           {"round", plot::Corners::round}};

/// A pen is cut several times where a tool or an order tells its levels apart.
void expect_another(const std::vector<plot::Level>& named,
                    const plot::Level& level,
                    const std::string& text) {
    const bool same = std::ranges::any_of(named, [&](const plot::Level& other) {
        return other.pen == level.pen && other.tool == level.tool && other.order == level.order;
    });
    if (same) {
        throw Error(
            fmt::format("level '{}': pen {} already has one with the same tool and order", text, level.pen),
            {},
            "remove one, or give it another order= or tool=, so that both are cut");
    }
}

void expect_not_below(double change_height, double safe_height) {
    if (change_height < safe_height) {
        throw Error(fmt::format("--change-position: the tool change position at Z {:g} mm is below the safe "
                                "height of {:g} mm",
                                change_height,
                                safe_height),
                    {},
                    "give a Z at or above it, or a lower --safe-height");
    }
}

plot::CutSettings cut_settings(const Strokes& strokes, const StrokeCutting& options) {
    plot::Level like;
    like.depth = options.depth;
    like.passes = options.passes;
    like.cutting = from_mm_per_min(options.cutting.feed_mm_per_min);
    like.plunging = from_mm_per_min(options.cutting.plunge_mm_per_min);
    like.tabs = options.tabs;
    plot::CutSettings cut;
    cut.safe_height = options.cutting.safe_height;
    if (options.change_position.empty()) {
        cut.change_position.z() = std::max(cut.change_position.z(), cut.safe_height);
    } else {
        cut.change_position = origin_from(options.change_position).at();
        expect_not_below(cut.change_position.z(), cut.safe_height);
    }
    cut.change_position -= origin_from(options.cutting.origin).at(); // on the machine, as it is moved there
    cut.levels = plot::levels_for(strokes, like);
    for (plot::Level& level : cut.levels) {
        const auto drawn = std::ranges::find(options.drawn_levels, level.pen, &plot::Level::pen);
        if (drawn != options.drawn_levels.end()) {
            const int order = level.order;
            level = *drawn;
            level.order = order;
        }
    }
    std::vector<plot::Level> named;
    for (const std::string& text : options.levels) {
        const int pen = plot::parse_level(text, like).pen;
        const auto drawn = std::ranges::find(cut.levels, pen, &plot::Level::pen);
        if (drawn == cut.levels.end()) {
            throw Error(fmt::format("level '{}': pen {} draws nothing", text, pen));
        }
        const plot::Level level = plot::parse_level(text, *drawn);
        expect_another(named, level, text);
        named.push_back(level);
    }
    // A pen that is named has the levels that name it, where they are named.
    std::erase_if(cut.levels, [&](const plot::Level& level) {
        return std::ranges::find(named, level.pen, &plot::Level::pen) != named.end();
    });
    cut.levels.insert(cut.levels.begin(), named.begin(), named.end());
    cut.levels = plot::with_tab_widths(std::move(cut.levels), options.plan.tool_diameter);
    return cut;
}

/// What becomes of the strokes, step by step. A step that changes nothing is not planned once more.
class Steps {
public:
    Steps(const Vec2& end, const StrokeCutting& options) : end_(end), options_(options) {}

    void say(const char* what, const Strokes& strokes) {
        const plot::CutSettings cut = cut_settings(strokes, options_);
        plot::CutPath path = plot::cut_path(strokes, cut);
        if (path != path_) {
            seconds_ = planned_seconds(path, options_.cutting);
            path_ = std::move(path);
        }
        const plot::WorkTime time = plot::work_time(strokes, cut.levels, {}, Vec2::Zero(), end_);
        fmt::print("{}: {}, {} by the thesis's formula, {} at the given feed rates, {} by the planner\n",
                   what,
                   way_for_people(time),
                   plot::time_for_people(time.seconds),
                   plot::time_for_people(time.seconds_at_feeds),
                   plot::time_for_people(seconds_));
    }
    [[nodiscard]] const plot::CutPath& path() const { return path_; }
    [[nodiscard]] double seconds() const { return seconds_; }

private:
    Vec2 end_;
    const StrokeCutting& options_;
    plot::CutPath path_; ///< of the last step
    double seconds_ = 0.0;
};

} // namespace

std::string way_for_people(const plot::WorkTime& time) {
    constexpr double m = 1e-3;
    return fmt::format("{:.3f} m ({:.3f} m drawn, {:.3f} m travel), {} {}",
                       m * time.distance(),
                       m * time.cut_length,
                       m * time.travel_length,
                       time.runs,
                       time.runs == 1 ? "lift" : "lifts");
}

void add_stroke_options(CLI::App& command, StrokeCutting& options) {
    command
        .add_option("--side", options.plan.side, "Cutter side of closed strokes: on-line, outside or inside")
        ->transform(one_of(sides))
        ->type_name(choice_list(sides))
        ->default_str("on-line");
    command
        .add_option(
            "--tool-diameter", options.plan.tool_diameter, "End mill diameter for --side and --preview, mm")
        ->check(above_zero())
        ->capture_default_str();
    command.add_option("--corners", options.plan.corners, "Corners with --side: sharp or round")
        ->transform(one_of(corner_kinds))
        ->type_name(choice_list(corner_kinds))
        ->default_str("sharp");
    command
        .add_option("--hatch", options.plan.hatch_pitch, "Fill closed strokes with lines at this spacing, mm")
        ->check(above_zero());
    command.add_option("--hatch-angle", options.hatch_angle_deg, "Angle of the hatch lines to X, degrees");
    command.add_flag("--hatch-cross", options.plan.hatch_cross, "Add a second hatch at right angles");
    command
        .add_option(
            "--contours", options.plan.contour_pitch, "Fill closed strokes with contours at this spacing, mm")
        ->check(above_zero());
    command.add_flag("--order", options.plan.order, "Reorder and reverse strokes for less travel");
    command.add_option("--link", options.plan.link, "Join strokes across gaps shorter than this, mm")
        ->check(not_below_zero());
    command.add_flag("--inside", options.plan.link_inside, "Do not let links cross closed strokes");
    command.add_option("--depth", options.depth, "Depth below the top, mm")
        ->check(not_below_zero())
        ->capture_default_str();
    command.add_option("--passes", options.passes, "Number of passes to full depth")
        ->check(above_zero())
        ->capture_default_str();
    command
        .add_option("--level",
                    options.levels,
                    "Settings of one pen: "
                    "PEN:depth=MM,passes=N,feed=F,plunge=F,order=N,tool=N,side=SIDE,cutter=MM,tabs=N,off")
        ->check(parsed_by([](const std::string& text) { (void)plot::parse_level(text, {}); }))
        ->allow_extra_args(false);
    command
        .add_option("--change-position",
                    options.change_position,
                    "Tool change position in machine coordinates: X,Y,Z, mm")
        ->delimiter(',')
        ->expected(3)
        ->type_name("X,Y,Z")
        ->allow_extra_args(false);
    command.add_option("--tabs", options.tabs.count, "Number of tabs on closed strokes")
        ->check(not_below_zero())
        ->capture_default_str();
    command.add_option("--tab-width", options.tabs.width, "Tab width, mm")
        ->check(above_zero())
        ->capture_default_str();
    command.add_option("--tab-height", options.tabs.height, "Tab height, mm")
        ->check(above_zero())
        ->capture_default_str();
    add_cutting_options(command, options.cutting);
}

void cut_strokes(const Strokes& as_drawn,
                 const Vec2& end,
                 const StrokeCutting& options,
                 const std::vector<std::string>& header,
                 const Progress& progress) {
    plot::StrokePlan plan = options.plan;
    plan.hatch_angle = from_degrees(options.hatch_angle_deg);
    const std::vector<plot::Level> levels = cut_settings(as_drawn, options).levels;
    plan = plot::with_cutters(std::move(plan), levels);
    const Strokes drawn = plot::outlines_for(as_drawn, plan);
    plot::ShapedStrokes shaped = plot::shaped(drawn, plan);
    if (shaped.strokes.empty()) {
        throw Error("there is nothing to cut");
    }
    if (const std::string unprocessed_strokes = plot::unprocessed_strokes(drawn, shaped, plan);
        !unprocessed_strokes.empty()) {
        fmt::print(stderr, "millwright: {}\n", unprocessed_strokes);
    }
    Strokes strokes = std::move(shaped.strokes);
    Steps steps(end, options);
    steps.say("as drawn", strokes);
    if (plan.order) {
        strokes = plot::ordered(
            strokes, cut_settings(strokes, options), Vec2::Zero(), end, progress.part(0.0, 0.3));
        steps.say("ordered", strokes);
    }
    if (plan.link > 0.0) {
        strokes = plot::linked(strokes, drawn, plan);
        steps.say("linked", strokes);
    }
    CuttingOptions cutting = options.cutting;
    cutting.preview.tool_diameters = plot::tool_diameters(levels);
    write_program(steps.path(),
                  cutting,
                  {.kind = plot::TipKind::flat, .diameter = plan.tool_diameter},
                  header,
                  progress.part(0.3, 1.0),
                  steps.seconds());
}

} // namespace millwright::app
