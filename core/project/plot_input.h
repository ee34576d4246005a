// A plot or a picture that is to be cut: the file, and what a person has set for it. In the units of the
// core: lengths mm, angles rad, speeds mm/s; plot_settings.h turns them into people's.
#pragma once

#include "core/hpgl/hpgl_settings.h"
#include "core/plot/carving/v_carving.h"
#include "core/plot/cut_path.h"
#include "core/plot/material_table.h"
#include "core/plot/picture/engraving.h"
#include "core/plot/picture/picture.h"
#include "core/plot/picture/relief_plan.h"
#include "core/plot/picture/tool_tip.h"
#include "core/plot/picture/trace.h"
#include "core/plot/stroke_plan.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::project {

/// What becomes of a picture.
enum class PictureUse { relief, outlines, carving, halftone, dots };

/// What becomes of a drawing of strokes.
enum class DrawingUse { strokes, carving };

inline constexpr double usual_spindle_rpm = 10'000.0;

struct PlotSettings {
    hpgl::HpglSettings hpgl = {};
    PictureUse use = PictureUse::relief;
    DrawingUse drawing_use = DrawingUse::strokes;
    plot::PictureSettings picture = {};
    plot::PictureSize size = {};
    double depth = 1.0;                                ///< of white, or of engraved dots
    double dot_pitch = 1.0;                            ///< of halftone and dots
    double dot_angle = plot::HalftoneSettings{}.angle; ///< of a halftone's rows to x
    bool join_dots = false;                            ///< dots that are neighbours become one cut
    plot::TraceSettings tracing = {};                  ///< of outlines
    double chords = 0.005;                             ///< how near to traced curves
    std::optional<double> chord_length = {};           ///< of arcs of G-code; not given: by their tolerance
    plot::ToolTip tip = {};                            ///< of all but strokes, which are cut by an end mill
    /// Between rows of a relief, not given: a tenth of the tool; of passes on the floor of a V-carving.
    std::optional<double> step_over = {};
    double merge = 0.005; ///< moves of a relief are joined that stay so near above it
    /// Of the roughing of a relief, not given: none; of a V-carving, not given: one pass.
    std::optional<double> depth_per_pass = {};
    double allowance = plot::Roughing{}.allowance; ///< that roughing leaves
    std::optional<double> rough_step_over = {};    ///< between its rows; not given: half of the tool
    std::optional<double> frame = {};              ///< the relief is cut out of a plate so thick
    double frame_margin = plot::ReliefPlan{}.frame_margin;
    plot::Tabs frame_tabs = plot::ReliefPlan{}.tabs;
    std::optional<double> largest_depth = {}; ///< of a V-carving; not given: as deep as the bit reaches
    bool clear_floor = plot::CarvingSettings{}.clear_floor;
    double carving_tolerance = plot::CarvingSettings{}.tolerance;
    double close_gaps = plot::CarvingSettings{}.close_gaps; ///< between ends of outlines that are carved
    plot::StrokePlan strokes = {};
    /// What pens have that are not in `levels`; feed and plunge of pictures, too.
    plot::Level level = {.cutting = 8.0, .plunging = 2.0};
    std::vector<plot::Level> levels = {}; ///< a pen each or several times
    double safe_height = 5.0;
    double plate = 0.0;      ///< its thickness; 0: not known
    bool through = false;    ///< the path may go deeper than the plate
    double half_light = 0.3; ///< of the plate lets half of the light through; a guess for black plastic
    /// Not given: as a G-code program says, else the usual speed.
    std::optional<double> spindle_rpm = {};
    Vec2 origin = Vec2::Zero(); ///< where that of the drawing lies on the machine
    Vec3 change_position = plot::CutSettings{}.change_position; ///< of tools, on the machine
    std::string machine = "forming-table";
    std::string post = "linuxcnc-xyz";

    friend bool operator==(const PlotSettings&, const PlotSettings&) = default;
};

struct PlotInput {
    std::filesystem::path file; ///< empty: none
    PlotSettings settings = {};

    friend bool operator==(const PlotInput&, const PlotInput&) = default;
};

/// Files of one kind that the Plot workspace opens.
struct PlotFileKind {
    std::string_view name;
    std::span<const std::string_view> endings; ///< with their dot, in small letters
};
[[nodiscard]] std::span<const PlotFileKind> plot_file_kinds();
/// All of them: "HPGL (.plt, .hpgl, .hpg), ... or G-code (.ngc, ...)".
[[nodiscard]] std::string plot_file_kinds_text();

/// By the name: .png, .jpg, .jpeg, .bmp, .pgm, .ppm.
[[nodiscard]] bool is_picture_file(const std::filesystem::path& file);
/// A file of a path that was made before: .path.
[[nodiscard]] bool is_path_file(const std::filesystem::path& file);
/// Points of a table: .csv, .pts.
[[nodiscard]] bool is_point_file(const std::filesystem::path& file);
/// The same, or a .txt file that begins with a point: looks into it.
[[nodiscard]] bool holds_points(const std::filesystem::path& file);
/// A picture, a path, points, or a plot: .plt, .hpgl, .hpg.
[[nodiscard]] bool is_plot_file(const std::filesystem::path& file);

/// A plot, whose strokes are not cut as they stand.
[[nodiscard]] bool is_drawing_file(const std::filesystem::path& file);
/// Whether the closed outlines of a drawing or a picture are V-carved.
[[nodiscard]] bool is_carved(const PlotInput& input);
/// Whether PlotSettings::tip cuts it; else an end mill, along strokes or a path that it has.
[[nodiscard]] bool is_cut_by_tip(const PlotInput& input);

/// The usual V-bit, where no other tool than the usual one was set.
void take_v_bit(PlotSettings& settings);

/// Cuts the pen of level `n` once more, after it.
void repeat_level(std::vector<plot::Level>& levels, std::size_t n);

/// A pen's only level is switched off instead, since a pen without one would get the usual one again.
void remove_level(std::vector<plot::Level>& levels, std::size_t n);

/// Feed, plunge, passes of the material's depth, and spindle, for every pen; roughing where the picture is
/// deeper than a pass. `levels` are those in force.
void use_material(PlotSettings& settings,
                  const std::vector<plot::Level>& levels,
                  const plot::CuttingValues& values);

} // namespace millwright::project
