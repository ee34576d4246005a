// A job on a controller that plans for itself, on the command line.
#pragma once

#include "app/command_line/watched_work.h"
#include "app/drivers/driver_options.h"
#include "app/drivers/job_terminal.h"
#include "core/base/clock.h"
#include "core/base/progress.h"
#include "core/drivers/driver.h"
#include "core/jobs/dispatcher.h"
#include "core/jobs/job.h"
#include "core/jobs/position_memory.h"
#include "core/jobs/program_check.h"

#include <functional>
#include <memory>
#include <optional>
#include <stop_token>
#include <string>
#include <vector>

namespace CLI {
class App;
class Option;
} // namespace CLI

namespace millwright::app {

/// What a person at the machine has allowed: --unlock, --trust-position, --power, --keep-power and --home.
struct Permissions {
    bool unlock = false;
    bool trust_position = false; ///< a person has looked: the machine stands where the controller says
    bool power = false;          ///< a person has looked: the motors may have power
    bool keep_power = false;     ///< and keep it afterwards; of a PMAC
    bool home = false;           ///< find the zero of every axis first
};

/// Which controller, and what the options --port, --one-by-one, --check, --check-only, --trace-box and --keys
/// say.
struct ControllerChoice {
    std::string driver = "grbl"; ///< or linuxcnc
    std::string port;
    std::string axes = "XYZ";       ///< of a LinuxCNC
    std::string arm = "motoman-l3"; ///< of a PMAC: a name or a file
    bool one_by_one = false;
    bool keys = false;       ///< of JobKeys also from an input that is no terminal
    bool check = false;      ///< the controller reads each job in its check mode before it runs
    bool check_only = false; ///< it does, and nothing runs
    bool trace_box = false;  ///< the box of the cuts in place of the job
    Permissions allowed;
    JobSwitches stops; ///< single block from the first block on
    ToolChangeChoice tool_change;
};

/// Adds these to `command`; returns --port.
CLI::Option& add_controller_options(CLI::App& command, ControllerChoice& choice);

/// Throws UsageError for a check or a trace of half a program, or of both at once.
void expect_one_way(const ControllerChoice& choice, int from_line);

/// A controller on which jobs are run one after another, over one connection.
class ConnectedController {
public:
    /// Makes no link yet. Logs, and doubts about positions, are in `log_folder`.
    ConnectedController(ControllerChoice choice, const std::string& log_folder);
    ConnectedController(const ConnectedController&) = delete;
    ConnectedController& operator=(const ConnectedController&) = delete;
    ~ConnectedController();

    /// Throws Error for what this controller must not be sent. To be called for each job before connect().
    void check(const jobs::Job& job);
    /// Asks a person at a terminal whether the position is right where something has cost it. Throws Error if
    /// there is no answer, or if the controller is locked and neither unlocking it nor homing it first, which
    /// moves it, was allowed; also if the machine lacks an axis of a job that was checked; `at_a_line`: also
    /// if the position that a job needs that begins there is in doubt. Nothing was unlocked or moved then.
    void connect(bool at_a_line, const std::stop_token& stop);
    /// Throws Error for what the connected machine could not do of it from its position; nothing moves.
    void look_at(const jobs::Job& job) const;
    /// Has the controller read it in its check mode, in which nothing moves. Throws Error with what it
    /// refuses.
    void check_there(const jobs::Job& job, const std::stop_token& stop);
    /// Says what a person should know, and runs the job to its end under a progress bar. Throws Error, before
    /// anything is sent if the text is at fault.
    [[nodiscard]] jobs::JobOutcome run(const jobs::Job& job, const Interrupt& interrupt);

private:
    void expect_rest() const;
    void say_modes(const jobs::Job& job) const;
    void expect_axes() const;
    void prepare(bool at_a_line, const std::stop_token& stop);
    void wait_for(const std::function<bool(const drivers::DriverStatus&)>& done, const std::stop_token& stop);
    void expect_unlock() const;
    void settle_position(bool at_a_line, const std::stop_token& stop);
    void ask_whether_position_is_right(const std::string& why, const std::stop_token& stop);
    void say_who_is_there() const;
    void remember();
    [[nodiscard]] jobs::Job box_of(const jobs::Job& job) const;
    [[nodiscard]] std::optional<jobs::ProgramCheck> program_check_of(const jobs::Job& job) const;
    void show_warnings(const jobs::Job& job) const;
    void say_what_is_left_out(const jobs::Job& job) const;
    void expect_keys(const jobs::Job& job) const;
    void say_what_is_not_measured(const jobs::Job& job) const;
    void expect_tool_changes(const jobs::Job& job) const;
    void ask_for_tool(const jobs::Job& job, const std::stop_token& stop) const;
    void check_joints(const jobs::Job& job, const std::stop_token& stop) const;

    ControllerChoice choice_;
    std::string log_folder_;
    jobs::PositionMemory memory_;
    SteadyClock clock_;
    std::unique_ptr<drivers::Driver> driver_;
    std::vector<jobs::Job> checked_; ///< the jobs that are to be run
};

/// Date and time for people.
[[nodiscard]] std::string now_for_people();

} // namespace millwright::app
