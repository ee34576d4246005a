#include "core/plan/stock_simulation.h"

#include "core/base/error.h"
#include "core/plan/part_bodies.h"
#include "core/plan/part_surface.h"
#include "core/project/tool_settings.h"
#include "core/simulation/collision_bodies.h"
#include "core/simulation/resolution.h"
#include "core/simulation/warnings.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <span>
#include <utility>

namespace millwright::plan {

namespace {

using simulation::Finding;
using simulation::FindingKind;

constexpr double field_megabytes = 1000.0;
/// More are not seen, and take longer to bring to the screen than a person waits while scrubbing.
constexpr std::size_t most_triangles = 120'000;

program::Program with_lines(program::Program program, const program::Listing& listing) {
    for (std::size_t n = 0; n < program.blocks.size(); ++n) {
        program.blocks[n].source_line = listing.line_of_block[n];
    }
    return program;
}

/// Throws Error for a point, which removes nothing.
std::vector<simulation::ToolUse> tools_of(const StockJob& job) {
    if (job.file) {
        return job.file->tools;
    }
    const toolpath::Tool tool = project::tool_of(job.project.tool);
    if (!tool.cutter) {
        throw Error("The tool is a point and removes nothing.", {}, "Choose a cutter in Toolpath > Tool.");
    }
    return {
        {.first_block = 0, .number = job.project.tool.number, .body = *tool.cutter, .holder = tool.holder}};
}

bool is_flat(const simulation::Stock& stock) {
    constexpr double flat = 1e-6; // mm
    return simulation::bounds(stock).sizes().minCoeff() < flat;
}

/// Throws Error for the box around a flat part that is not larger than the part.
NamedStock stock_of(const StockJob& job, const Progress& progress) {
    if (!job.settings.stock.empty()) {
        return stock_from(job.settings.stock, progress);
    }
    NamedStock around = stock_around(*job.surface, job.settings.allowance);
    if (is_flat(around.stock)) {
        throw Error("The part is flat.", {}, "Choose an allowance above 0.");
    }
    return around;
}

StockEvent event_of(StockEventKind kind, const simulation::Collision& found) {
    return {.kind = kind,
            .block = found.block,
            .fraction = found.time,
            .line = found.line,
            .bodies = found.moving + " and " + found.still,
            .depth = found.depth,
            .moves = found.moves};
}

StockEvent event_of(const Finding& finding) {
    StockEvent event{.block = finding.block, .fraction = finding.time, .line = finding.line, .bodies = {}};
    switch (finding.kind) {
    case FindingKind::holder_in_stock:
    case FindingKind::shank_in_stock:
        event.bodies = finding.kind == FindingKind::holder_in_stock ? "holder and stock" : "shank and stock";
        event.depth = finding.depth;
        break;
    case FindingKind::rapid_in_stock:
        event.kind = StockEventKind::rapid_in_stock;
        event.bodies = "cutter and stock";
        event.depth = finding.contact.length;
        break;
    case FindingKind::spindle_off:
        event.kind = StockEventKind::spindle_off;
        event.bodies = "cutter and stock";
        break;
    }
    return event;
}

StockEvent event_of(const simulation::LimitViolation& limit, const kinematics::MachineModel& machine) {
    const bool rotary = machine.axis(machine.axis_index(limit.axis)).kind == kinematics::AxisKind::rotary;
    return {.kind = StockEventKind::axis_limit,
            .block = limit.block,
            .fraction = 1.0,
            .line = limit.line,
            .bodies = fmt::format("axis {}", limit.axis),
            .depth = std::abs(limit.position - limit.limit),
            .angle = rotary,
            .moves = limit.moves};
}

std::vector<StockEvent> events_of(const simulation::Simulation& cut,
                                  const simulation::CollisionReport& report,
                                  const kinematics::MachineModel& machine) {
    std::vector<StockEvent> events;
    for (const simulation::Collision& found : report.collisions) {
        events.push_back(event_of(StockEventKind::collision, found));
    }
    for (const simulation::LimitViolation& limit : report.limits) {
        events.push_back(event_of(limit, machine));
    }
    for (const Finding& finding : cut.findings) {
        events.push_back(event_of(finding));
    }
    std::ranges::stable_sort(events, {}, &StockEvent::block);
    const auto last = events.size();
    for (const simulation::Collision& found : report.near_misses) {
        events.push_back(event_of(StockEventKind::near_miss, found));
    }
    std::stable_sort(events.begin() + static_cast<std::ptrdiff_t>(last),
                     events.end(),
                     [](const StockEvent& a, const StockEvent& b) { return a.block < b.block; });
    return events;
}

} // namespace

bool give_the_same(const StockSettings& a, StockSettings b) {
    if (!a.stock.empty()) {
        b.allowance = a.allowance;
    }
    return a == b;
}

StockForecast forecast_of(const simulation::Stock& stock, std::optional<double> resolution) {
    const Box3 box = simulation::bounds(stock);
    StockForecast forecast;
    forecast.most_bytes = simulation::field_memory(field_megabytes);
    forecast.resolution = resolution.value_or(simulation::usual_resolution(box, forecast.most_bytes));
    forecast.bytes = simulation::field_size(box, forecast.resolution).bytes;
    return forecast;
}

StockForecast
forecast_of(const geometry::Surface* surface, const StockSettings& settings, const Progress& progress) {
    if (settings.stock.empty() && surface == nullptr) {
        throw Error("there is no part");
    }
    const simulation::Stock stock = settings.stock.empty() ? stock_around(*surface, settings.allowance).stock
                                                           : stock_from(settings.stock, progress).stock;
    if (is_flat(stock)) {
        StockForecast flat;
        flat.fault = "The part is flat, and so is the box around it. Choose an allowance above 0.";
        return flat;
    }
    return forecast_of(stock, settings.resolution);
}

/// Its parts refer to each other.
struct StockSimulation::Parts {
    Parts(StockJob wanted, const Progress& progress)
        : job(std::move(wanted)), program(with_lines(*job.program, *job.listing)),
          stock(stock_of(job, progress)),
          forecast(forecast_of(stock.stock, job.settings.resolution)), input{.program = program,
                                                                             .machine = job.machine(),
                                                                             .tools = tools_of(job),
                                                                             .stock = stock.stock,
                                                                             .resolution =
                                                                                 forecast.resolution,
                                                                             .most_bytes =
                                                                                 forecast.most_bytes},
          simulator(input, simulation::Rewind::by_keyframes, progress) {
        if (job.cutting_setup) {
            heights.emplace(*job.cutting_setup);
        }
    }

    [[nodiscard]] simulation::CollisionReport collisions(int first_block, const Progress& progress) const {
        const kinematics::MachineModel& machine = job.machine();
        std::vector<simulation::CollisionBody> bodies;
        if (job.surface) {
            bodies = face_bodies(machine, job.project.surface, *job.surface);
        }
        for (simulation::CollisionBody& body : simulation::machine_collision_bodies(
                 machine,
                 job.machine_solids ? std::span(*job.machine_solids)
                                    : std::span<const geometry::SolidBody>())) {
            bodies.push_back(std::move(body));
        }
        bodies.push_back(simulation::collision_body(
            machine, "stock", simulation::BodyRole::stock, simulation::surface_of(stock.stock), true));
        std::vector<simulation::CollisionTool> tools;
        for (const simulation::ToolUse& use : input.tools) {
            tools.push_back({use.first_block, use.body, use.shank, use.holder});
        }
        return simulation::check_collisions({.program = program,
                                             .machine = machine,
                                             .tools = std::move(tools),
                                             .bodies = std::move(bodies),
                                             .first_block = first_block,
                                             .clearance = job.settings.clearance,
                                             .part_allowance = job.settings.tolerance,
                                             .removal = &input},
                                            progress);
    }

    StockJob job;
    program::Program program; // its blocks know their lines
    NamedStock stock;
    StockForecast forecast;
    simulation::SimulationInput input;
    simulation::Simulator simulator;
    std::optional<PartHeights> heights; ///< nullopt without a part
};

StockSimulation::StockSimulation(StockJob job, const Progress& progress) {
    progress.report(0.0, "Simulating: cutting the stock");
    parts_ = std::make_unique<Parts>(std::move(job), progress.part(0.0, 0.02));
    Parts& parts = *parts_;
    parts.simulator.advance_to(parts.program.block_count(), progress.part(0.02, 0.6));
    auto result = std::make_shared<StockResult>();
    result->job = parts.job;
    result->stock = parts.stock.stock;
    result->stock_text = parts.stock.text;
    result->cell = parts.simulator.field().cell();
    result->cut = parts.simulator.found();
    progress.report(0.6, "Simulating: comparing with the part");
    if (parts.job.cutting_setup) {
        result->points = part_surface(*parts.job.cutting_setup).points;
    }
    result->deviations = simulation::deviations(parts.input,
                                                parts.simulator.field(),
                                                result->cut.first_block,
                                                result->points,
                                                progress.part(0.6, 0.8));
    progress.report(0.8, "Simulating: looking for collisions");
    const simulation::CollisionReport collisions =
        parts.collisions(result->cut.first_block, progress.part(0.8, 1.0));
    result->events = events_of(result->cut, collisions, parts.job.machine());
    result->unchecked = collisions.unchecked;
    result->warnings = simulation::warnings_of(result->cut, parts.input.tools, result->cell.maxCoeff());
    if (parts.job.file) {
        result->warnings.insert(
            result->warnings.begin(), parts.job.file->warnings.begin(), parts.job.file->warnings.end());
    }
    result->feeds = simulation::engagements(parts.program, result->cut);
    result->engagement = simulation::summary_of(result->feeds);
    result_ = std::move(result);
}

StockSimulation::~StockSimulation() = default;

StockPicture StockSimulation::picture_before(int block, const Progress& progress) {
    Parts& parts = *parts_;
    block = std::clamp(block, 0, parts.program.block_count());
    parts.simulator.advance_to(block, progress);
    StockPicture picture{.result = result_, .block = block, .mesh = {}, .heights = {}};
    picture.mesh = simulation::mesh_of(parts.simulator.field(), most_triangles, progress);
    if (parts.heights) {
        picture.heights = parts.heights->of(picture.mesh, progress);
    } else {
        picture.heights.resize(picture.mesh.points.size());
    }
    return picture;
}

} // namespace millwright::plan
