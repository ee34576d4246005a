#include "core/project/plot_input.h"

#include "core/base/units.h"
#include "core/plot/point_file.h"
#include "core/project/gcode_file.h"
#include "core/project/level_settings.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <cmath>
#include <fstream>
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

} // namespace

bool is_picture_file(const fs::path& file) {
    constexpr std::array<std::string_view, 6> endings{".png", ".jpg", ".jpeg", ".bmp", ".pgm", ".ppm"};
    return std::ranges::find(endings, ending_of(file)) != endings.end();
}

bool is_path_file(const fs::path& file) {
    return ending_of(file) == ".path";
}

bool is_point_file(const fs::path& file) {
    const std::string ending = ending_of(file);
    return ending == ".csv" || ending == ".pts";
}

bool holds_points(const fs::path& file) {
    if (is_point_file(file)) {
        return true;
    }
    std::error_code none;
    if (ending_of(file) != ".txt" || !fs::is_regular_file(file, none)) {
        return false;
    }
    std::string head(256, ' ');
    std::ifstream(file, std::ios::binary).read(head.data(), static_cast<std::streamsize>(head.size()));
    return plot::is_point_file(head);
}

bool is_gcode_file(const fs::path& file) {
    constexpr std::array<std::string_view, 8> endings{
        ".ngc", ".nc", ".gcode", ".gc", ".tap", ".cnc", ".g", ".txt"};
    return std::ranges::find(endings, ending_of(file)) != endings.end();
}

bool is_plot_file(const fs::path& file) {
    constexpr std::array<std::string_view, 3> endings{".plt", ".hpgl", ".hpg"};
    return is_picture_file(file) || is_path_file(file) || is_point_file(file) ||
           std::ranges::find(endings, ending_of(file)) != endings.end();
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
