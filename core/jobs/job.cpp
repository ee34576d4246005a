#include "core/jobs/job.h"

#include "core/base/units.h"
#include "core/gcode/axes.h"
#include "core/gcode/program_text.h"
#include "core/gcode/word_column.h"
#include "core/gcode_programs/machine_program.h"
#include "core/jobs/file_job.h"
#include "core/kinematics/travel.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <set>
#include <utility>

namespace millwright::jobs {

namespace {

using kinematics::AxisKind;
using kinematics::MachineAxis;
using kinematics::MachineModel;
using program::Block;
using program::BlockKind;

void check_axes(const program::Program& program,
                const MachineModel& machine,
                std::vector<Diagnostic>& found) {
    bool same = static_cast<int>(program.axes.size()) == machine.axis_count();
    std::string wanted;
    for (const program::ProgramAxis& axis : program.axes) {
        const int n = machine.axis_index(axis.letter);
        same = same && n == static_cast<int>(wanted.size()) && machine.axis(n).kind == axis.kind;
        wanted += axis.letter;
    }
    if (!same) {
        found.push_back({{},
                         fmt::format("the program is for axes {} of '{}', not for machine '{}'",
                                     wanted,
                                     program.machine,
                                     machine.name()),
                         "generate the program for this machine"});
    }
}

/// The file whose lines the listing has; a project's program has none, and is called by its name.
std::filesystem::path program_file(const Job& job) {
    const std::filesystem::path file(job.project);
    return file.empty() || file.extension() == ".json" ? std::filesystem::path(job.name) : file;
}

class BlockChecks {
public:
    BlockChecks(const Job& job, std::vector<Diagnostic>& found) : job_(job), found_(found) {}

    void check(int n) {
        const Block& block = job_.program->blocks[static_cast<std::size_t>(n)];
        for (int axis = 0; axis < job_.machine->axis_count(); ++axis) {
            const MachineAxis& limits = job_.machine->axis(axis);
            std::string sentence = kinematics::beyond_travel(limits, block.target[axis]);
            if (!sentence.empty() && reported_.insert(limits.letter).second) {
                report(n, limits.letter, std::move(sentence));
            }
        }
        const bool timed = block.kind == BlockKind::feed || block.kind == BlockKind::dwell;
        const bool rests = block.target == program::position_before(*job_.program, n);
        const bool enough = block.duration > 0.0 || (rests && block.duration >= 0.0);
        if (timed && !(std::isfinite(block.duration) && enough)) {
            report(n, 'F', fmt::format("a duration of {} s cannot be executed", block.duration));
        }
    }

private:
    const Job& job_;
    std::vector<Diagnostic>& found_;
    std::set<char> reported_; ///< once per axis is enough

    void report(int n, char letter, std::string sentence) {
        const int line = job_.listing->line_of_block[static_cast<std::size_t>(n)];
        const int column = std::max(1, gcode::column_of_word(job_.listing->line(line), letter));
        found_.push_back({{program_file(job_), line, column, -1}, std::move(sentence), {}});
    }
};

} // namespace

std::string_view to_text(JobEnd end) {
    switch (end) {
    case JobEnd::done:
        return "done";
    case JobEnd::stopped:
        return "stopped";
    case JobEnd::cancelled:
        return "cancelled";
    case JobEnd::fault:
        return "fault";
    }
    return "unknown";
}

int Job::block_count() const {
    return static_cast<int>(listing->line_of_block.size());
}

Job for_axes_of(const Job& job, const std::vector<program::ProgramAxis>& axes) {
    Job result = job;
    const auto same = [](const program::ProgramAxis& a, const program::ProgramAxis& b) {
        return a.letter == b.letter && a.kind == b.kind;
    };
    if (job.program != nullptr && !axes.empty() && !std::ranges::equal(job.program->axes, axes, same)) {
        result.program = nullptr;
    }
    return result;
}

Job text_job(std::string text, const std::filesystem::path& file) {
    Job job;
    job.name = file.stem().string();
    job.project = file.string();
    job.listing = std::make_shared<const program::Listing>(gcode::listing_of(std::move(text), file));
    return job;
}

Job planned_job(std::string_view text,
                const std::filesystem::path& file,
                std::shared_ptr<const MachineModel> machine,
                std::optional<kinematics::AxisPositions> start) {
    const kinematics::AxisPositions from =
        start.value_or(gcode::MachineProgramBuilder(*machine, file).take().program.start);
    return internal::planned_text(
        text, file, std::move(machine), {.start = from, .origin = gcode::WorkOrigin(Vec3(0.0, 0.0, 0.0))});
}

namespace {

void check_track(const Job& job, std::vector<Diagnostic>& found) {
    const drivers::PointTrack& track = *job.points;
    expects(!track.points.empty() && track.points.size() == track.blocks.size(),
            "each point belongs to a block");
    for (Diagnostic& fault : drivers::check_points(track, *job.machine, program_file(job))) {
        const int block = track.blocks[static_cast<std::size_t>(fault.place.line) - 1];
        fault.place.line = job.listing->line_of_block[static_cast<std::size_t>(block)];
        found.push_back(std::move(fault));
    }
}

} // namespace

std::vector<Diagnostic> preflight(const Job& job) {
    expects(job.listing != nullptr, "a job has a listing");
    if (job.program == nullptr) {
        return {};
    }
    expects(job.machine != nullptr, "a job with a program has a machine");
    const program::Program& program = *job.program;
    expects(std::ssize(job.listing->line_of_block) == program.block_count(),
            "a listing belongs to its program");
    std::vector<Diagnostic> found;
    check_axes(program, *job.machine, found);
    if (!found.empty()) {
        return found;
    }
    const bool says_where = !program.blocks.empty() && program.blocks.back().kind == BlockKind::end;
    if (!says_where && !job.points) { // points end with the last one
        found.push_back({{program_file(job), 0, 0, -1}, "the program has no end block", {}});
    }
    BlockChecks checks(job, found);
    for (int n = 0; n < program.block_count() && !job.points; ++n) {
        checks.check(n);
    }
    if (job.points) {
        check_track(job, found);
    }
    return found;
}

std::string lasting_name(const std::string& project) {
    std::error_code none;
    return std::filesystem::is_regular_file(project, none)
               ? std::filesystem::absolute(project).lexically_normal().string()
               : project;
}

std::string program_hash(std::string_view listing) {
    std::uint64_t hash = 0xcbf29ce484222325U; // offset basis and prime of FNV-1a, 64 bit
    for (const char c : listing) {
        hash ^= static_cast<unsigned char>(c);
        hash *= 0x100000001b3U;
    }
    return fmt::format("{:016x}", hash);
}

} // namespace millwright::jobs
