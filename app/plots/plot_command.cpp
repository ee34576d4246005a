#include "app/plots/plot_command.h"

#include "app/command_line/option_values.h"
#include "app/command_line/origin_choice.h"
#include "app/command_line/watched_work.h"
#include "app/plots/carving.h"
#include "app/plots/plot_points.h"
#include "app/plots/plot_program.h"
#include "app/plots/stroke_cutting.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"
#include "core/hpgl/reader.h"
#include "core/plot/cut_path.h"
#include "core/plot/decode.h"
#include "core/plot/point_file.h"
#include "core/plot/stroke_svg.h"
#include "core/plot/work_time.h"
#include "core/project/plot_choices.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <array>
#include <charconv>
#include <cmath>
#include <cstdio>
#include <map>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>

namespace millwright::app {

namespace {

using hpgl::Plot;
using plot::DecodeMode;
using plot::SampleRounding;
using plot::Strokes;

const std::map<std::string, SampleRounding> roundings = {{"down", SampleRounding::down},
                                                         {"nearest", SampleRounding::nearest},
                                                         {"up", SampleRounding::up},
                                                         {"exact", SampleRounding::exact}};
const std::map<std::string, DecodeMode> modes = {{"segments", DecodeMode::segments},
                                                 {"path", DecodeMode::path}};

/// The choices of the window, under the same names.
template <class Value> std::map<std::string, Value> by_id(std::span<const project::Choice<Value>> choices) {
    std::map<std::string, Value> found;
    for (const project::Choice<Value>& choice : choices) {
        found.emplace(choice.id, choice.value);
    }
    return found;
}

struct PlotOptions {
    std::string file;
    std::string out;
    std::string unit = "nominal";
    bool strict = false;
    bool json = false;
    bool solid = false;
    bool no_air = false;
    hpgl::HpglSettings reading;
    plot::DecodeSettings decode;
    std::optional<double> fastest;
    int decimals = 2;
    StrokeCutting cutting;
    CarvingOptions carving;
    ProgramReading program;
    const CLI::App* command = nullptr; ///< that was called
};

/// A length in mm, or one along x and one along y with a comma between.
std::optional<hpgl::PlotterUnit> lengths_of(std::string_view text) {
    std::array<double, 2> lengths{};
    std::size_t count = 0;
    while (count < lengths.size()) {
        const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), lengths[count]);
        if (fault != std::errc() || !(lengths[count] > 0.0 && std::isfinite(lengths[count]))) {
            return std::nullopt;
        }
        ++count;
        text.remove_prefix(static_cast<std::size_t>(end - text.data()));
        if (text.empty()) {
            return hpgl::PlotterUnit{.x = lengths[0], .y = lengths[count - 1]};
        }
        if (text.front() != ',') {
            return std::nullopt;
        }
        text.remove_prefix(1);
    }
    return std::nullopt;
}

hpgl::PlotterUnit unit_of(const std::string& text) {
    if (text == "nominal") {
        return hpgl::nominal_unit;
    }
    if (text == "table") {
        return hpgl::table_unit;
    }
    if (const auto unit = lengths_of(text)) {
        return *unit;
    }
    throw Error(fmt::format(
        "'{}' is not a plotter unit: use nominal, table, mm above 0, or two of them as X,Y", text));
}

Plot read_plot(const PlotOptions& options) {
    hpgl::HpglSettings settings = options.reading;
    settings.unit = unit_of(options.unit);
    settings.strictness = options.strict ? hpgl::Strictness::strict : hpgl::Strictness::tolerant;
    settings.dashes = !options.solid;
    return hpgl::read_hpgl_file(options.file, settings);
}

void print_notices(const Plot& plot, const std::string& file) {
    for (const Diagnostic& notice : hpgl::notices(plot, file)) {
        fmt::print(stderr, "millwright: {}\n", to_text(notice));
    }
}

/// What the file says nothing about is null.
nlohmann::ordered_json said(double value) {
    return value > 0.0 ? nlohmann::ordered_json(value) : nlohmann::ordered_json();
}

nlohmann::ordered_json plot_json(const Plot& plot) {
    nlohmann::ordered_json answer;
    answer["commands"] = plot.commands;
    answer["pens"] = nlohmann::ordered_json::array();
    std::map<int, double> lengths;
    for (const plot::Stroke& stroke : plot.strokes) {
        lengths[stroke.pen] += plot::length(stroke);
    }
    for (const auto& [pen, length] : lengths) {
        answer["pens"].push_back(pen);
    }
    const auto box = plot::extents(plot.strokes);
    answer["extents_mm"] = nullptr;
    if (box) {
        answer["extents_mm"] = {box->lower.x(), box->lower.y(), box->upper.x(), box->upper.y()};
    }
    const plot::WorkTime time = plot::work_time(plot.strokes, {}, Vec2::Zero(), plot.end);
    answer["draw_mm"] = time.cut_length;
    answer["air_mm"] = time.travel_length;
    answer["lifts"] = time.runs;
    answer["time_s"] = time.seconds;
    answer["strokes"] = plot.strokes.size();
    answer["pen_use"] = nlohmann::ordered_json::array();
    for (const auto& [pen, use] : plot.pens) {
        answer["pen_use"].push_back({{"pen", pen},
                                     {"draw_mm", lengths[pen]},
                                     {"speed_mm_s", said(use.speed)},
                                     {"width_mm", said(use.width)}});
    }
    answer["left_out"] = nlohmann::ordered_json::array();
    for (const hpgl::LeftOut& left_out : plot.left_out) {
        answer["left_out"].push_back(
            {{"command", left_out.name}, {"count", left_out.count}, {"why", left_out.why}});
    }
    answer["diagnostics"] = nlohmann::ordered_json::array();
    for (const Diagnostic& diagnostic : plot.diagnostics) {
        answer["diagnostics"].push_back({{"byte", diagnostic.place.byte}, {"message", diagnostic.message}});
    }
    answer["more_diagnostics"] = plot.more_diagnostics;
    return answer;
}

/// A file that draws nothing is no plot, or not the one that was meant.
void expect_strokes(const Plot& plot, const std::string& file) {
    if (plot.strokes.empty()) {
        throw Error(plot.commands > 0 ? "it contains nothing to draw"
                                      : "it contains no HPGL command, and does not begin as G-code",
                    file);
    }
}

/// A plot that is to become something else has to have strokes.
Plot read_plot_to_use(const PlotOptions& options) {
    Plot plot = read_plot(options);
    print_notices(plot, options.file);
    expect_strokes(plot, options.file);
    return plot;
}

std::string strokes_of_pens(const Plot& plot) {
    return counted(plot.strokes.size(), "stroke") + " of " +
           counted(plot::levels_for(plot.strokes).size(), "pen");
}

bool is_program(const PlotOptions& options) {
    return takes_program(*options.command, options.file);
}

/// With --safe-height and --arc-tolerance, which plots have too.
ProgramReading program_reading(const PlotOptions& options) {
    ProgramReading reading = options.program;
    reading.chord_tolerance = options.reading.arc_tolerance;
    if (options.command->count("--safe-height") > 0) {
        reading.safe_height = options.cutting.cutting.safe_height;
    }
    return reading;
}

int info(const PlotOptions& options) {
    if (takes_points(*options.command, options.file)) {
        return points_info(options.file, options.json);
    }
    if (is_program(options)) {
        return program_info(options.file, program_reading(options), options.json);
    }
    if (options.json) {
        const Plot plot = read_plot(options);
        fmt::print("{}\n",
                   plot_json(plot).dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace));
        expect_strokes(plot, options.file);
        return 0;
    }
    const Plot plot = read_plot_to_use(options);
    const plot::WorkTime time = plot::work_time(plot.strokes, {}, Vec2::Zero(), plot.end);
    fmt::print(
        "{}, {}\n", counted(static_cast<std::size_t>(plot.commands), "command"), strokes_of_pens(plot));
    if (const auto box = plot::extents(plot.strokes)) {
        fmt::print("x {:.3f} to {:.3f} mm, y {:.3f} to {:.3f} mm\n",
                   box->lower.x(),
                   box->upper.x(),
                   box->lower.y(),
                   box->upper.y());
    }
    fmt::print("{}, {} by the thesis's formula\n", way_for_people(time), plot::time_for_people(time.seconds));
    return 0;
}

std::vector<Vec3> plot_points(const PlotOptions& options) {
    if (takes_points(*options.command, options.file)) {
        throw Error("these are already points of a table",
                    options.file,
                    fmt::format("send them with 'millwright plot play {}'", options.file));
    }
    if (is_program(options)) {
        const bool flat = options.command->count("--pen-up") + options.command->count("--pen-down") > 0;
        return program_points(options.file, program_reading(options), options.decode, options.fastest, flat);
    }
    const Plot plot = read_plot_to_use(options);
    plot::DecodeSettings decoding = options.decode;
    decoding.end = plot.end;
    return options.fastest ? plot::decode_within(*options.fastest, plot.strokes, decoding)
                           : plot::decode(plot.strokes, decoding);
}

int decode(const PlotOptions& options) {
    std::vector<Vec3> points = plot_points(options);
    for (Vec3& point : points) {
        point += origin_from(options.cutting.cutting.origin).at();
    }
    write_file(options.out, plot::point_file_text(points, options.decimals));
    fmt::print("{}, {:.3f} s\n",
               counted(points.size(), "point"),
               static_cast<double>(points.size() - 1) * options.decode.period);
    return 0;
}

int view(const PlotOptions& options) {
    const plot::AirInSvg air = options.no_air ? plot::AirInSvg::left_out : plot::AirInSvg::shown;
    if (takes_points(*options.command, options.file)) {
        return points_view(options.file, air, options.out);
    }
    if (is_program(options)) {
        return program_view(options.file, program_reading(options), air, options.out);
    }
    const Plot plot = read_plot_to_use(options);
    write_file(options.out, plot::svg_text(plot.strokes, air));
    fmt::print("{}\n", strokes_of_pens(plot));
    return 0;
}

int toolpath(const PlotOptions& options) {
    if (takes_points(*options.command, options.file)) {
        return points_toolpath(options.file, options.cutting);
    }
    if (is_program(options)) {
        return program_toolpath(options.file, program_reading(options), options.cutting, *options.command);
    }
    const Plot plot = read_plot_to_use(options);
    cut_strokes(plot.strokes,
                plot.end,
                options.cutting,
                {"plot: " + std::filesystem::path(options.file).filename().string()});
    return 0;
}

int carve(const PlotOptions& options) {
    if (takes_points(*options.command, options.file)) {
        throw Error("these are points of a table: they enclose nothing", options.file);
    }
    PlotOptions fine = options;
    if (!fine.reading.arc_tolerance) {
        fine.reading.arc_tolerance = plot::carving_chords(options.carving.settings.tolerance);
    }
    fine.program.chord_tolerance = fine.reading.arc_tolerance;
    WatchedWork work;
    CarvingOptions carving = options.carving;
    Strokes strokes;
    if (is_program(options)) {
        const bool given = options.command->count("--safe-height") > 0;
        fine.program.safe_height = given ? std::optional(carving.cutting.safe_height) : std::nullopt;
        ProgramStrokes read = program_strokes(options.file, fine.program);
        carving.cutting.safe_height = given ? carving.cutting.safe_height : read.safe_height;
        strokes = std::move(read.strokes);
    } else {
        strokes = read_plot_to_use(fine).strokes;
    }
    carve_strokes(strokes, options.file, carving, work);
    return 0;
}

CLI::App&
add_reader(CLI::App& group, const char* name, const char* text, const std::shared_ptr<PlotOptions>& options) {
    CLI::App& command = *group.add_subcommand(name, text);
    command.add_option("FILE", options->file, "HPGL plot, G-code program of X, Y and Z, or points")
        ->required();
    command
        .add_option("--unit",
                    options->unit,
                    "Plotter unit: nominal (0.025 mm), table (0.02488 mm), mm, or mm of each axis as X,Y")
        ->capture_default_str();
    command
        .add_option("--arc-tolerance", options->reading.arc_tolerance, "Arc tolerance, mm, for finer arcs")
        ->check(above_zero());
    command.add_option("--fill", options->reading.fill, "Filled areas: hatched, outline or none")
        ->transform(one_of(by_id(project::fill_modes())))
        ->type_name(choice_list(by_id(project::fill_modes())))
        ->default_str(options->reading.fill == hpgl::FillMode::outline ? "outline" : "hatched");
    command.add_flag("--solid", options->solid, "Draw dashed lines solid");
    command
        .add_option(
            "--line-ends",
            options->reading.line_ends,
            "Line breaks in numbers: automatic (as the file shows), join (wrapped anywhere) or separate")
        ->transform(one_of(by_id(project::line_ends())))
        ->type_name(choice_list(by_id(project::line_ends())))
        ->default_str("automatic");
    command.add_flag("--strict", options->strict, "Stop reading at the first error");
    add_program_options(command, options->program);
    return command;
}

void on_call(CLI::App& command,
             const std::shared_ptr<PlotOptions>& options,
             Command& chosen,
             int (*act)(const PlotOptions&)) {
    command.callback([&command, &chosen, options, act] {
        options->command = &command;
        chosen = [options, act] { return act(*options); };
    });
}

/// Plots are cut at a height that `toolpath` sets; programs have their own.
void add_safe_height(CLI::App& command, const std::shared_ptr<PlotOptions>& options) {
    command
        .add_option("--safe-height",
                    options->cutting.cutting.safe_height,
                    "G-code programs: Z from which feed moves across count as travel, mm")
        ->check(finite_number());
}

void add_decode(CLI::App& group, const std::shared_ptr<PlotOptions>& options, Command& chosen) {
    CLI::App& command =
        add_reader(group, "decode", "Write its points for a table, at equal time intervals", options);
    add_safe_height(command, options);
    plot::DecodeSettings& decoding = options->decode;
    command.add_option("--velocity", decoding.velocity, "Velocity along the path, mm/s")
        ->check(above_zero())
        ->required();
    command.add_option("--period", decoding.period, "Time between two points, s")
        ->check(above_zero())
        ->required();
    command.add_option("--out", options->out, "Point file")->required();
    add_drawing_origin(command, options->cutting.cutting.origin);
    command.add_option("--mode", decoding.mode, "Equal steps per segment, or along whole paths")
        ->transform(one_of(modes))
        ->type_name(choice_list(modes))
        ->default_str("segments");
    command.add_option("--rounding", decoding.rounding, "Rounding of the number of steps per segment")
        ->transform(one_of(roundings))
        ->type_name(choice_list(roundings))
        ->default_str("nearest");
    command.add_option("--fastest", options->fastest, "Velocity that rounding must not exceed, mm/s")
        ->check(above_zero());
    command.add_option("--travel-velocity", decoding.travel_velocity, "Velocity with the pen up, mm/s")
        ->check(above_zero());
    command.add_option("--plunge-velocity", decoding.plunge_velocity, "Velocity up and down, mm/s")
        ->check(above_zero());
    command.add_option("--acceleration", decoding.acceleration, "Mode path: maximum acceleration, mm/s^2")
        ->check(above_zero());
    command.add_option("--jerk", decoding.jerk, "Mode path: maximum jerk, mm/s^3")->check(above_zero());
    command.add_option("--pen-up", decoding.pen_up_z, "Z with the pen up, mm")->capture_default_str();
    command.add_option("--pen-down", decoding.pen_down_z, "Z with the pen down, mm")->capture_default_str();
    command.add_option("--decimals", options->decimals, "Decimals in the point file")
        ->check(CLI::Range(0, 9))
        ->capture_default_str();
    on_call(command, options, chosen, decode);
}

void add_info(CLI::App& group, const std::shared_ptr<PlotOptions>& options, Command& chosen) {
    CLI::App& command = add_reader(group, "info", "Show its contents and how long it takes", options);
    add_safe_height(command, options);
    command.add_flag("--json", options->json, "Print the result as JSON");
    on_call(command, options, chosen, info);
}

void add_view(CLI::App& group, const std::shared_ptr<PlotOptions>& options, Command& chosen) {
    CLI::App& command =
        add_reader(group, "view", "Draw it as a picture, in the colours of its pens", options);
    add_safe_height(command, options);
    command.add_option("--out", options->out, "SVG file")->required();
    command.add_flag("--no-air", options->no_air, "Leave out the travel with the pen up");
    on_call(command, options, chosen, view);
}

void add_toolpath(CLI::App& group, const std::shared_ptr<PlotOptions>& options, Command& chosen) {
    CLI::App& command = add_reader(group, "toolpath", "Convert to a G-code program that cuts it", options);
    command.add_option("--out", options->cutting.cutting.out, "G-code file")->required();
    add_stroke_options(command, options->cutting);
    on_call(command, options, chosen, toolpath);
}

/// Whole outlines are carved: the edges of what is filled, and dashed ones solid.
void add_carve(CLI::App& group, Command& chosen) {
    const auto options = std::make_shared<PlotOptions>();
    options->reading.fill = hpgl::FillMode::outline;
    options->solid = true;
    CLI::App& command =
        add_reader(group, "carve", "V-carve the areas that its closed strokes enclose", options);
    add_carving_options(command, options->carving);
    on_call(command, options, chosen, carve);
}

} // namespace

void add_plot_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<PlotOptions>();
    CLI::App& group =
        *app.add_subcommand("plot", "Draw, cut or play an HPGL plot, or a G-code program as one");
    group.require_subcommand(1);
    add_carve(group, chosen);
    add_decode(group, options, chosen);
    add_info(group, options, chosen);
    add_toolpath(group, options, chosen);
    add_view(group, options, chosen);
    add_plot_play(group, chosen);
}

} // namespace millwright::app
