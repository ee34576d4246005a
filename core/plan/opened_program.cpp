#include "core/plan/opened_program.h"

#include "core/gcode/interpreter.h"
#include "core/gcode/preview.h"
#include "core/gcode_programs/machine_program.h"
#include "core/jobs/job.h"
#include "core/kinematics/machine_file.h"
#include "core/motion/planner.h"
#include "core/plan/internal/background.h"
#include "core/project/assets.h"

#include <fmt/format.h>

#include <chrono>
#include <fstream>
#include <mutex>
#include <string_view>
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

/// Throws Error with the system's reason.
void expect_readable(const fs::path& file) {
    std::error_code failure;
    if (fs::is_directory(file, failure)) {
        throw Error("is a folder", file);
    }
    const std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw Error(fs::exists(file, failure) ? "cannot be read" : "there is no such file", file);
    }
}

} // namespace

std::map<int, const Diagnostic*> OpenedProgram::errors_by_line() const {
    std::map<int, const Diagnostic*> found;
    for (const auto* list : {&errors, &faults}) {
        for (const Diagnostic& error : *list) {
            if (error.place.line > 0 && error.place.file == file) {
                found.emplace(error.place.line, &error);
            }
        }
    }
    return found;
}

class ProgramReader::Worker {
public:
    explicit Worker(std::function<void()> wake) : wake_(std::move(wake)), background_(wake_) {}

    void open(OpenedProgram start, fs::path assets) {
        publish(start);
        background_.replace([this, start = std::move(start), assets = std::move(assets)](
                                const Progress& progress) mutable { read(start, assets, progress); });
    }
    void cancel() { background_.clear(); }
    void close() {
        background_.clear();
        background_.wait_idle();
        const std::scoped_lock lock(mutex_);
        latest_.reset();
    }

    [[nodiscard]] std::shared_ptr<const OpenedProgram> latest() const {
        const std::scoped_lock lock(mutex_);
        return latest_;
    }
    [[nodiscard]] Activity activity() const { return background_.activity(); }
    void wait_idle() const { background_.wait_idle(); }

private:
    using Clock = std::chrono::steady_clock;

    void publish(OpenedProgram& now) {
        auto copy = std::make_shared<OpenedProgram>(now);
        {
            const std::scoped_lock lock(mutex_);
            copy->revision = ++revision_;
            latest_ = std::move(copy);
        }
        published_ = Clock::now();
        wake_();
    }

    void read(OpenedProgram& now, const fs::path& assets, const Progress& progress) {
        try {
            load_text(now, progress.part(0.0, 0.1));
            load_machine(now, assets);
            publish(now);
            execute(now, progress.part(0.1, 0.6));
            plan(now, progress.part(0.6, 1.0));
        } catch (const Cancelled&) {
            now.cancelled = true;
        } catch (const Error& error) {
            now.errors.push_back(error.diagnostic());
        }
        now.finished = true;
        publish(now);
    }

    static void load_text(OpenedProgram& now, const Progress& progress) {
        progress.report(0.0, "Opening " + now.file.filename().string());
        auto text = std::make_shared<ProgramText>();
        text->bytes = FileSnapshot(now.file, progress.part(0.0, 0.7));
        text->lines = gcode::LineIndex(text->bytes.text(), progress.part(0.7, 1.0));
        now.text = std::move(text);
    }

    static void load_machine(OpenedProgram& now, const fs::path& assets) {
        try {
            now.machine = std::make_shared<const kinematics::MachineModel>(kinematics::read_machine(
                project::machine_path(now.choice.machine, now.file.parent_path(), assets)));
        } catch (const Error& error) {
            now.faults.push_back(error.diagnostic());
        }
    }

    void execute(OpenedProgram& now, const Progress& progress) {
        progress.report(0.0, "Reading " + now.file.filename().string());
        gcode::PreviewBuilder builder({.machine = now.machine},
                                      [&](std::shared_ptr<const gcode::PathChunk> chunk) {
                                          now.path.chunks.push_back(std::move(chunk));
                                      });
        gcode::Interpreter program(
            now.text->bytes.text(), now.file, settings_for(now.file, now.choice, now.machine.get()), builder);
        auto execution = std::make_shared<gcode::Execution>();
        bool more = true;
        while (more) {
            builder.begin_step(execution->count());
            more = program.step();
            const gcode::SourcePlace place = program.place();
            execution->add(place.file == 0 ? place.line : 0, program.state());
            if (execution->count() % steps_per_check == 0) {
                look_around(now, program, progress);
            }
        }
        builder.finish();
        execution->shrink();
        now.errors = program.errors();
        now.execution = std::move(execution);
        now.seconds = builder.seconds();
        now.length = builder.length();
        publish(now);
    }

    void look_around(OpenedProgram& now, const gcode::Interpreter& program, const Progress& progress) {
        progress.check();
        const auto lines = static_cast<double>(std::max<std::ptrdiff_t>(now.text->lines.count(), 1));
        progress.report(static_cast<double>(program.line_count()) / lines);
        const std::size_t shown = latest()->path.chunks.size();
        const bool first = shown == 0 && !now.path.empty();
        if (first || (now.path.chunks.size() > shown && Clock::now() - published_ > between_publications)) {
            publish(now);
        }
    }

    static std::string moved_axes(const program::Program& program) {
        std::string letters;
        for (std::size_t n = 0; n < program.axes.size(); ++n) {
            const bool moves = std::ranges::any_of(program.blocks, [&](const program::Block& block) {
                return block.moves() && block.named.contains(static_cast<int>(n));
            });
            letters += moves ? std::string(1, program.axes[n].letter) : "";
        }
        return letters;
    }

    static void plan(OpenedProgram& now, const Progress& progress) {
        if (!now.errors.empty()) {
            now.no_motion = "The program has errors.";
        } else if (!now.machine) {
            now.no_motion = "No machine is selected for planning.";
        } else if (now.path.point_count() > most_planned_points) {
            now.no_motion = fmt::format("More than {} moves: times are based on the programmed feed rates.",
                                        most_planned_points);
        }
        if (!now.no_motion.empty()) {
            return;
        }
        progress.report(0.0, "Planning " + now.file.filename().string());
        gcode::MachineProgramBuilder builder(*now.machine, now.file);
        gcode::Interpreter program(
            now.text->bytes.text(), now.file, settings_for(now.file, now.choice, now.machine.get()), builder);
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
        now.faults.insert(now.faults.end(), made.faults.begin(), made.faults.end());
        if (made.program.blocks.empty()) {
            now.no_motion = "The program contains no motion.";
            return;
        }
        motion->trajectory = std::make_shared<const motion::Trajectory>(
            motion::plan(made.program, *now.machine, {}, progress));
        motion->listing =
            std::make_shared<const program::Listing>(gcode::listing_of(now.text->bytes.text(), made.program));
        motion->moved_axes = moved_axes(made.program);
        motion->program = std::make_shared<const program::Program>(std::move(made.program));
        jobs::Job job;
        job.machine = now.machine;
        job.program = motion->program;
        job.listing = motion->listing;
        now.findings = jobs::preflight(job);
        now.unplaced = std::move(made.unplaced);
        now.start_notice = std::move(made.start_notice);
        now.findings.insert(now.findings.end(), now.unplaced.begin(), now.unplaced.end());
        now.motion = std::move(motion);
    }

    std::function<void()> wake_;
    mutable std::mutex mutex_; ///< guards latest_ and revision_
    std::shared_ptr<const OpenedProgram> latest_;
    std::uint64_t revision_ = 0;
    Clock::time_point published_;
    Background background_; // last: its thread uses what stands before it
};

ProgramReader::ProgramReader(std::function<void()> wake)
    : worker_(std::make_unique<Worker>(std::move(wake))) {}

ProgramReader::~ProgramReader() = default;

void ProgramReader::open(const fs::path& file, ReadingChoice choice, fs::path assets) {
    expect_readable(file);
    OpenedProgram start;
    start.file = fs::absolute(file).lexically_normal();
    start.choice = std::move(choice);
    worker_->close();
    worker_->open(std::move(start), std::move(assets));
}

void ProgramReader::cancel() {
    worker_->cancel();
}

void ProgramReader::close() {
    worker_->close();
}

std::shared_ptr<const OpenedProgram> ProgramReader::latest() const {
    return worker_->latest();
}

Activity ProgramReader::activity() const {
    return worker_->activity();
}

void ProgramReader::wait_idle() const {
    worker_->wait_idle();
}

} // namespace millwright::plan
