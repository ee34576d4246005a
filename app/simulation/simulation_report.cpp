#include "app/simulation/simulation_report.h"

#include "app/simulation/simulated_collisions.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/project/json_text.h"
#include "core/project/version.h"
#include "core/simulation/engagement.h"
#include "core/simulation/warnings.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string_view>

namespace millwright::app {

namespace {

using ReportJson = nlohmann::ordered_json;
using simulation::Finding;
using simulation::FindingKind;
constexpr double bytes_per_megabyte = 1e6;

ReportJson findings_json(const simulation::Simulation& found) {
    ReportJson list = ReportJson::array();
    for (const Finding& finding : found.findings) {
        const bool rapid = finding.kind == FindingKind::rapid_in_stock;
        if (!rapid && finding.kind != FindingKind::spindle_off) {
            continue; // collisions have their own list
        }
        ReportJson entry;
        entry["kind"] = rapid ? "rapid-in-stock" : "spindle-off";
        entry["line"] = finding.line > 0 ? ReportJson(finding.line) : ReportJson();
        entry["block"] = finding.block;
        entry["removed_mm3"] = project::rounded(finding.volume);
        if (rapid) {
            entry["longest_mm"] = project::rounded(finding.contact.length);
            entry["position_mm"] = project::vector(finding.contact.place);
        }
        list.push_back(std::move(entry));
    }
    return list;
}

ReportJson worst_json(const SimulatedWork& work, const std::optional<simulation::WorstDeviation>& worst) {
    if (!worst) {
        return {};
    }
    const int line =
        worst->block < 0 ? 0 : work.program.blocks[static_cast<std::size_t>(worst->block)].source_line;
    ReportJson json;
    json["deviation_mm"] = project::rounded(worst->height);
    if (worst->at_least) {
        json["at_least"] = true;
    }
    json["line"] = line > 0 ? ReportJson(line) : ReportJson();
    json["position_mm"] = project::vector(worst->point);
    return json;
}

ReportJson comparison_json(const SimulatedWork& work, const ComparedPart& compared) {
    constexpr double percent = 100.0;
    const simulation::ComparisonSummary& summary = compared.summary;
    ReportJson json;
    json["part"] = work.part->text;
    json["tolerance_mm"] = project::rounded(compared.tolerance);
    json["area_mm2"] = project::rounded(summary.area);
    json["within_percent"] = project::rounded(percent * summary.within);
    json["gouged_percent"] = project::rounded(percent * summary.gouged);
    json["excess_percent"] = project::rounded(percent * summary.in_excess);
    json["largest_gouge"] = worst_json(work, summary.gouge);
    json["largest_excess"] = worst_json(work, summary.excess);
    return json;
}

/// A feed that has the most of something.
ReportJson most_json(const std::optional<simulation::FeedEngagement>& feed, double figure, const char* name) {
    if (!feed) {
        return {};
    }
    ReportJson json;
    json[name] = project::rounded(figure);
    json["line"] = feed->line > 0 ? ReportJson(feed->line) : ReportJson();
    json["block"] = feed->block;
    return json;
}

ReportJson engagement_json(const simulation::EngagementSummary& summary) {
    constexpr double percent = 100.0;
    const auto& [feed_time, air_time, feeds, air_feeds, fastest, deepest, widest] = summary;
    ReportJson json;
    json["feeds"] = feeds;
    json["feeds_in_air"] = air_feeds;
    json["feed_time_s"] = project::rounded(feed_time);
    json["air_time_s"] = project::rounded(air_time);
    json["air_percent"] = project::rounded(feed_time > 0.0 ? percent * air_time / feed_time : 0.0);
    json["highest_rate"] = most_json(fastest, fastest ? fastest->rate() : 0.0, "rate_mm3_per_min");
    json["deepest"] = most_json(deepest, deepest ? deepest->depth : 0.0, "depth_mm");
    json["widest"] = most_json(widest, widest ? widest->width : 0.0, "width_mm");
    return json;
}

std::string worst_text(const SimulatedWork& work,
                       std::string_view kind,
                       const std::optional<simulation::WorstDeviation>& worst) {
    if (!worst) {
        return fmt::format("no {}", kind);
    }
    const int line =
        worst->block < 0 ? 0 : work.program.blocks[static_cast<std::size_t>(worst->block)].source_line;
    return fmt::format("largest {} {}{} mm at {} {} {}{}",
                       kind,
                       worst->at_least ? "(all material removed) at least " : "",
                       fixed(std::abs(worst->height), 4),
                       fixed(worst->point.x(), 3),
                       fixed(worst->point.y(), 3),
                       fixed(worst->point.z(), 3),
                       line > 0 ? fmt::format(" (line {})", line) : std::string());
}

void print_comparison(const SimulatedWork& work, const ComparedPart& compared) {
    constexpr double percent = 100.0;
    const simulation::ComparisonSummary& summary = compared.summary;
    fmt::print("compared with {}: {} % within {:g} mm, {} % gouged, {} % in excess\n",
               work.part->text,
               fixed(percent * summary.within, 1),
               compared.tolerance,
               fixed(percent * summary.gouged, 1),
               fixed(percent * summary.in_excess, 1));
    fmt::print(
        "{}; {}\n", worst_text(work, "gouge", summary.gouge), worst_text(work, "excess", summary.excess));
}

ReportJson box_json(const Box3& box) {
    ReportJson json;
    json["min"] = project::vector(box.min());
    json["max"] = project::vector(box.max());
    return json;
}

void print_rapids(const SimulatedWork& work, const simulation::Simulation& found) {
    constexpr std::size_t named = 5;
    std::size_t count = 0;
    for (const Finding& finding : found.findings) {
        if (finding.kind != FindingKind::rapid_in_stock || ++count > named) {
            continue;
        }
        const Vec3& at = finding.contact.place;
        fmt::print(stderr,
                   "millwright: {}\n",
                   to_text(Diagnostic{{work.program_file, finding.line, 0, -1},
                                      fmt::format("a rapid move goes through material at {} {} {}, and "
                                                  "removes {} mm^3",
                                                  fixed(at.x(), 3),
                                                  fixed(at.y(), 3),
                                                  fixed(at.z(), 3),
                                                  fixed(finding.volume, 2)),
                                      {}}));
    }
    if (count > named) {
        fmt::print(stderr,
                   "millwright: {} through material, all in simulation.json\n",
                   counted(count - named, "more rapid move goes", "more rapid moves go"));
    }
}

/// A sentence each.
std::vector<std::string> warnings_of(const SimulatedWork& work, const simulation::Simulation& found) {
    std::vector<std::string> warnings = work.warnings;
    for (Diagnostic& warning : simulation::warnings_of(found, work.tools, found.field->cell().maxCoeff())) {
        if (warning.place.line > 0) {
            warning.place.file = work.program_file;
        }
        warnings.push_back(to_text(warning));
    }
    const auto is_off = [](const Finding& finding) { return finding.kind == FindingKind::spindle_off; };
    const auto first = std::ranges::find_if(found.findings, is_off);
    if (first != found.findings.end()) {
        warnings.push_back(to_text(Diagnostic{
            {work.program_file, first->line, 0, -1},
            fmt::format("{} material while the spindle is off, the first on this line",
                        counted(std::ranges::count_if(found.findings, is_off), "move cuts", "moves cut")),
            {}}));
    }
    return warnings;
}

} // namespace

std::size_t rapid_count(const simulation::Simulation& found) {
    return static_cast<std::size_t>(std::ranges::count(
        found.findings, FindingKind::rapid_in_stock, [](const Finding& finding) { return finding.kind; }));
}

std::string simulation_report_text(const SimulatedWork& work,
                                   const simulation::Simulation& found,
                                   const simulation::CutMesh& mesh,
                                   const std::optional<ComparedPart>& compared,
                                   const simulation::CollisionReport& collisions,
                                   double clearance,
                                   const SimulationCost& cost) {
    const simulation::DexelField& field = *found.field;
    ReportJson json;
    json["format"] = "millwright-simulation";
    json["version"] = 1;
    json["made_by"] = "Millwright " + std::string(project::version());
    json["program"] = work.file.filename().string();
    json["machine"] = work.machine.name();
    json["tools"] = work.tool_texts;
    json["stock"]["text"] = work.stock_text;
    json["stock"]["box_mm"] = box_json(field.box());
    json["volume_mm3"]["stock"] = project::rounded(found.stock_volume);
    json["volume_mm3"]["removed"] = project::rounded(found.removed_volume());
    json["volume_mm3"]["left"] = project::rounded(found.left_volume);
    json["moves"]["simulated"] = found.moves;
    json["moves"]["cutting"] = found.cutting_moves;
    json["moves"]["skipped"] = found.skipped ? found.skipped->rapids + found.skipped->feeds : 0;
    json["moves"]["skipped_feeds"] = found.skipped ? found.skipped->feeds : 0;
    const auto feeds = simulation::engagements(work.program, found);
    json["engagement"] = engagement_json(simulation::summary_of(feeds));
    json["rapid_in_stock"] = rapid_count(found);
    json["findings"] = findings_json(found);
    if (compared) {
        json["comparison"] = comparison_json(work, *compared);
    }
    json["collisions"] = collisions_json(work, collisions, found, clearance);
    json["warnings"] = warnings_of(work, found);
    json["resolution_mm"] = project::vector(field.cell());
    json["mesh"]["triangles"] = mesh.triangles.size();
    json["mesh"]["edge_mm"] = project::vector(Vec3(field.cell() * mesh.stride));
    json["cost"]["time_s"] = project::rounded(cost.seconds);
    json["cost"]["threads"] = cost.threads;
    json["cost"]["field_mb"] = project::rounded(static_cast<double>(field.bytes()) / bytes_per_megabyte);
    return json.dump(2, ' ', false, ReportJson::error_handler_t::replace) + "\n";
}

void print_simulation(const SimulatedWork& work,
                      const simulation::Simulation& found,
                      const std::optional<ComparedPart>& compared,
                      const simulation::CollisionReport& collisions,
                      const SimulationCost& cost) {
    for (const std::string& warning : warnings_of(work, found)) {
        fmt::print(stderr, "warning: {}\n", warning);
    }
    print_rapids(work, found);
    for (const std::string& tool : work.tool_texts) {
        fmt::print("tool: {}\n", tool);
    }
    fmt::print("stock: {}\n", work.stock_text);
    fmt::print("removed {} of {} mm^3, {} mm^3 left\n",
               fixed(found.removed_volume(), 1),
               fixed(found.stock_volume, 1),
               fixed(found.left_volume, 1));
    fmt::print("{}, of which {} material; {}\n",
               counted(found.moves, "move"),
               counted(found.cutting_moves, "cuts", "cut"),
               rapid_count(found) == 0
                   ? std::string("no rapid move meets any")
                   : counted(rapid_count(found), "rapid move goes through it", "rapid moves go through it"));
    const simulation::EngagementSummary engaged =
        simulation::summary_of(simulation::engagements(work.program, found));
    if (engaged.fastest) {
        constexpr double percent = 100.0;
        fmt::print("{} % of the feed time in air; at most {} mm^3/min{}, {} mm deep, {} mm wide\n",
                   fixed(engaged.feed_time > 0.0 ? percent * engaged.air_time / engaged.feed_time : 0.0, 1),
                   fixed(engaged.fastest->rate(), 0),
                   engaged.fastest->line > 0 ? fmt::format(" (line {})", engaged.fastest->line)
                                             : std::string(),
                   fixed(engaged.deepest->depth, 2),
                   fixed(engaged.widest->width, 2));
    }
    if (compared) {
        print_comparison(work, *compared);
    }
    print_collisions(work, collisions, found);
    fmt::print("resolution {:.3g} mm, {:.1f} s, {:.0f} MB\n",
               found.field->cell().maxCoeff(),
               cost.seconds,
               static_cast<double>(found.field->bytes()) / bytes_per_megabyte);
}

} // namespace millwright::app
