#include "core/plan/internal/program_reading.h"

#include "core/gcode/preview.h"
#include "core/gcode_programs/machine_program.h"
#include "core/gcode_programs/tool_calls.h"
#include "core/jobs/job.h"
#include "core/kinematics/machine_file.h"
#include "core/motion/planner.h"
#include "core/plan/internal/failure.h"
#include "core/project/assets.h"

#include <fmt/format.h>

#include <algorithm>
#include <string>
#include <utility>

namespace millwright::plan {

namespace {

namespace fs = std::filesystem;

constexpr int most_errors = 1000;
constexpr int steps_per_check = 4096;
constexpr auto between_publications = std::chrono::milliseconds(40);

/// A Grbl is taken to have the axes of the machine.
gcode::ReaderSettings
settings_for(const fs::path& file, const ReadingChoice& choice, const kinematics::MachineModel* machine) {
    gcode::ReaderSettings settings;
    settings.dialect = choice.dialect;
    settings.any_tool = true;
    settings.most_errors = most_errors;
    if (machine != nullptr) {
        settings.grbl_axes.clear();
        for (const kinematics::MachineAxis& axis : machine->axes()) {
            settings.grbl_axes += axis.letter;
        }
    }
    settings.subroutine_folders = {file.parent_path().empty() ? "." : file.parent_path()};
    return settings;
}

std::string moved_axes(const program::Program& program) {
    std::string letters;
    for (std::size_t n = 0; n < program.axes.size(); ++n) {
        const bool moves = std::ranges::any_of(program.blocks, [&](const program::Block& block) {
            return block.moves() && block.named.contains(static_cast<int>(n));
        });
        letters += moves ? std::string(1, program.axes[n].letter) : "";
    }
    return letters;
}

Box3 cut_box(const gcode::PreviewPath& path) {
    constexpr double least_way = 1e-3; // mm, across Z
    Box3 box;
    for (const auto& chunk : path.chunks) {
        for (std::size_t n = 1; n < chunk->points.size(); ++n) {
            const Vec3 from = chunk->points[n - 1].position(), to = chunk->points[n].position();
            if (chunk->points[n].kind() == gcode::PathKind::feed &&
                (to - from).head<2>().norm() > least_way) {
                box.extend(from);
                box.extend(to);
            }
        }
    }
    return box;
}

/// What stops a simulation of the material, before its tools are asked for.
std::optional<Diagnostic> unsimulated(const gcode::MachineProgram& made) {
    if (!made.faults.empty()) {
        return made.faults.front();
    }
    return made.lost.empty() ? std::nullopt : std::optional(made.lost.front());
}

} // namespace

ProgramReading::ProgramReading(OpenedProgram& now,
                               fs::path folder,
                               const fs::path& assets,
                               std::function<void()> show)
    : now_(now), folder_(std::move(folder)), assets_(assets), show_(std::move(show)) {}

void ProgramReading::read(const Progress& progress) {
    try {
        load_machine();
        show();
        execute(progress.part(0.0, 0.55));
        plan(progress.part(0.55, 1.0));
    } catch (const Error& error) {
        now_.errors.push_back(error.diagnostic());
    }
}

void ProgramReading::show() {
    shown_chunks_ = now_.path.chunks.size();
    show_();
    shown_at_ = Clock::now();
}

void ProgramReading::load_machine() {
    try {
        now_.machine = std::make_shared<const kinematics::MachineModel>(
            kinematics::read_machine(project::machine_path(now_.choice.machine, folder_, assets_)));
    } catch (const Error& error) {
        now_.faults.push_back(error.diagnostic());
    }
}

void ProgramReading::execute(const Progress& progress) {
    progress.report(0.0, "Reading " + now_.file.filename().string());
    gcode::PreviewBuilder builder(
        {.machine = now_.machine},
        [&](std::shared_ptr<const gcode::PathChunk> chunk) { now_.path.chunks.push_back(std::move(chunk)); });
    gcode::Interpreter program(
        now_.text->text(), now_.file, settings_for(now_.file, now_.choice, now_.machine.get()), builder);
    auto execution = std::make_shared<gcode::Execution>();
    bool more = true;
    while (more) {
        builder.begin_step(execution->count());
        more = program.step();
        const gcode::SourcePlace place = program.place();
        execution->add(place.file == 0 ? place.line : 0, program.state());
        if (execution->count() % steps_per_check == 0) {
            look_around(program, progress);
        }
    }
    builder.finish();
    execution->shrink();
    now_.errors = program.errors();
    now_.execution = std::move(execution);
    now_.seconds = builder.seconds();
    now_.length = builder.length();
    show();
}

void ProgramReading::look_around(const gcode::Interpreter& program, const Progress& progress) {
    progress.check();
    const auto lines = static_cast<double>(std::max<std::ptrdiff_t>(now_.text->lines().count(), 1));
    progress.report(static_cast<double>(program.line_count()) / lines);
    const bool first = shown_chunks_ == 0 && !now_.path.empty();
    if (first ||
        (now_.path.chunks.size() > shown_chunks_ && Clock::now() - shown_at_ > between_publications)) {
        show();
    }
}

void ProgramReading::plan(const Progress& progress) {
    if (!now_.errors.empty()) {
        now_.no_motion = "The program has errors.";
    } else if (!now_.machine) {
        now_.no_motion = "No machine is selected for planning.";
    } else if (now_.path.point_count() > most_planned_points) {
        now_.no_motion = fmt::format("More than {} moves: times are based on the programmed feed rates.",
                                     most_planned_points);
    }
    if (!now_.no_motion.empty()) {
        return;
    }
    progress.report(0.0, "Planning " + now_.file.filename().string());
    gcode::MachineProgramBuilder builder(*now_.machine, now_.file);
    gcode::ToolCallRecorder recorder(builder);
    gcode::Interpreter program(
        now_.text->text(), now_.file, settings_for(now_.file, now_.choice, now_.machine.get()), recorder);
    auto motion = std::make_shared<PlannedMotion>();
    gcode::Step step = 0;
    for (bool more = true; more; ++step) {
        more = program.step();
        motion->step_of_block.resize(static_cast<std::size_t>(builder.block_count()), step);
        if (step % steps_per_check == 0) {
            progress.check();
        }
    }
    gcode::MachineProgram made = builder.take();
    now_.faults.insert(now_.faults.end(), made.faults.begin(), made.faults.end());
    if (made.program.blocks.empty()) {
        now_.no_motion = "The program contains no motion.";
        return;
    }
    motion->trajectory =
        std::make_shared<const motion::Trajectory>(motion::plan(made.program, *now_.machine, {}, progress));
    motion->listing =
        std::make_shared<const program::Listing>(gcode::listing_of(now_.text->text(), made.program));
    motion->moved_axes = moved_axes(made.program);
    motion->unsimulated = unsimulated(made);
    if (!motion->unsimulated) {
        motion->unsimulated = failure_of([&] { motion->tool_calls = recorder.calls(now_.file); });
    }
    motion->cut_box = cut_box(now_.path);
    motion->program = std::make_shared<const program::Program>(std::move(made.program));
    jobs::Job job;
    job.machine = now_.machine;
    job.program = motion->program;
    job.listing = motion->listing;
    now_.findings = jobs::preflight(job);
    now_.unplaced = std::move(made.unplaced);
    now_.start_notice = std::move(made.start_notice);
    now_.findings.insert(now_.findings.end(), now_.unplaced.begin(), now_.unplaced.end());
    now_.motion = std::move(motion);
}

} // namespace millwright::plan
