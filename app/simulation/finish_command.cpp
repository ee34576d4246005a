#include "app/simulation/finish_command.h"

#include "app/command_line/option_values.h"
#include "app/command_line/output_transaction.h"
#include "app/command_line/watched_work.h"
#include "app/plan/gouges.h"
#include "app/simulation/finish_report.h"
#include "app/simulation/finish_work.h"
#include "core/posts/post_file.h"
#include "core/project/assets.h"
#include "core/simulation/cut_mesh.h"

#include <CLI/App.hpp>
#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>

#include <array>
#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

namespace fs = std::filesystem;

/// Red where gouged, green within the tolerance, blue where more is left; gray where the tool does not fit.
std::string left_ply(const FinishWork& work, double tolerance) {
    auto colors = plan::deviation_colors(work.part, work.check.deviations, tolerance);
    constexpr std::array<std::uint8_t, 3> gray{150, 156, 166};
    for (std::size_t n = 0; n < colors.size(); ++n) {
        const auto point = static_cast<std::size_t>(work.part.point_of_corner[n]);
        if (!work.check.fitting[point] && work.check.deviations[point].height > tolerance) {
            colors[n] = gray;
        }
    }
    return simulation::ply_of(work.part.corners, work.part.triangles, colors);
}

/// What the program is called with each shipped post, and with that which is chosen.
std::set<std::string> program_names(const FinishOptions& options) {
    const fs::path assets = project::assets_folder();
    std::set<std::string> names{
        "program." +
        posts::read_post(project::post_path(options.post.post, fs::current_path(), assets)).extension};
    for (const std::string& id : project::post_ids(assets)) {
        names.insert("program." + posts::read_post(project::post_path(id, {}, assets)).extension);
    }
    return names;
}

int finish(const FinishOptions& options) {
    std::set<std::string> programs = program_names(options);
    std::vector<std::string> names(programs.begin(), programs.end());
    names.insert(names.end(), {"finish.json", "left.ply"});
    expect_inputs_kept(options.out, names, program_kind, {options.file});
    const OutputFolder folder(options.out);
    WatchedWork watched;
    const FinishWork work = finish_work(options, watched.progress());
    watched.finish();
    const std::string gouges = finish_gouge_text(work);
    const std::string rapids = finish_rapid_text(work);
    const std::string program = "program." + work.text.format.extension;
    OutputSet set{{{"finish.json", finish_report_text(options, work)},
                   {"left.ply", left_ply(work, options.left_tolerance)}},
                  {},
                  std::string(program_kind)};
    if (rapids.empty() && (gouges.empty() || options.allow_gouges)) {
        set.files.push_back({program, work.text.text.listing.text});
        programs.erase(program);
    }
    set.absent.assign(programs.begin(), programs.end()); // an older one would be taken for it
    write_outputs(options.out, set, options.file);
    print_notes(work.text);
    print_finish(work);
    if (!rapids.empty()) {
        throw GougeError(
            rapids + "; " + program + " was not written", options.file, "choose a larger --link-clearance");
    }
    if (!gouges.empty() && !options.allow_gouges) {
        throw GougeError(gouges + "; " + program + " was not written",
                         options.file,
                         "repair the mesh if its triangles face opposite sides, or use --allow-gouges");
    }
    if (!gouges.empty()) {
        fmt::print(stderr, "warning: {}\n", gouges);
    }
    return 0;
}

CLI::Option& add_triple(CLI::App& command,
                        const std::string& name,
                        std::vector<double>& numbers,
                        const std::string& what,
                        const std::string& type) {
    return *command.add_option(name, numbers, what)
                ->delimiter(',')
                ->expected(3)
                ->type_name(type)
                ->allow_extra_args(false);
}

void add_mesh_options(CLI::App& command, FinishOptions& options) {
    command.add_option("MESH", options.file, "STL, OBJ or PLY file")->required();
    command.add_option("--out", options.out, "Folder for program, finish.json and left.ply")
        ->required()
        ->type_name("DIR");
    command.add_option("--machine", options.machine, "Shipped machine or machine file")
        ->required()
        ->type_name("NAME|FILE");
    command.add_option("--tool", options.tool, "ball:D, bull:D:R, flat:D, v:ANGLE:D:TIP|rR, or a tool file")
        ->required()
        ->type_name("SPEC|FILE");
    const std::map<std::string, double> units{{"mm", 1.0}, {"cm", 10.0}, {"m", 1000.0}, {"inch", 25.4}};
    command.add_option("--unit", options.mm_per_unit, "Unit of the mesh (default: mm)")
        ->transform(one_of(units))
        ->type_name(choice_list(units))
        ->default_str("");
    add_triple(command, "--shift", options.shift, "Move the mesh by this much, mm", "X,Y,Z");
    add_triple(command, "--axis", options.axis, "Tool axis, away from the part (default: 0,0,1)", "I,J,K");
}

void add_pass_options(CLI::App& command, FinishOptions& options) {
    command.add_option("--direction", options.direction_deg, "Direction of the passes, from X in degrees")
        ->capture_default_str();
    CLI::Option& step = *command.add_option("--step-over", options.step_over, "Distance between passes, mm")
                             ->check(above_zero());
    command
        .add_option(
            "--scallop",
            options.scallop,
            "Most that the passes may leave where the tool fits, from which the step-over follows, mm")
        ->check(above_zero())
        ->capture_default_str()
        ->excludes(&step);
    command.add_option("--tolerance", options.tolerance, "Depth to which a move may cut into the mesh, mm")
        ->check(above_zero())
        ->capture_default_str();
    command.add_option("--overrun", options.overrun, "Distance the passes go beyond the mesh, mm")
        ->check(not_below_zero())
        ->capture_default_str();
    command.add_flag("--one-way", options.one_way, "No passes across the others on steep places");
    command
        .add_option(
            "--allowance",
            options.allowance,
            "Thickness of the material around the mesh, mm: links travel fast at the clearance above it "
            "(default: not known; below the top of the mesh at the feed rate)")
        ->check(not_below_zero());
    command
        .add_option("--link-clearance",
                    options.link_clearance,
                    "Height of links above the mesh and its allowance, mm")
        ->check(above_zero())
        ->capture_default_str();
}

void add_program_options(CLI::App& command, FinishOptions& options) {
    add_feed_options(command, options.feed_mm_per_min, options.plunge_mm_per_min);
    add_spindle_option(command, options.spindle_rpm);
    add_post_options(command, options.post).capture_default_str();
    command
        .add_option("--left",
                    options.left_tolerance,
                    "Tolerance of the check for what is left where the tool fits, mm")
        ->check(above_zero())
        ->capture_default_str();
    command.add_option("--memory", options.memory_mb, "Memory limit of the check's simulation, MB")
        ->check(above_zero())
        ->capture_default_str();
    command.add_flag("--allow-gouges",
                     options.allow_gouges,
                     "Accept a program that cuts deeper into the mesh than the tolerance");
}

} // namespace

void add_finish_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<FinishOptions>();
    CLI::App& command = *app.add_subcommand(
        "finish", "Finish a mesh as it is with a fixed tool axis, and check what the program leaves");
    add_mesh_options(command, *options);
    add_pass_options(command, *options);
    add_program_options(command, *options);
    command.callback([&chosen, options] { chosen = [options] { return finish(*options); }; });
}

} // namespace millwright::app
