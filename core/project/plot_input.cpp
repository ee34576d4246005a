#include "core/project/plot_input.h"

#include "core/base/units.h"
#include "core/plot/point_file.h"
#include "core/project/gcode_file.h"
#include "core/project/level_settings.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
#include <span>
#include <string_view>
#include <system_error>

namespace millwright::project {

namespace fs = std::filesystem;

namespace {

std::string ending_of(const fs::path& file) {
    std::string ending = file.extension().string();
    std::ranges::transform(
        ending, ending.begin(), [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return ending;
}

constexpr std::array<std::string_view, 3> drawing_endings{".plt", ".hpgl", ".hpg"};
constexpr std::array<std::string_view, 6> picture_endings{".png", ".jpg", ".jpeg", ".bmp", ".pgm", ".ppm"};
constexpr std::array<std::string_view, 1> path_endings{".path"};
constexpr std::array<std::string_view, 2> point_endings{".csv", ".pts"};
constexpr std::string_view perhaps_points = ".txt"; // looked into: most are G-code
constexpr std::array<std::string_view, 8> gcode_endings{
    ".ngc", ".nc", ".gcode", ".gc", ".tap", ".cnc", ".g", perhaps_points};

constexpr std::array<PlotFileKind, 5> file_kinds{{{"HPGL", drawing_endings},
                                                  {"a picture", picture_endings},
                                                  {"a path", path_endings},
                                                  {"points of a table", point_endings},
                                                  {"G-code", gcode_endings}}};

bool ends_with_one_of(const fs::path& file, std::span<const std::string_view> endings) {
    return std::ranges::find(endings, ending_of(file)) != endings.end();
}

} // namespace

std::span<const PlotFileKind> plot_file_kinds() {
    return file_kinds;
}

std::string plot_file_kinds_text() {
    std::string text;
    for (const PlotFileKind& kind : file_kinds) {
        const bool last = &kind == &file_kinds.back();
        text += fmt::format("{}{} ({})",
                            text.empty() ? ""
                            : last       ? " or "
                                         : ", ",
                            kind.name,
                            fmt::join(kind.endings, ", "));
    }
    return text;
}

bool is_picture_file(const fs::path& file) {
    return ends_with_one_of(file, picture_endings);
}

bool is_path_file(const fs::path& file) {
    return ends_with_one_of(file, path_endings);
}

bool is_point_file(const fs::path& file) {
    return ends_with_one_of(file, point_endings);
}

bool holds_points(const fs::path& file) {
    if (is_point_file(file)) {
        return true;
    }
    std::error_code none;
    if (ending_of(file) != perhaps_points || !fs::is_regular_file(file, none)) {
        return false;
    }
    std::string head(256, ' ');
    std::ifstream(file, std::ios::binary).read(head.data(), static_cast<std::streamsize>(head.size()));
    return plot::is_point_file(head);
}

bool is_gcode_file(const fs::path& file) {
    return ends_with_one_of(file, gcode_endings);
}

bool is_plot_file(const fs::path& file) {
    return is_picture_file(file) || is_path_file(file) || is_point_file(file) ||
           ends_with_one_of(file, drawing_endings);
}

bool is_drawing_file(const fs::path& file) {
    return is_plot_file(file) && !is_picture_file(file) && !is_path_file(file) && !is_point_file(file);
}

bool is_carved(const PlotInput& input) {
    return is_picture_file(input.file)
               ? input.settings.use == PictureUse::carving
               : is_drawing_file(input.file) && input.settings.drawing_use == DrawingUse::carving;
}

bool is_cut_by_tip(const PlotInput& input) {
    return is_carved(input) || (is_picture_file(input.file) && input.settings.use != PictureUse::outlines);
}

void take_v_bit(PlotSettings& settings) {
    if (settings.tip == PlotSettings().tip) {
        settings.tip = plot::CarvingSettings().tip;
    }
}

void repeat_level(std::vector<plot::Level>& levels, std::size_t n) {
    const plot::Level again = levels.at(n);
    levels.insert(levels.begin() + static_cast<std::ptrdiff_t>(n) + 1, again);
}

void remove_level(std::vector<plot::Level>& levels, std::size_t n) {
    plot::Level& level = levels.at(n);
    if (std::ranges::count(levels, level.pen, &plot::Level::pen) < 2) {
        level.enabled = false;
    } else {
        levels.erase(levels.begin() + static_cast<std::ptrdiff_t>(n));
    }
}

void use_material(PlotSettings& settings,
                  const std::vector<plot::Level>& levels,
                  const plot::CuttingValues& values) {
    const double deepest = values.depth_per_pass.value;
    const auto take = [&](plot::Level& level) {
        level_number("feed_mm_per_min").set(level, to_mm_per_min(values.feed.value));
        level_number("plunge_mm_per_min").set(level, to_mm_per_min(values.plunge.value));
        level.passes = std::max(1, static_cast<int>(std::ceil(level.depth / deepest - 1e-9)));
    };
    take(settings.level);
    settings.levels = levels;
    std::ranges::for_each(settings.levels, take);
    const bool carved = settings.use == PictureUse::carving || settings.drawing_use == DrawingUse::carving;
    if (settings.depth > deepest || carved) {
        settings.depth_per_pass = deepest;
    }
    settings.spindle_rpm = values.spindle_rpm.value;
}

} // namespace millwright::project
