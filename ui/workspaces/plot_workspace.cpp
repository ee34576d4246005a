#include "ui/workspaces/plot_workspace.h"

#include "core/base/files.h"
#include "core/jobs/point_job.h"
#include "core/kinematics/machine_file.h"
#include "core/plot/path_file.h"
#include "core/plot/point_file.h"
#include "core/project/assets.h"

#include <fmt/format.h>

#include <cmath>
#include <string_view>
#include <system_error>
#include <utility>

namespace millwright::actions {

namespace fs = std::filesystem;

namespace {

std::vector<plot::Material> materials_in(const fs::path& assets) {
    const fs::path file = assets / "materials" / "materials.json";
    return plot::read_materials(read_file(file), file);
}

} // namespace

PlotWorkspace::PlotWorkspace(fs::path assets, fs::path log_folder, const std::function<void()>& wake)
    : assets_(std::move(assets)), worker_(assets_, wake),
      table_(std::make_unique<TablePlayer>(std::move(log_folder), wake)) {}

void PlotWorkspace::follow(const project::PlotInput& input) {
    const bool another = input.file != input_.file;
    input_ = input;
    if (another) {
        material_.reset();
    }
    derive(false);
}

void PlotWorkspace::read_again() {
    derive(true);
}

void PlotWorkspace::derive(bool anew) {
    if (input_.file.empty()) {
        worker_.cancel();
        return;
    }
    if (materials_.empty()) {
        materials_ = materials_in(assets_);
    }
    request_ = anew ? worker_.request_anew(input_) : worker_.request(input_);
}

std::shared_ptr<const plan::PlotResult> PlotWorkspace::latest() const {
    auto made = input_.file.empty() ? nullptr : worker_.latest();
    return made && made->input.file == input_.file ? made : nullptr;
}

std::shared_ptr<const plan::OpenedProgram> PlotWorkspace::opened() const {
    const auto made = latest();
    return made ? made->opened : nullptr;
}

std::vector<plot::Level> PlotWorkspace::levels() const {
    if (!settings().levels.empty()) {
        return settings().levels;
    }
    const auto now = latest();
    return now ? now->levels : std::vector<plot::Level>();
}

double PlotWorkspace::tool_diameter() const {
    if (!project::is_cut_by_tip(input_)) {
        return settings().strokes.tool_diameter;
    }
    return settings().tip.kind == plot::TipKind::point ? 0.0 : settings().tip.diameter;
}

std::shared_ptr<const kinematics::MachineModel> PlotWorkspace::model() const {
    return std::make_shared<const kinematics::MachineModel>(
        kinematics::read_machine(project::machine_path(settings().machine, file().parent_path(), assets_)));
}

void PlotWorkspace::play_table(double timeline_s) {
    const auto now = latest();
    if (!now || !now->path) {
        throw Error("there is no path to play");
    }
    table_->play(table_choice_, {now->path, file(), model(), now->spindle_rpm(), now->points});
    played_ = file();
    timeline_at_play_ = timeline_s;
}

std::optional<Vec3> PlotWorkspace::table_start() const {
    const auto now = latest();
    if (!now || !now->path) {
        return std::nullopt;
    }
    const TableWork work{now->path, file(), nullptr, 0.0, now->points};
    return table_->place(table_choice_.port).value_or(work.usual_start());
}

std::optional<Vec3> PlotWorkspace::table_tip(double timeline_s) const {
    const TableView now = table_->view();
    const bool of_it = now.there && now.total > 0 && played_ == file();
    constexpr double same_moment = 1e-9; // s
    const bool shown = now.playing || std::abs(timeline_s - timeline_at_play_) < same_moment;
    return of_it && shown ? std::optional(now.status.position) : std::nullopt;
}

namespace {

/// The name with the ending in the folder, with a number behind it where that is taken.
fs::path free_place(const fs::path& folder, const std::string& name, std::string_view ending) {
    fs::path target = folder / fmt::format("{}.{}", name, ending);
    for (int n = 2; fs::exists(target); ++n) {
        target = folder / fmt::format("{}-{}.{}", name, n, ending);
    }
    return target;
}

} // namespace

fs::path PlotWorkspace::write_path(const fs::path& folder) const {
    const auto now = latest();
    expects(now != nullptr && now->path != nullptr, "there is a path to be written");
    const fs::path target = free_place(folder, file().stem().string(), "path");
    write_file(target, plot::path_file_text(*now->path));
    return target;
}

fs::path PlotWorkspace::write_points(const fs::path& folder) const {
    const auto now = latest();
    expects(now != nullptr && now->path != nullptr, "there is a path to be decoded");
    const jobs::Job job =
        jobs::path_points_job(*now->path, file(), model(), {.decoding = table_choice_.decoding});
    const fs::path target = free_place(folder, file().stem().string(), "csv");
    constexpr int decimals = 4;
    write_file(target, plot::point_file_text(job.points->points, decimals));
    return target;
}

fs::path PlotWorkspace::write_program(const fs::path& folder) const {
    const auto now = latest();
    expects(now != nullptr && now->program != nullptr, "there is a program to be written");
    const fs::path target = free_place(folder, file().stem().string(), "ngc");
    write_file(target, now->program->listing->text);
    return target;
}

} // namespace millwright::actions
