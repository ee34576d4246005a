// What stands behind the window: project history, pipeline, job, view state, document. One per program; the
// app builds it and hands it to the window. Everything that changes passes through perform().
#pragma once

#include "core/project/autosave.h"
#include "core/project/window_settings.h"
#include "ui/actions/action.h"
#include "ui/workspaces/machine_solids.h"
#include "ui/workspaces/run_check.h"
#include "ui/workspaces/stored_queue.h"

#include <chrono>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace millwright::actions {

class SurfaceExport;
struct ArmFileMotion;
enum class ProcessorSource : std::uint8_t; // processor_workspace.h

struct AppOptions {
    std::filesystem::path assets;     ///< what ships with the program
    std::filesystem::path log_folder; ///< of jobs
    std::filesystem::path settings;   ///< of the recent files; colours and window beside it; empty: keep none
    std::filesystem::path recovery;   ///< folder of the copies of unsaved work; empty: keep none
    std::function<void()> wake;       ///< from any thread: draw a frame
    std::optional<project::Project> start = {}; ///< the project to begin with; empty: the sample
    std::chrono::milliseconds autosave_interval = std::chrono::seconds(3); ///< between two copies
};

class AppController {
public:
    explicit AppController(AppOptions options);
    AppController(const AppController&) = delete;
    AppController& operator=(const AppController&) = delete;
    /// Leaves a copy of unsaved work behind unless close() was called.
    ~AppController();

    [[nodiscard]] const Catalogue& catalogue() const { return catalogue_; }
    /// For one frame; valid until the next call of a member that is not const.
    [[nodiscard]] FrameState look() const;

    /// From now on, and at later starts; nothing: the theme's. Throws Error where that cannot be kept.
    void choose_color(render::LayerColor which, const std::optional<glm::vec3>& color);

    /// Carries out what was asked; what an Error says becomes a notice and changes nothing.
    /// `focused`: the window has the keyboard; without it no jog goes on.
    void perform(ActionQueue& asked, bool focused = true);
    void run(std::string_view id);

    /// Lets `seconds` of wall time pass for what plays. True if the picture changed.
    bool advance(double seconds);

    /// A project file opens in place of the project, whatever is unsaved; undo goes back. A surface of
    /// another program becomes the pending import, a plot beside the surface; any other file is taken for
    /// G-code and opens beside the project. Throws Error; what is open then stays.
    void open(const std::filesystem::path& file);
    /// Files from outside of the window, dropped on it or named on the command line: opens the first one as
    /// soon as nothing asks the person, and says which of several that is.
    void receive(const std::vector<std::filesystem::path>& files);
    /// Throws Error; the old file then stays as it was. Goes on with what waited for it. Asks first, by
    /// ViewState::replacing, if the project's file is not what was read or saved there last.
    void save(const std::filesystem::path& file);
    /// Writes the project's program where it was written last, and asks for a file the first time. Asks, as
    /// save() does, if something else is there now; and before, by OpenDialogs::gouges, if it gouges the
    /// part. Throws Error.
    void write_program();
    /// The answer to OpenDialogs::gouges: it is written. Throws Error.
    void write_gouging_program();
    /// To a file that a person named. Throws Error.
    void write_program(const std::filesystem::path& file);
    /// The answers to ViewState::replacing: replaces the file; gives up what is unsaved for what is there now
    /// (undo goes back); asks for another file; leaves everything as it is. Throw Error.
    void replace();
    void reload();
    void write_elsewhere();
    void keep_file();
    /// Reads the opened G-code file once more, by the rules and for the machine of the view state.
    void read_again();
    void close_file();
    /// For the part's best place on the table, as the view state says, in the background.
    void search_set_up();
    /// Puts the part at the marked place.
    void accept_set_up();
    /// Stops whatever works in the background.
    void cancel_work();
    void new_from_preset(std::string_view preset_id);

    /// The machine that is connected, or not.
    [[nodiscard]] JobRunner& jobs() { return *jobs_; }
    [[nodiscard]] MachineConnection& connection() { return *connection_; }
    /// To the machine that the view state names.
    void connect();
    /// Before a frame is drawn: stops a jog that can no longer be held. `held`: a mouse button, a key or a
    /// bumper of the jog is down.
    void watch_jog(bool held, bool focused);
    /// As it is in this frame; nothing where none is connected.
    void see_gamepad(const std::optional<render::Gamepad>& gamepad) { gamepad_ = gamepad; }
    [[nodiscard]] const std::optional<render::Gamepad>& gamepad() const { return gamepad_; }
    /// A jog is held: frames have to come, lest its dead man stops it.
    [[nodiscard]] bool jogging() const { return jog_->moving(); }

    /// Does `then` at once if nothing is unsaved, else after the person has answered. `to` goes on after
    /// "before you": "open sine.json".
    void leave(std::string to, ActionQueue::Request then);
    /// Ends the program, once that is answered.
    void quit();
    /// The answers. Saving asks for a file where there is none yet, and goes on once it is saved.
    void save_and_leave();
    void discard_and_leave();
    void stay();

    /// Makes the newest work that was left behind the project. Throws Error if it cannot be read.
    void recover();
    /// Removes it.
    void discard_left_behind();
    /// Keeps it for the next start.
    void leave_left_behind();

    /// Of the newest job that was broken off: opens its program and sets up a run from the line that comes
    /// next. Nothing moves. Throws Error if it cannot be opened.
    void continue_broken_job();
    /// Of jobs that wait for a person's word.
    [[nodiscard]] StoredQueue& queue() { return queue_; }
    /// Shows a person what the job would do on the connected machine. Nothing moves before "start.go".
    void ask_to_start(StartWish wish);
    /// Opens the program of a job that waits, and gives it to the job once it is read, made for the machine
    /// that is connected then. Nothing moves. Throws Error if it cannot be opened.
    void open_queued(jobs::QueuedJobId id);
    [[nodiscard]] JobRecovery& job_recovery() { return *job_recovery_; }

    /// The good end: no copy of unsaved work stays, and the next start begins with what the window kept.
    void close();
    /// Writes what the next start of the window begins with.
    void keep_window_settings();

    void edit(const std::string& title,
              const std::function<void(project::Project&)>& change,
              const std::string& merge_key);
    void end_step() { history_.close_step(); }
    /// Takes back the step that edits with this `merge_key` still join; nothing where there is none.
    void revert_step(const std::string& merge_key);
    [[nodiscard]] Drag& drag() { return drag_; }

    [[nodiscard]] StockWorkspace& stock() { return *stock_; }
    [[nodiscard]] ArmWorkspace& arm() { return *arm_; }
    /// The drawn arm does it, or the connected one. Throws Error with the reason where it cannot.
    void play_on_arm(const motion::Trajectory& motion);
    void play_on_arm(ArmFileMotion motion);
    /// Gives a program in the card's language to the connected card, which runs it at once. `duration`: s, 0
    /// where it is not known; `ends`: of each line, empty where they are not. Throws Error.
    void run_on_card(const std::vector<std::string>& lines, double duration, std::vector<double> ends);
    /// Draws the arm of a file of one's own in place of the present one. Throws Error with what is wrong in
    /// it.
    void open_arm(const std::filesystem::path& file);
    /// Lines and arcs of the tool from where the arm stands. Throws Error with the line of what is wrong.
    void play_motion_file(const std::filesystem::path& file);
    /// The motion file of the project, from the home of the thesis on: the drawn arm alone. Throws Error.
    void simulate_motion_file();
    /// The same by the motors of an emulated card, which gets its points through its dual-ported RAM. Throws
    /// Error.
    void stream_motion_file();
    /// The same from where the arm stands: the drawn arm, or the connected one. Throws Error.
    void play_motion_text();
    /// The motion file as a file of its own, and the points and joints of it from the home of the thesis on,
    /// as `millwright arm simulate` writes them. Each throws Error and ends the prompt.
    void open_motion_file(const std::filesystem::path& file);
    void save_motion_file(const std::filesystem::path& file);
    void save_motion_result(const std::filesystem::path& file);
    /// Sends a file of settings to the card, and tells what is dangerous or refused in it. Throws Error.
    void load_card_settings(const std::filesystem::path& file);
    /// Points and programs of the arm as files of their own. Each throws Error and ends the prompt.
    void open_points(const std::filesystem::path& file);
    void save_points(const std::filesystem::path& file);
    void open_motion_program(const std::filesystem::path& file);
    void save_motion_program(const std::filesystem::path& file);
    [[nodiscard]] PlotWorkspace& plot() { return *plot_; }
    [[nodiscard]] PendingImport& import() { return *import_; }
    /// A surface of another program or a file of points becomes the pending import, whatever else files of
    /// that name are. Throws Error where there is no such file.
    void open_surface(const std::filesystem::path& file);
    /// The pending import becomes the project's surface.
    void take_import();
    /// Writes the surface for another program, in the background. Throws Error for an end of the name that
    /// stands for no such kind of file.
    void export_surface(const std::filesystem::path& file);
    /// Writes the program of the plot beside it as soon as there is one; `to_machine`: and opens it there.
    void write_plot(bool to_machine);
    /// Where its program would be written.
    void write_plot_path();
    void write_plot_points();
    [[nodiscard]] ProcessorWorkspace& processor() { return *processor_; }
    /// Compiles the program that is chosen there. What is wrong with it is shown there.
    void load_processor(ProcessorSource source);
    /// Assembler text, an image, a microprogram as files of their own; opened ones go into the editors and
    /// are executed. Each throws Error and ends the prompt.
    void open_assembler(const std::filesystem::path& file);
    void save_assembler(const std::filesystem::path& file);
    void save_image(const std::filesystem::path& file); ///< of the program that is executed
    void open_microprogram(const std::filesystem::path& file);
    void save_microprogram(const std::filesystem::path& file);
    /// The program that is executed becomes assembler text, to be changed there.
    void take_over_assembler();
    /// The processor's own microprogram becomes one of the project's, to be changed there.
    void start_microprogram();

    [[nodiscard]] ViewState& view_state() { return view_state_; }
    /// Blocks until nothing runs in the background (tests, pictures).
    void wait_idle();

private:
    /// Waits for an answer about unsaved changes.
    struct Leaving {
        std::string to;
        ActionQueue::Request then;
    };

    [[nodiscard]] Document& document() {
        return documents_[static_cast<std::size_t>(history_.project_number())];
    }
    [[nodiscard]] const Document& document() const {
        return documents_[static_cast<std::size_t>(history_.project_number())];
    }
    [[nodiscard]] bool changed() const { return !(history_.current() == document().saved); }
    /// The document of recovered work: what stands in its file, and whether it was there when the copy was
    /// made.
    [[nodiscard]] static Document document_of(const project::UnsavedWork& work);
    void put_project(const std::filesystem::path& whole);
    void begin(project::Project other, const std::string& title, Document document);
    void look_at_another();
    void play_again(const jobs::JobStory& story);
    void open_gcode(const std::filesystem::path& file);
    [[nodiscard]] std::shared_ptr<const plan::OpenedProgram> opened() const; ///< FrameState::opened
    void follow_file();
    void follow_received();
    void open_plot(const std::filesystem::path& file);
    void follow_import();
    void follow_plot();
    /// Starts the program from its beginning, whether it is looked at or not.
    void rewind(Played program);
    void finish_writing_plot();
    void remember(const std::filesystem::path& file);
    [[nodiscard]] std::filesystem::path colors_file() const;
    void read_colors();
    void read_window_settings();
    void start_autosave();
    void follow_autosave();
    void follow_project();
    void want_plan(); ///< what of it is looked at
    // What follows from the state at the beginning of a frame.
    void follow_job(const FrameState& now);
    void follow_begin(const FrameState& now);
    void follow_run(const FrameState& now);
    void follow_next(const FrameState& now);
    void follow_queue(const FrameState& now);
    [[nodiscard]] bool follow_processor(double seconds);
    void open_processor_text(const std::function<void()>& open);
    void write_assembler(const std::string& title, const std::string& text);
    void write_microprogram(const std::string& title, const std::string& text);
    [[nodiscard]] bool follow_arm(const FrameState& now, double seconds);
    void follow_arm_work(const FrameState& now);
    void guarded(const std::function<void()>& action);

    AppOptions options_;
    Catalogue catalogue_;
    project::History history_;
    ViewState view_state_;
    Drag drag_;
    std::vector<Document> documents_; ///< by project number of the history
    project::RecentFiles recent_;
    project::WindowSettings kept_settings_; ///< as they are in their file
    std::optional<Leaving> leaving_;
    std::optional<std::filesystem::path> received_; ///< waits until nothing is asked
    std::vector<project::LeftBehind> left_behind_;
    std::optional<Document> kept_; ///< what the autosave was last given: the file, the unsaved state
    std::unique_ptr<project::Autosave> autosave_; ///< null if no copies are kept
    std::unique_ptr<plan::Pipeline> pipeline_;
    std::unique_ptr<plan::ProgramReader> reader_;
    std::unique_ptr<plan::SetUpWorker> set_up_;
    std::unique_ptr<StockWorkspace> stock_; ///< never null
    MachineSolids machine_solids_;
    StoredQueue queue_;                             ///< before the jobs that it hears of
    std::unique_ptr<MachineConnection> connection_; ///< before what runs on it
    std::unique_ptr<HoldToRunJog> jog_;
    std::unique_ptr<ProcessorWorkspace> processor_; ///< never null
    std::unique_ptr<ArmWorkspace> arm_;             ///< never null
    std::unique_ptr<PlotWorkspace> plot_;
    std::unique_ptr<PendingImport> import_; ///< never null
    std::unique_ptr<SurfaceExport> export_; ///< never null
    std::unique_ptr<JobRunner> jobs_;
    std::unique_ptr<ApproachFinder> approach_;
    std::unique_ptr<StartChecker> start_;
    std::unique_ptr<RunChecker> run_check_, next_check_;
    std::shared_ptr<const RunWish> run_wish_;  ///< null while nothing could be run
    std::shared_ptr<const RunWish> next_wish_; ///< null while no job of the queue could be run
    std::unique_ptr<JobRecovery> job_recovery_;
    std::optional<render::Gamepad> gamepad_;
    std::optional<jobs::QueuedJobId> loading_; ///< waits for the program that is being read
    std::optional<bool> writes_plot_;          ///< its program is awaited: and goes to the machine
    /// The view was fitted to it.
    std::weak_ptr<const project::ImportSource> fitted_import_{};
    std::uint64_t followed_import_ = 0;                      ///< revision whose failure was reported
    std::shared_ptr<const plan::PlotProgram> followed_plot_; ///< the plot's program as it was last seen
    bool arm_failed_ = false;                                ///< the arm that ships could not be read
    std::optional<int> settings_sent_; ///< the card's answer to them is still to be reported
    bool tells_of_file_ = false;       ///< it is being read: how that ended is still to be reported
    bool follows_job_ = false;         ///< a job was running when it was last looked at
};

} // namespace millwright::actions
