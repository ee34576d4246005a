// What a panel may look at in one frame. Panels show it and ask for actions; they change nothing.
#pragma once

#include "core/jobs/job_queue.h"
#include "core/plan/pipeline.h"
#include "core/plan/set_up_work.h"
#include "core/project/recent_files.h"
#include "core/project/recovery.h"
#include "ui/render/gamepad.h"
#include "ui/workspaces/approach.h"
#include "ui/workspaces/document.h"
#include "ui/workspaces/file_place.h"
#include "ui/workspaces/job_recovery.h"
#include "ui/workspaces/job_runner.h"
#include "ui/workspaces/machine_connection.h"
#include "ui/workspaces/plot_workspace.h"
#include "ui/workspaces/view_state.h"

#include <memory>
#include <string>
#include <vector>

namespace millwright::actions {

class ArmWorkspace;
class PendingImport;
class ProcessorWorkspace;
class StockWorkspace;
struct RunCheck;

/// Both null where there is none.
struct ProgramOfMachine {
    std::shared_ptr<const program::Program> program;
    std::shared_ptr<const kinematics::MachineModel> machine; ///< that it is for
};

/// Without stock, plot and arm, of which the plan has no use.
[[nodiscard]] project::Project design_of(project::Project project);

struct FrameState {
    const project::Project& project;
    const ViewState& view_state;
    const Document& document;
    std::shared_ptr<const plan::PublishedPlan> plan;        ///< null before the first
    std::shared_ptr<const plan::WatchedAdaptation> watched; ///< null while none is watched
    plan::Activity activity;                                ///< of whatever works in the background
    std::shared_ptr<const plan::OpenedProgram> opened_file; ///< a G-code file; null while none is open
    /// The program that is looked at: of the plot in its workspace, elsewhere `opened_file`, and before the
    /// arm that of the plot where no file is open. Null while there is none.
    std::shared_ptr<const plan::OpenedProgram> opened;
    JobView job;
    std::shared_ptr<const Approach> approach; ///< of ViewState::start_at; null while it is not worked out
    ConnectionView connection;
    std::shared_ptr<drivers::Console> console; ///< of the connected machine; null without one
    std::string undo_title, redo_title;        ///< empty if there is nothing
    std::filesystem::path assets;
    const project::RecentFiles& recent;
    /// "open sine.json": waits until the person has said what becomes of unsaved changes; empty: nothing
    /// does.
    std::string leaving_to;
    const std::vector<project::LeftBehind>& left_behind;     ///< by programs that crashed; to be asked about
    std::shared_ptr<const JobRecovery::Stories> broken_jobs; ///< the same, of jobs; never null
    std::optional<render::Gamepad> gamepad;                  ///< in this frame; nothing without one
    const ProcessorWorkspace& processor;
    const ArmWorkspace& arm;
    const PlotWorkspace& plot;
    const PendingImport& import;
    std::vector<jobs::QueuedJob> queue; ///< in their order
    /// Bodies of the project's machine; null where its file names none.
    std::shared_ptr<const std::vector<geometry::SolidBody>> machine_solids;
    std::shared_ptr<const plan::SetUpResult> set_up; ///< of the last search; null before the first
    const std::optional<Diagnostic>&
        queue_problem; ///< why its file is not open; nothing: it is, or there is none
    std::shared_ptr<const StartCheck> start_check; ///< of ViewState::start; null before the first
    std::shared_ptr<const RunCheck> run_check;     ///< of what Run would start now; null while not known
    std::shared_ptr<const RunCheck> next_check;    ///< the same of the next job of the queue
    const StockWorkspace& stock;                   ///< the simulation of material removal

    /// The connected controller moves an arm.
    [[nodiscard]] bool arm_connected() const {
        return connection.connected() && connection.row().kind == machine::MachineKind::arm;
    }
    /// `opened` is what is shown and moved, not the project's own program.
    [[nodiscard]] bool in_file() const;
    /// Of the motion that is shown, s; 0 without one.
    [[nodiscard]] double duration() const;
    /// In `opened`; nothing unless in_file() and it is read.
    [[nodiscard]] std::optional<FilePlace> file_place() const;

    /// Of the part on the table that is marked: chosen on the map, else the best. Zero without a search.
    [[nodiscard]] toolpath::SetUpPlace set_up_place() const;

    /// Null-safe access to what is shown.
    [[nodiscard]] std::shared_ptr<const plan::Evaluation> shown() const;
    /// What is shown is the path of a strategy, not a grid's zigzag.
    [[nodiscard]] bool shows_own_path() const;
    /// "Spiral", "Track optimiser".
    [[nodiscard]] std::string shown_name() const;
    /// Where the part is on the table: "part at 0, 0, 50 mm"; empty without a machine.
    [[nodiscard]] std::string part_place() const;
    /// What the program follows; null if not there.
    [[nodiscard]] std::shared_ptr<const plan::Evaluation> program_path() const;
    [[nodiscard]] std::shared_ptr<const plan::Evaluation> evaluation(project::GridMethod method) const;
    [[nodiscard]] std::shared_ptr<const motion::Trajectory> trajectory() const;
    [[nodiscard]] std::shared_ptr<const program::Program> program() const;
    /// What is shown before the arm, by ArmPathChoice::of_file.
    [[nodiscard]] ProgramOfMachine arm_program() const;
    /// Of the project's own program.
    [[nodiscard]] std::shared_ptr<const program::Listing> listing() const;
    /// Whether that is of the project as it is now, not as it was before the last change.
    [[nodiscard]] bool program_is_current() const;
    /// That, and no better one is to come.
    [[nodiscard]] bool program_is_final() const;
    /// How the project's program gouges the part, or that this is not known yet, as a sentence; empty if it
    /// does not.
    [[nodiscard]] std::string gouge_warning() const;
    /// Of the plan: why it stops short of a program; empty if it does not.
    [[nodiscard]] std::string failure() const;
    /// A question or a message is shown over everything else; only the machine listens to keys meanwhile.
    [[nodiscard]] bool asks() const {
        return view_state.file_prompt != FilePrompt::none || view_state.replacing ||
               view_state.dialogs.gouges || view_state.start || view_state.help != HelpPage::none ||
               view_state.dialogs.quit || !leaving_to.empty() || !left_behind.empty() ||
               !broken_jobs->empty();
    }
    [[nodiscard]] bool changed() const { return !(project == document.saved); }
    /// Whose axes are shown: of the opened file's choice, or the project's. Null before there is one.
    [[nodiscard]] std::shared_ptr<const kinematics::MachineModel> machine() const;
    /// The connected machine has other axes than machine(): its bodies are not those of machine().
    [[nodiscard]] bool draws_another_machine() const;
    /// Where the connected machine stands, in the axes of machine(); empty outside of the Machine workspace,
    /// or where its axes are others.
    [[nodiscard]] kinematics::AxisPositions connected_axes() const;
    /// The block that is being executed, stepped or scrubbed, and where on the tool path that is. Follows the
    /// running job, else the playback.
    [[nodiscard]] std::optional<viewport::Moment> moment() const;
    [[nodiscard]] int block() const;       ///< -1 without a program
    [[nodiscard]] double time() const;     ///< s of the trajectory
    [[nodiscard]] double job_time() const; ///< the same, of the job that was last reported
    /// The last job came from what is shown; another one may have come from the queue.
    [[nodiscard]] bool job_is_shown() const;
    /// It runs, and timeline, listing and drawing go with it.
    [[nodiscard]] bool follows_job() const;
    /// Where the tool of an XYZ table is that the shown plot is played to, or where it was left, mm.
    [[nodiscard]] std::optional<Vec3> table_tip() const;
    /// What moment() says is where the machine stands, not what the timeline would have it do.
    [[nodiscard]] bool at_machine() const;

private:
    [[nodiscard]] std::optional<viewport::Moment> moment_of_program() const;
    [[nodiscard]] std::optional<int> job_line() const; ///< that is executed, or would be
    [[nodiscard]] std::optional<double> time_at_line(int line) const;
};

} // namespace millwright::actions
