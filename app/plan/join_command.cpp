#include "app/plan/join_command.h"

#include "app/command_line/option_values.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/project/joined_surface.h"
#include "core/project/project_file.h"

#include <CLI/Config.hpp>
#include <CLI/Formatter.hpp>
#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::app {

namespace {

using geometry::Continuity;
using nlohmann::ordered_json;

struct JoinOptions {
    std::vector<std::string> projects;
    std::string out;
    Continuity continuity = Continuity::tangent;
    std::optional<double> gap_mm;
    bool json = false;
};

/// The first project with the patches of all.
project::Project together(const std::vector<std::string>& files) {
    project::Project all = open_project(files.front()).project;
    for (std::size_t n = 1; n < files.size(); ++n) {
        const project::SurfaceInput next = open_project(files[n]).project.surface;
        project::add_patches(all.surface, next);
    }
    return all;
}

ordered_json joined_surface_json(const project::JoinedSurface& joined) {
    ordered_json seams = ordered_json::array();
    for (std::size_t n = 0; n < joined.seams.size(); ++n) {
        const geometry::Seam& seam = joined.seams[n];
        seams.push_back({{"patches", {seam.a.patch, seam.b.patch}},
                         {"sides", {geometry::to_text(seam.a.side), geometry::to_text(seam.b.side)}},
                         {"gap_before_mm", joined.before[n].gap},
                         {"gap_mm", joined.after[n].gap},
                         {"angle_before_deg", to_degrees(joined.before[n].angle)},
                         {"angle_deg", to_degrees(joined.after[n].angle)}});
    }
    ordered_json open = ordered_json::array();
    for (const auto& [seam, gap] : joined.open) {
        open.push_back({{"patches", {seam.a.patch, seam.b.patch}},
                        {"sides", {geometry::to_text(seam.a.side), geometry::to_text(seam.b.side)}},
                        {"gap_mm", gap}});
    }
    return {{"patches", joined.surface.patches.size()},
            {"largest_move_mm", joined.largest_move},
            {"rms_move_mm", joined.rms_move},
            {"seams", std::move(seams)},
            {"open_seams", std::move(open)}};
}

void print_joined_surface(const project::JoinedSurface& joined, double gap_mm) {
    fmt::print("{:>18} {:>21} {:>23}\n", "seam", "gap mm", "angle deg");
    for (std::size_t n = 0; n < joined.seams.size(); ++n) {
        const geometry::Seam& seam = joined.seams[n];
        fmt::print("{:>3} {} - {:>3} {} {:>10} -> {:>8} {:>11} -> {:>8}\n",
                   seam.a.patch,
                   geometry::to_text(seam.a.side),
                   seam.b.patch,
                   geometry::to_text(seam.b.side),
                   fixed(joined.before[n].gap, 4),
                   fixed(joined.after[n].gap, 4),
                   fixed(to_degrees(joined.before[n].angle), 3),
                   fixed(to_degrees(joined.after[n].angle), 3));
    }
    for (const auto& [seam, gap] : joined.open) {
        fmt::print("left open: {}, gap {} mm (--gap is {})\n",
                   project::seam_text(seam),
                   fixed(gap, 4),
                   fixed(gap_mm, 4));
    }
    fmt::print("control points moved by at most {} mm, {} mm rms\n",
               fixed(joined.largest_move, 4),
               fixed(joined.rms_move, 4));
}

int join(const JoinOptions& options) {
    project::Project project = together(options.projects);
    const double gap_mm = options.gap_mm.value_or(project::usual_gap_mm(project.surface));
    const project::JoinedSurface joined =
        project::joined_surface(project.surface, options.continuity, gap_mm);
    project.surface = joined.surface;
    project::write_project(project, options.out);
    if (options.json) {
        fmt::print("{}\n", joined_surface_json(joined).dump(2));
    } else {
        print_joined_surface(joined, gap_mm);
    }
    return 0;
}

} // namespace

void add_join_command(CLI::App& app, Command& chosen) {
    const auto options = std::make_shared<JoinOptions>();
    CLI::App& command = *app.add_subcommand("join", "Join patches with common sides into one surface");
    command
        .add_option(
            "PROJECT", options->projects, "Project files; machine, tool and grid come from the first one")
        ->required()
        ->expected(1, 100);
    command.add_option("--out", options->out, "Project file to write")->required()->type_name("PROJECT");
    const std::map<std::string, Continuity> kinds{{"C0", Continuity::position}, {"C1", Continuity::tangent}};
    command.add_option("--continuity", options->continuity, "C0: no gap; C1 (default): no gap and no edge")
        ->transform(one_of(kinds))
        ->type_name(choice_list(kinds));
    command
        .add_option("--gap",
                    options->gap_mm,
                    "Largest distance between the ends of two sides that belong together, mm (default: a "
                    "twentieth of the smallest patch)")
        ->check(CLI::Range(0.0, 1e5));
    command.add_flag("--json", options->json, "Print the result as JSON");
    command.callback([&chosen, options] { chosen = [options] { return join(*options); }; });
}

} // namespace millwright::app
