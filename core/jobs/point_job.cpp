#include "core/jobs/point_job.h"

#include "core/drivers/pause.h"
#include "core/drivers/table_axes.h"
#include "core/gcode_programs/machine_program.h"
#include "core/plot/decode.h"
#include "core/plot/plot_program.h"
#include "core/posts/writer.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>
#include <utility>
#include <vector>

namespace millwright::jobs {

namespace {

using kinematics::MachineModel;
using program::Block;
using program::BlockKind;
using program::Program;

/// The slowest axis, which no rounding of the samples exceeds; velocities that were asked for may.
double fastest_of(const plot::DecodeSettings& decoding, const MachineModel& model) {
    double slowest = std::numeric_limits<double>::max();
    for (const std::size_t axis : drivers::table_axes(model)) {
        slowest = std::min(slowest, model.axis(static_cast<int>(axis)).max_velocity);
    }
    return std::max({slowest,
                     decoding.velocity,
                     decoding.travel_velocity.value_or(0.0),
                     decoding.plunge_velocity.value_or(0.0)});
}

/// Of each point, by that of the path which it leads to.
std::vector<int>
blocks_of(const std::vector<int>& path_points, const Program& program, std::size_t path_points_count) {
    const std::vector<int> at = program::blocks_of_points(program, static_cast<int>(path_points_count));
    const auto first = std::ranges::find_if(program.blocks, &Block::moves);
    std::vector<int> blocks;
    blocks.reserve(path_points.size());
    int block = static_cast<int>(first - program.blocks.begin());
    for (const int point : path_points) {
        block = point < 0 ? block : std::max(block, at[static_cast<std::size_t>(point)]);
        blocks.push_back(block);
    }
    return blocks;
}

std::vector<drivers::PointTrack::Stop>
stops_of(const Program& program, const program::Listing& listing, const std::vector<int>& blocks) {
    std::vector<drivers::PointTrack::Stop> stops;
    for (int n = 0; n < program.block_count(); ++n) {
        if (program.blocks[static_cast<std::size_t>(n)].kind == BlockKind::pause) {
            stops.push_back(
                {.before = static_cast<std::size_t>(std::ranges::upper_bound(blocks, n) - blocks.begin()),
                 .why = drivers::reason_of_pause(program, &listing, n)});
        }
    }
    return stops;
}

kinematics::AxisPositions
on_table(const Vec3& point, const std::array<std::size_t, 3>& index, const MachineModel& machine) {
    kinematics::AxisPositions axes = kinematics::AxisPositions::Zero(machine.axis_count());
    for (std::size_t k = 0; k < index.size(); ++k) {
        axes[static_cast<Eigen::Index>(index[k])] = point[static_cast<Eigen::Index>(k)];
    }
    return axes;
}

Job job_of(const std::filesystem::path& file, std::shared_ptr<const MachineModel> machine) {
    Job job;
    job.name = file.stem().string();
    job.project = file.string();
    job.machine = std::move(machine);
    return job;
}

} // namespace

Vec3 usual_start(const plot::CutPath& path) {
    return {0.0, 0.0, path.empty() ? 0.0 : path.front().at.z()};
}

Job path_points_job(const plot::CutPath& path,
                    const std::filesystem::path& file,
                    std::shared_ptr<const MachineModel> machine,
                    const PathPoints& settings) {
    Program program = plot::plot_program(path,
                                         {.machine = machine->name(),
                                          .axes = plot::plot_axes(*machine),
                                          .header = {"made of: " + file.filename().string()},
                                          .spindle_rpm = settings.spindle_rpm});
    const Vec3 start = settings.start.value_or(usual_start(path));
    program.start = on_table(start, drivers::table_axes(*machine), *machine);
    program::Listing listing = posts::write_gcode(program, {});
    plot::DecodedPath decoded =
        plot::decode_path(path, settings.decoding, fastest_of(settings.decoding, *machine), start);
    drivers::PointTrack track{.period = settings.decoding.period / settings.speed,
                              .points = std::move(decoded.points),
                              .blocks = blocks_of(decoded.path_points, program, path.size()),
                              .stops = {}};
    track.stops = stops_of(program, listing, track.blocks);
    Job job = job_of(file, std::move(machine));
    job.program = std::make_shared<const Program>(std::move(program));
    job.listing = std::make_shared<const program::Listing>(std::move(listing));
    job.points = std::make_shared<const drivers::PointTrack>(std::move(track));
    return job;
}

Job point_file_job(std::string_view text,
                   const plot::PointFile& read,
                   const std::filesystem::path& file,
                   std::shared_ptr<const MachineModel> machine,
                   double period) {
    const std::vector<Vec3>& points = read.points;
    if (points.empty()) {
        throw Error("there are no points to run", file);
    }
    if (points.size() > plot::most_program_points) {
        throw Error(fmt::format("{} points exceed the maximum of {} million",
                                points.size(),
                                plot::most_program_points / 1'000'000),
                    file);
    }
    const auto index = drivers::table_axes(*machine);
    program::AxisSet named;
    for (const std::size_t axis : index) {
        named.insert(static_cast<int>(axis));
    }
    Program program;
    program.machine = machine->name();
    for (const kinematics::MachineAxis& axis : machine->axes()) {
        program.axes.push_back({.letter = axis.letter, .kind = axis.kind});
    }
    program.start = on_table(points.front(), index, *machine);
    drivers::PointTrack track{
        .period = period, .points = points, .blocks = {}, .stops = {}, .ends_blocks = true};
    for (std::size_t n = 0; n < points.size(); ++n) {
        Block block;
        block.kind = BlockKind::feed;
        block.target = on_table(points[n], index, *machine);
        block.named = named;
        block.duration = period;
        block.feed = n == 0 ? 0.0 : (points[n] - points[n - 1]).norm() / period;
        block.path_point = static_cast<int>(n);
        block.source_line = read.lines[n];
        program.blocks.push_back(std::move(block));
        track.blocks.push_back(static_cast<int>(n));
    }
    Job job = job_of(file, std::move(machine));
    job.listing = std::make_shared<const program::Listing>(gcode::listing_of(text, program));
    job.program = std::make_shared<const Program>(std::move(program));
    job.points = std::make_shared<const drivers::PointTrack>(std::move(track));
    return job;
}

} // namespace millwright::jobs
