#include "ui/actions/plot_bench.h"

#include "core/base/files.h"
#include "core/kinematics/machine_file.h"
#include "core/project/assets.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::actions {

namespace fs = std::filesystem;

namespace {

std::vector<plot::Material> materials_in(const fs::path& assets) {
    const fs::path file = assets / "materials" / "materials.json";
    return plot::read_materials(read_file(file), file);
}

} // namespace

PlotBench::PlotBench(fs::path assets, const std::function<void()>& wake)
    : assets_(std::move(assets)), worker_(assets_, wake), table_(std::make_unique<TablePlayer>(wake)) {
    settings_.level.plunging = 2.0;
    settings_.level.cutting = 8.0;
}

void PlotBench::open(const fs::path& file) {
    if (!fs::is_regular_file(file)) {
        throw Error(fs::exists(file) ? "is no file" : "there is no such file", file);
    }
    if (materials_.empty()) {
        materials_ = materials_in(assets_);
    }
    file_ = fs::absolute(file).lexically_normal();
    settings_.levels.clear();
    worker_.request(file_, settings_);
}

void PlotBench::set(const project::PlotSettings& settings) {
    if (settings == settings_) {
        return;
    }
    settings_ = settings;
    if (!file_.empty()) {
        worker_.request(file_, settings_);
    }
}

std::vector<plot::Level> PlotBench::levels() const {
    if (!settings_.levels.empty()) {
        return settings_.levels;
    }
    const auto now = latest();
    return now && now->file == file_ ? now->levels : std::vector<plot::Level>();
}

void PlotBench::set_level(std::size_t n, const std::function<void(plot::Level&)>& change) {
    project::PlotSettings settings = settings_;
    settings.levels = levels();
    if (n < settings.levels.size()) {
        change(settings.levels[n]);
        set(settings);
    }
}

void PlotBench::add_level(std::size_t like) {
    project::PlotSettings settings = settings_;
    settings.levels = levels();
    if (like < settings.levels.size()) {
        const auto at = settings.levels.begin() + static_cast<std::ptrdiff_t>(like);
        settings.levels.insert(at + 1, *at);
        set(settings);
    }
}

void PlotBench::remove_level(std::size_t n) {
    project::PlotSettings settings = settings_;
    settings.levels = levels();
    if (n < settings.levels.size()) {
        const int pen = settings.levels[n].pen;
        const auto of_pen = std::ranges::count(settings.levels, pen, &plot::Level::pen);
        if (of_pen < 2) { // a pen without a level would get the usual one again
            settings.levels[n].enabled = false;
        } else {
            settings.levels.erase(settings.levels.begin() + static_cast<std::ptrdiff_t>(n));
        }
        set(settings);
    }
}

double PlotBench::tool_diameter() const {
    const auto now = latest();
    const bool picture = now && now->picture && settings_.use != project::PictureUse::outlines;
    if (!picture) {
        return settings_.strokes.tool_diameter;
    }
    return settings_.tip.kind == plot::TipKind::point ? 0.0 : settings_.tip.diameter;
}

void PlotBench::use_material(std::size_t n) {
    expects(n < materials_.size(), "the material is one of the table");
    constexpr double thin = 0.1; // mm: what a point without a width is taken for
    const plot::CuttingValues values = materials_[n].values(std::max(tool_diameter(), thin));
    project::PlotSettings settings = settings_;
    settings.levels = levels();
    const auto passes = [&](double depth) {
        return std::max(1, static_cast<int>(std::ceil(depth / values.depth_per_pass.value - 1e-9)));
    };
    settings.level.cutting = values.feed.value;
    settings.level.plunging = values.plunge.value;
    settings.level.passes = passes(settings.level.depth);
    for (plot::Level& level : settings.levels) {
        level.cutting = values.feed.value;
        level.plunging = values.plunge.value;
        level.passes = passes(level.depth);
    }
    if (settings.depth > values.depth_per_pass.value) {
        settings.depth_per_pass = values.depth_per_pass.value;
    }
    settings.spindle_rpm = values.spindle_rpm.value;
    material_ = n;
    set(settings);
}

void PlotBench::play_table() {
    const auto now = latest();
    if (!now || !now->strokes) {
        throw Error("there are no strokes to be played");
    }
    const auto model = std::make_shared<const kinematics::MachineModel>(
        kinematics::read_machine(project::machine_path(settings_.machine, file_.parent_path(), assets_)));
    table_->play(table_choice_, *now->strokes, model);
}

fs::path PlotBench::write_program() const {
    const auto now = latest();
    if (!now || !now->path) {
        throw Error("there is no path yet");
    }
    const fs::path folder = file_.parent_path();
    const std::string name = file_.stem().string();
    fs::path target = folder / (name + ".ngc");
    for (int n = 2; fs::exists(target); ++n) {
        target = folder / fmt::format("{}-{}.ngc", name, n);
    }
    write_file(target, project::plot_program_text(*now, assets_));
    return target;
}

} // namespace millwright::actions
