#include "app/simulation/finish_report.h"

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/project/json_text.h"
#include "core/project/version.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cstdio>
#include <string_view>

namespace millwright::app {

namespace {

using ReportJson = nlohmann::ordered_json;
constexpr double per_cent = 100.0; // of a share

/// Written positions and the simulated motion add no more, mm.
constexpr double beside_tolerance = 0.002;

std::string mesh_place_text(const Vec3& place) {
    return fmt::format("{} {} {}", fixed(place.x(), 3), fixed(place.y(), 3), fixed(place.z(), 3));
}

struct PathFigures {
    std::size_t along = 0, across = 0; ///< passes
    std::size_t points = 0;
    double length = 0.0; ///< of cutting moves
};

PathFigures figures_of(const mesh_finish::FinishPath& path) {
    PathFigures figures;
    for (const mesh_finish::FinishPass& pass : path.passes) {
        ++(pass.is_across ? figures.across : figures.along);
        figures.points += pass.tips.size();
        for (std::size_t n = 1; n < pass.tips.size(); ++n) {
            figures.length += (pass.tips[n] - pass.tips[n - 1]).norm();
        }
    }
    return figures;
}

ReportJson extreme_json(const std::optional<plan::FinishExtreme>& extreme, const char* name) {
    ReportJson json;
    json[name] = project::rounded(extreme ? extreme->distance : 0.0);
    json["position_mm"] = extreme ? project::vector(extreme->place) : ReportJson();
    return json;
}

ReportJson mesh_json(const FinishWork& work) {
    Box3 box;
    for (const Vec3& point : work.mesh.mesh.points) {
        box.extend(point);
    }
    ReportJson json;
    json["triangles"] = work.mesh.mesh.triangles.size();
    json["points"] = work.mesh.mesh.points.size();
    json["without_area"] = work.mesh.without_area;
    json["low_mm"] = project::vector(box.min());
    json["high_mm"] = project::vector(box.max());
    json["memory_bytes"] = work.memory;
    json["remarks"] = work.remarks;
    return json;
}

ReportJson path_json(const FinishWork& work) {
    const PathFigures figures = figures_of(work.path);
    ReportJson json;
    json["axis"] = project::vector(work.settings.axis);
    json["direction_deg"] = project::rounded(to_degrees(work.settings.direction));
    json["step_over_mm"] = project::rounded(work.settings.step_over);
    json["chord_tolerance_mm"] = project::rounded(work.settings.tolerance);
    json["passes_along"] = figures.along;
    json["passes_across"] = figures.across;
    json["points"] = figures.points;
    json["points_before_thinning"] = work.path.drops;
    json["cut_length_mm"] = project::rounded(figures.length);
    json["allowance_mm"] =
        work.settings.allowance ? ReportJson(project::rounded(*work.settings.allowance)) : ReportJson();
    json["holder_needs_tool_length_mm"] =
        work.holder_reach ? ReportJson(project::rounded(work.holder_reach->length)) : ReportJson();
    return json;
}

ReportJson check_json(const FinishOptions& options, const FinishWork& work) {
    const plan::FinishCheck& check = work.check;
    ReportJson json;
    json["points"] = work.part.points.size();
    json["area_mm2"] = project::rounded(check.area);
    json["fits_percent"] = project::rounded(per_cent * check.fits);
    json["tolerance_mm"] = project::rounded(options.left_tolerance);
    json["within_percent"] = project::rounded(per_cent * check.within);
    json["largest_left"] = extreme_json(check.left, "distance_mm");
    json["deepest_gouge"] = extreme_json(check.gouge, "depth_mm");
    json["rapid_moves_in_material"] =
        work.settings.allowance ? ReportJson(check.rapids.size()) : ReportJson();
    json["resolution_mm"] = project::rounded(check.resolution);
    return json;
}

} // namespace

std::string finish_report_text(const FinishOptions& options, const FinishWork& work) {
    ReportJson json;
    json["millwright"] = project::version();
    json["file"] = printable(options.file);
    json["machine"] = work.machine.name();
    json["tool"] = work.tool.text;
    json["mesh"] = mesh_json(work);
    json["path"] = path_json(work);
    json["time_s"] = project::rounded(work.seconds);
    json["check"] = check_json(options, work);
    return json.dump(2) + "\n";
}

void print_finish(const FinishWork& work) {
    const PathFigures figures = figures_of(work.path);
    const plan::FinishCheck& check = work.check;
    if (work.mesh.without_area > 0) {
        fmt::print(
            stderr, "warning: {} without an area left out\n", counted(work.mesh.without_area, "triangle"));
    }
    for (const std::string& note : work.mesh.notes) {
        fmt::print(stderr, "warning: {}\n", note);
    }
    for (const std::string& remark : work.remarks) {
        fmt::print(stderr, "warning: {}\n", remark);
    }
    fmt::print("{}; {} MB of memory\n", work.part.text, fixed(static_cast<double>(work.memory) / 1e6, 1));
    fmt::print("tool: {}\n", work.tool.text);
    fmt::print("{} and {} across, {} mm apart: {}, {} m of cutting\n",
               counted(figures.along, "pass", "passes"),
               figures.across,
               fixed(work.settings.step_over, 3),
               counted(figures.points, "point"),
               fixed(1e-3 * figures.length, 2));
    if (work.holder_reach) {
        fmt::print("the holder needs a tool length of {} mm\n", fixed(work.holder_reach->length, 3));
    }
    fmt::print("{}, {} on {}\n",
               counted(std::ranges::count(work.text.text.listing.text, '\n'), "line"),
               clock_time(work.seconds),
               work.machine.name());
    fmt::print("the tool fits on {} % of the area; {} % of that within the tolerance\n",
               fixed(per_cent * check.fits, 1),
               fixed(per_cent * check.within, 2));
    fmt::print("largest distance left where it fits: {}\n",
               check.left ? fixed(check.left->distance, 4) + " mm at " + mesh_place_text(check.left->place)
                          : std::string("none"));
    fmt::print("deepest cut below the mesh: {}\n",
               check.gouge ? fixed(check.gouge->distance, 4) + " mm at " + mesh_place_text(check.gouge->place)
                           : std::string("none"));
}

std::string finish_rapid_text(const FinishWork& work) {
    const auto& rapids = work.check.rapids;
    if (rapids.empty()) {
        return {};
    }
    return fmt::format("{} through the material of --allowance, the first at {}",
                       counted(rapids.size(), "rapid move goes", "rapid moves go"),
                       mesh_place_text(rapids.front().contact.place));
}

std::string finish_gouge_text(const FinishWork& work) {
    const auto& gouge = work.check.gouge;
    if (!gouge || gouge->distance <= work.settings.tolerance + beside_tolerance) {
        return {};
    }
    return fmt::format("the program cuts up to {} mm below the mesh at {}",
                       fixed(gouge->distance, 4),
                       mesh_place_text(gouge->place));
}

} // namespace millwright::app
