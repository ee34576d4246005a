#include "ui/workspaces/frame_state.h"

#include "core/base/sentences.h"
#include "core/base/text.h"
#include "core/plan/cut_study.h"
#include "core/plan/gouges.h"
#include "core/plan/strategy_path.h"
#include "core/project/setting_tables.h"
#include "ui/workspaces/shown_grid.h"

#include <algorithm>
#include <cmath>

namespace millwright::actions {

namespace {

/// The move of the tool path that a block belongs to, and how far it is; approach and links hold the nearest
/// end.
viewport::Moment moment_in(const program::Program& program, const motion::Sample& sample) {
    viewport::Moment moment;
    moment.axes = sample.position;
    const auto& blocks = program.blocks;
    const auto block = static_cast<std::size_t>(std::clamp(sample.block, 0, program.block_count() - 1));
    int point = -1;
    for (std::size_t n = 0; n < block; ++n) {
        point = std::max(point, blocks[n].path_point);
    }
    const bool inside = blocks[block].path_point > 0 && blocks[block].role == program::MoveRole::cut;
    moment.move = point;
    moment.fraction = inside ? sample.fraction : 0.0;
    return moment;
}

} // namespace

std::shared_ptr<const plan::Evaluation> FrameState::evaluation(project::GridMethod method) const {
    return plan ? plan->plan.grid(method).evaluation : nullptr;
}

toolpath::SetUpPlace FrameState::set_up_place() const {
    if (view_state.set_up.place) {
        return *view_state.set_up.place;
    }
    return set_up && set_up->study ? set_up->study->search.best.place
                                   : toolpath::SetUpPlace(toolpath::SetUpPlace::Zero());
}

std::shared_ptr<const plan::Evaluation> FrameState::shown() const {
    if (shows_own_path()) {
        return plan->plan.path;
    }
    return evaluation(shown_grid(*this));
}

bool FrameState::shows_own_path() const {
    return view_state.own_path_shown && plan && plan->plan.path && plan::has_own_path(project);
}

std::string FrameState::shown_name() const {
    return shows_own_path() ? plan::strategy_text(project)
                            : std::string(project::row_of(project::grid_methods(), shown_grid(*this)).label);
}

std::string FrameState::part_place() const {
    if (!plan || !plan->plan.cutting_setup) {
        return {};
    }
    const Vec3& at = plan->plan.cutting_setup->machine.description().workpiece_offset;
    const auto to_hundredths = [](double mm) { return shortest(std::round(100.0 * mm) / 100.0 + 0.0); };
    return "part at " + to_hundredths(at.x()) + ", " + to_hundredths(at.y()) + ", " + to_hundredths(at.z()) +
           " mm";
}

std::shared_ptr<const plan::Evaluation> FrameState::program_path() const {
    return plan ? plan->plan.program_path(project) : nullptr;
}

bool FrameState::in_file() const {
    return opened && (view_state.workspace == Workspace::program ||
                      view_state.workspace == Workspace::machine || view_state.workspace == Workspace::plot);
}

double FrameState::duration() const {
    if (in_file()) {
        return duration_of(*opened);
    }
    const auto planned = trajectory();
    return planned ? planned->duration() : 0.0;
}

std::optional<FilePlace> FrameState::file_place() const {
    if (!in_file()) {
        return std::nullopt;
    }
    const auto& chosen = view_state.file.step;
    if (chosen && !follows_job() && opened->execution && *chosen < opened->execution->count()) {
        return place_in(*opened, *chosen, time());
    }
    return place_at(*opened, time());
}

std::shared_ptr<const motion::Trajectory> FrameState::trajectory() const {
    if (in_file()) {
        return opened->motion ? opened->motion->trajectory : nullptr;
    }
    if (view_state.workspace == Workspace::plot) {
        return nullptr; // not that of the project
    }
    return plan ? plan->plan.trajectory : nullptr;
}

std::shared_ptr<const program::Program> FrameState::program() const {
    if (in_file()) {
        return opened->motion ? opened->motion->program : nullptr;
    }
    if (view_state.workspace == Workspace::plot) {
        return nullptr;
    }
    return plan ? plan->plan.program : nullptr;
}

ProgramOfMachine FrameState::arm_program() const {
    if (view_state.manual.arm_path.of_file && opened) {
        return opened->motion ? ProgramOfMachine{opened->motion->program, opened->machine}
                              : ProgramOfMachine{};
    }
    const auto cutting_setup = plan ? plan->plan.cutting_setup : nullptr;
    return cutting_setup && plan->plan.program
               ? ProgramOfMachine{plan->plan.program, {cutting_setup, &cutting_setup->machine}}
               : ProgramOfMachine{};
}

std::shared_ptr<const program::Listing> FrameState::listing() const {
    return plan ? plan->plan.listing : nullptr;
}

project::Project design_of(project::Project project) {
    project.plot = {};
    project.stock = {};
    project.arm = {};
    return project;
}

bool FrameState::program_is_current() const {
    return plan != nullptr && plan->project == design_of(project);
}

bool FrameState::program_is_final() const {
    return program_is_current() && (plan->program_exact || plan->failure);
}

std::string FrameState::gouge_warning() const {
    if (project.tool.cutter == toolpath::CutterKind::point || !plan) {
        return {};
    }
    const auto& cut = plan->plan.cut;
    const std::string text =
        cut ? plan::gouge_text(plan->project, *cut) : "the program has not been checked for gouges yet";
    return text.empty() ? text : as_sentence(text);
}

std::string FrameState::failure() const {
    return plan && plan->failure ? to_text(*plan->failure) : std::string();
}

std::optional<int> FrameState::job_line() const {
    const int block = job.report->driver.block;
    if (!job.listing || block < 0 || block >= std::ssize(job.listing->line_of_block)) {
        return std::nullopt;
    }
    const int line = job.listing->line_of_block[static_cast<std::size_t>(block)];
    return std::max(line, job.from_line); // what is above it is the approach
}

std::optional<double> FrameState::time_at_line(int line) const {
    if (in_file()) {
        return opened->execution ? std::optional(time_of(*opened, opened->execution->step_at_or_after(line)))
                                 : std::nullopt;
    }
    const auto text = listing();
    const auto planned = trajectory();
    if (!text || !planned) {
        return std::nullopt;
    }
    const auto& lines = text->line_of_block;
    const auto block = static_cast<int>(std::ranges::lower_bound(lines, line) - lines.begin());
    return block < planned->block_count() ? planned->start_of(block) : planned->duration();
}

/// Where a controller plans for itself, and where the job began at a line and has times of its own, from the
/// line that is executed.
double FrameState::job_time() const {
    const drivers::DriverStatus& status = job.report->driver;
    const bool whole = job.from_line <= 1;
    if (whole && (status.planned_time > 0.0 || !in_file())) {
        return status.planned_time;
    }
    const bool over = job.listing && status.executed_blocks >= std::ssize(job.listing->line_of_block);
    if (!whole && over) {
        return duration();
    }
    const auto line = job_line();
    const auto begin = line ? time_at_line(*line) : std::nullopt;
    const auto end = line ? time_at_line(*line + 1) : std::nullopt;
    if (begin && end && *end > *begin) {
        return *begin + status.fraction * (*end - *begin);
    }
    return begin.value_or(whole ? status.planned_time : 0.0);
}

bool FrameState::job_is_shown() const {
    const std::filesystem::path& file = in_file() ? opened->file : document.file;
    return !job.name.empty() && job.project == (file.empty() ? project.name : file.string());
}

bool FrameState::follows_job() const {
    return job.running && job.report && job_is_shown();
}

double FrameState::time() const {
    return follows_job() ? job_time() : view_state.playback.time;
}

int FrameState::block() const {
    const auto planned = trajectory();
    return planned ? planned->block_at(time()) : -1;
}

std::shared_ptr<const kinematics::MachineModel> FrameState::machine() const {
    if (in_file()) {
        return opened->machine;
    }
    const auto cutting_setup = plan ? plan->plan.cutting_setup : nullptr;
    return cutting_setup
               ? std::shared_ptr<const kinematics::MachineModel>(cutting_setup, &cutting_setup->machine)
               : nullptr;
}

bool FrameState::draws_another_machine() const {
    const auto model = machine();
    return connection.connected() && model && !connection.axes.empty() &&
           !std::ranges::equal(connection.axes,
                               model->axes(),
                               {},
                               &program::ProgramAxis::letter,
                               &kinematics::MachineAxis::letter);
}

/// A controller that plans for itself knows its work offsets, and programs are written in those.
kinematics::AxisPositions FrameState::connected_axes() const {
    const auto model = machine();
    if (view_state.workspace != Workspace::machine || !connection.connected() || !model ||
        connection.axes.empty() || draws_another_machine()) {
        return {};
    }
    const drivers::DriverStatus& status = connection.status;
    if (status.position.size() != model->axis_count()) {
        return {};
    }
    return connection.can.takes_text() ? status.work_position() : status.position;
}

std::optional<Vec3> FrameState::table_tip() const {
    return view_state.workspace == Workspace::plot ? plot.table_tip(view_state.playback.time) : std::nullopt;
}

bool FrameState::at_machine() const {
    if (connected_axes().size() > 0) {
        return true;
    }
    if (!job.report || !job_is_shown()) {
        return false;
    }
    constexpr double same_moment = 1e-9; // s
    return job.running || std::abs(view_state.playback.time - job_time()) < same_moment;
}

std::optional<viewport::Moment> FrameState::moment_of_program() const {
    if (const auto place = file_place()) {
        return place->axes.size() > 0 ? std::optional(viewport::Moment{place->axes, -1, 0.0}) : std::nullopt;
    }
    const auto planned = trajectory();
    const auto made = program();
    if (in_file() || !planned || !made || made->blocks.empty()) {
        return std::nullopt;
    }
    return moment_in(*made, planned->at(time()));
}

std::optional<viewport::Moment> FrameState::moment() const {
    auto moment = moment_of_program();
    if (const auto connected = connected_axes(); connected.size() > 0) {
        const bool follows = moment && follows_job();
        return viewport::Moment{connected, follows ? moment->move : -1, follows ? moment->fraction : 0.0};
    }
    const bool reported = moment && follows_job();
    if (reported && job.report->driver.position.size() == moment->axes.size()) {
        moment->axes = job.report->driver.position;
    }
    return moment;
}

} // namespace millwright::actions
