// A plot or a picture that is to be cut: the file, and what a person has set for it. In the units of the
// core: lengths mm, angles rad, speeds mm/s; plot_settings.h turns them into people's.
#pragma once

#include "core/plot/cut_path.h"
#include "core/plot/material_table.h"
#include "core/plot/picture/picture.h"
#include "core/plot/picture/tool_tip.h"
#include "core/plot/stroke_plan.h"

#include <cstddef>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace millwright::project {

/// What becomes of a picture.
enum class PictureUse { relief, outlines, halftone, dots };

struct PlotSettings {
    double plotter_unit = 0.025; ///< of HPGL
    PictureUse use = PictureUse::relief;
    double picture_width = 0.0; ///< 0: as the file says, else 0.26 mm a pixel
    plot::GrayRule gray = plot::GrayRule::mean;
    bool invert = false;
    double depth = 1.0;                   ///< of white, or of engraved dots
    double dot_pitch = 1.0;               ///< of halftone and dots
    double threshold = 0.5;               ///< of outlines
    plot::ToolTip tip = {};               ///< of reliefs, halftone and dots; strokes are cut by an end mill
    std::optional<double> step_over = {}; ///< between rows of a relief; not given: a tenth of the tool
    std::optional<double> depth_per_pass = {}; ///< roughing of a relief; not given: none
    std::optional<double> frame = {};          ///< the relief is cut out of a plate so thick
    plot::StrokePlan strokes = {};
    /// What pens have that are not in `levels`; feed and plunge of pictures, too.
    plot::Level level = {.cutting = 8.0, .plunging = 2.0};
    std::vector<plot::Level> levels = {}; ///< a pen each or several times
    double safe_height = 5.0;
    double plate = 0.0; ///< thickness that the path must not go through; 0: not known
    double spindle_rpm = 10'000.0;
    Vec2 origin = Vec2::Zero(); ///< where that of the drawing lies on the machine
    std::string machine = "forming-table";
    std::string post = "linuxcnc-xyz";

    friend bool operator==(const PlotSettings&, const PlotSettings&) = default;
};

struct PlotInput {
    std::filesystem::path file; ///< empty: none
    PlotSettings settings = {};

    friend bool operator==(const PlotInput&, const PlotInput&) = default;
};

/// By the name: .png, .jpg, .jpeg, .bmp.
[[nodiscard]] bool is_picture_file(const std::filesystem::path& file);
/// A file of a path that was made before: .path.
[[nodiscard]] bool is_path_file(const std::filesystem::path& file);
/// Either, or a plot: .plt, .hpgl, .hpg.
[[nodiscard]] bool is_plot_file(const std::filesystem::path& file);

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
