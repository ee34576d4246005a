// The host's side of a conversation with Grbl 1.1, grblHAL or FluidNC. One rule stands above all: once
// something is wrong, no byte leaves that could begin motion, until a person has asked for it.
#pragma once

#include "core/drivers/controller_session.h"
#include "core/drivers/grbl/internal/change_lines.h"
#include "core/drivers/grbl/internal/executed_line_tracker.h"
#include "core/drivers/grbl/internal/messages.h"
#include "core/drivers/grbl/internal/modes.h"
#include "core/drivers/grbl/internal/override_steps.h"
#include "core/drivers/grbl/internal/position_doubt.h"
#include "core/drivers/grbl/internal/program_lines.h"
#include "core/drivers/grbl/internal/window.h"
#include "core/drivers/host_stall.h"
#include "core/drivers/internal/jog_feed.h"
#include "core/drivers/internal/send_window.h"

#include <functional>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::drivers::grbl {

struct SessionSettings {
    bool one_by_one = false;    ///< simple protocol: each line waits for the answer to the last
    double poll_interval = 0.1; ///< s between questions for the status
    double patience = 2.0;      ///< s without a byte after which the controller counts as silent
    double greeting_time = 4.0; ///< s in which a controller has to greet; one with a boot loader takes two
};

/// What is known of the controller beyond DriverStatus.
struct Readout {
    GrblFirmware firmware = GrblFirmware::grbl;
    std::string version, build; ///< as 1.1h and 20190825
    std::string axes = "XYZ";   ///< letters, in the order of the positions
    std::map<int, double> settings;
    std::map<std::string, std::string> named;          ///< settings without a number, or whose value is none
    Axes machine_position = Axes(3), offset = Axes(3); ///< mm, of rotary axes degrees
    std::string pins;
    double spindle_rpm = 0.0; ///< as last reported
    std::optional<ProbeResult> probe;
    int probings = 0;                    ///< of programs and commands
    Modes modes;                         ///< at rest; of a running program only spindle and coolant
    std::map<std::string, Axes> offsets; ///< $#: G54 to G59, G28, G30, G92, TLO
    int planner_blocks = 15, segment_blocks = 6, buffer_bytes = 128;
    bool line_numbers = false;
    bool printable_realtime = true; ///< ? ! ~ act at once; false: 0x80, 0x82 and 0x81 alone do
    bool mist = false;              ///< built with M7
    bool began_anew = false;        ///< greeted, or was silent until it was reset, when the link was made
};

/// Why a controller in this state, one of those of MachineState that hold, goes no further; a sentence.
[[nodiscard]] std::string_view why_held(MachineState state);

class GrblSession final : public ControllerSession {
public:
    explicit GrblSession(SessionSettings settings = {}) : settings_(settings) {}

    void opened(double now) override;
    void lost(const std::string& why) override;
    void closed() override;
    void receive(std::string_view bytes, double now) override;
    void tick(double now) override;

    [[nodiscard]] DriverStatus status() const override;
    [[nodiscard]] const Readout& readout() const { return readout_; }
    [[nodiscard]] bool greeted() const override {
        return stage_ != Stage::greeting && stage_ != Stage::asking;
    }
    [[nodiscard]] bool link_lost() const override { return link_lost_; }
    [[nodiscard]] std::optional<Diagnostic> stranger() const override;

    /// `ahead` and `changes` as in Work.
    void start(ProgramLines program,
               double now,
               std::function<int(int)> ahead = {},
               std::optional<ToolChanges> changes = {});
    void hold(double now) override;
    void resume(double now) override;
    void stop(double now) override;
    void break_off(std::string why, double now) override;
    void emergency_stop(double now) override;
    void reset(double now) override;
    void trust_position() override { doubt_.confirm(); }
    void doubt_position(std::string why, bool lost) override { doubt_.arise(std::move(why), lost); }
    void home(double now) override;
    /// What this link did not begin is left alone.
    void leave(double now) override;
    void jog(const Jog& jog, double now) override;
    void stop_jog(double now) override;
    /// The number of the answer that DriverStatus will show.
    int command(ProgramLines lines, double now);
    /// The same of a program in check mode, in which nothing moves.
    int check(ProgramLines program, double now);
    void set_single_block(bool on);
    [[nodiscard]] internal::SendWindow* send_window() override { return &send_window_; }
    void set_overrides(const Overrides& wanted) override;

private:
    enum class Stage {
        closed,
        greeting, ///< is anybody there?
        asking,   ///< reset, then asked for version and settings
        foreign,  ///< it moved when the link was made: it may be held and stopped, nothing else
        ready,
        running,      ///< a program or a command
        asking_again, ///< after it: which modes are in force now?
        jogging,
        homing,
        braking,  ///< to rest, for good
        flushing, ///< at rest or cut off: the reset that empties its buffers is under way
        stopped,
        alarm
    };

    // What belongs to one of the things that a session does.

    /// Questions about the controller: after the greeting, and after whatever may have changed the answers.
    struct Asking {
        Stage then = Stage::ready;          ///< after those of asking_again; or stopped
        std::vector<std::string> questions; ///< the next comes last
        bool asked_more = false;            ///< what only some firmwares are asked
        bool told_sizes = false;            ///< [OPT:] named planner blocks and bytes
        bool unlock = false;                ///< after the questions
        std::string axis_letters;           ///< of [AXS:]
        std::string found_alarm;            ///< that it reports of itself when it is met
        std::string kept_lock;              ///< why it did not unlock
        std::string stray_line;             ///< what somebody said here who may be no Grbl
    };
    /// Why it brakes and flushes.
    struct Ending {
        bool in_fault = false;
        std::string message;
    };
    enum class HoldState { none, wanted, held }; ///< wanted: sent, and no report shows it yet
    struct Hold {
        HoldState state = HoldState::none;
        double sent = 0.0, resumed = -1.0; ///< s; negative: never
    };
    struct Jogging {
        bool stopping = false;
        bool refused = false;
        std::optional<double> until; ///< dead-man's time, s
        internal::JogFeed feed;
    };
    struct SingleBlock {
        bool on = false;
        bool waits = false; ///< the next line waits for resume()
    };
    /// What a work position that is reported counts from.
    struct WorkZero {
        bool reports_work = false; ///< its reports give work positions ($10)
        /// A change of the work offset was sent and no report has shown the new one: work positions may count
        /// from either.
        bool moves = false;
    };
    struct ToolLength {
        std::optional<double> reference_z; ///< where the first tool of the job touched the sensor
        bool reference_due = false, set = false;
        bool left = false; ///< a job ended with a length in force, and no answer has shown it gone
        /// A tool was changed since Z got its zero, which is not that of the tool in the spindle.
        bool zero_of_other = false;
    };
    struct Check {
        std::string modes_before; ///< a line that brings them back
        int lines = 0, refused = 0;
    };

    // grbl_session.cpp: commands and time
    void require_rest(std::string_view what) const;
    [[nodiscard]] const GrblFacts& facts() const { return facts_of(readout_.firmware); }
    [[nodiscard]] std::string name() const { return std::string(facts().name); }
    [[nodiscard]] char status_byte() const { return readout_.printable_realtime ? '?' : '\x80'; }
    [[nodiscard]] char resume_byte() const { return readout_.printable_realtime ? '~' : '\x81'; }
    [[nodiscard]] char hold_byte() const { return readout_.printable_realtime ? '!' : '\x82'; }
    void begin_asking(double now, bool unlock);
    void ask_first();
    void ask_next();
    void finish_asking(const StatusMessage& report);
    void doubt_what_was_found(const StatusMessage& report);
    void take_zeros();
    void send_reset(double now);
    void end(bool fault, std::string message, double now);
    void finish_ending(double now);
    void ask_again(Stage then, double now, const std::string& first = {});
    [[nodiscard]] std::string what_it_may_execute(bool in_program) const;
    void fail(const std::string& message, double now);
    void begin(ProgramLines program, Activity activity, double now);
    void finish(double now);
    void pump();
    [[nodiscard]] bool may_send(const ProgramLine& line) const;
    void pump_jog();
    void cancel_jog(double now);
    void step_overrides(double now);
    void poll(double now);
    void watch_silence(double now);
    void watch_ending(double now);
    void watch_hold(double now);
    void watch_jog(double now);
    void watch_answers(double now);
    [[nodiscard]] bool active() const;
    [[nodiscard]] bool waits_between_blocks() const;
    [[nodiscard]] internal::JogLimits jog_limits() const;
    [[nodiscard]] DriverState state() const;
    [[nodiscard]] Activity activity() const;
    void show_machine(DriverStatus& status) const;
    void show_program(DriverStatus& status) const;
    void show_change(DriverStatus& status) const;

    // grbl_session_messages.cpp: what the controller says
    void handle_line(std::string_view line, double now);
    void handle(const Ack&, double now);
    void handle(const ErrorAnswer& error, double now);
    void handle(const AlarmMessage& alarm, double now);
    void handle(const Welcome& welcome, double now);
    void handle(const StatusMessage& report, double now);
    void handle(const SettingMessage& setting, double now);
    void handle(const NamedSetting& setting, double now);
    void handle(const Feedback& feedback, double now);
    void handle(const StartupLine& line, double now);
    void handle(const Blank& blank, double now);
    void handle(const Garbage& garbage, double now);
    void take_readout(const StatusMessage& report, double now);
    void watch_state(const StatusMessage& report, double now);
    void watch_motion(const StatusMessage& report, double now);
    void watch_foreign(const StatusMessage& report, double now);
    void check_echo(std::string_view text, double now);
    void answered(const SentLine& line);
    void refused(const SentLine& line, const std::string& why, double now);
    [[nodiscard]] bool is_well_formed(const StatusMessage& report) const;
    [[nodiscard]] double report_unit() const;
    [[nodiscard]] Axes scaled(Axes axes) const;
    [[nodiscard]] double feed() const; ///< mm/s, as reported

    // grbl_session_check.cpp: check mode
    [[nodiscard]] bool checks() const;
    [[nodiscard]] bool leaves_check_mode() const;
    void refused_in_check(const SentLine& line, const std::string& why, double now);
    void finish_check(double now);

    // grbl_session_change.cpp: tool changes
    enum class ChangeStep {
        looking, ///< what is in force is asked for
        switching_off,
        waiting, ///< for a person, who has the machine
        first_touch,
        second_touch,
        lifting,
        setting_length,
        macro,
        going_back
    };
    /// A program that is laid aside, and where the machine was then.
    struct Change {
        ProgramLines program{};
        int next_line = 0;
        internal::SendWindow send_window{};
        int stop = -1; ///< of ToolChanges::stops; -1: the first tool is measured
        ChangeStep step = ChangeStep::looking;
        bool held = false;           ///< between two steps, or while it waits
        bool confirmed = false;      ///< a person goes on; the next report tells where the machine is
        bool made_reference = false; ///< its tool is the one that the others are compared with
        ModeWords modes{};
        Axes machine{}, zero{};                ///< position, and zero of its work system, machine coordinates
        std::map<std::string, Axes> offsets{}; ///< in force when it began
        double highest_z = 0.0;                ///< of the machine while it waited
        double top = 0.0;                      ///< of the way to the sensor
        double first_touch_z = 0.0;
        int probings = 0; ///< before the last lines
    };
    void begin_job(std::optional<ToolChanges> changes, ProgramLines& program);
    void take_tool_changes(ProgramLines& program) const;
    [[nodiscard]] const ToolStop& stop_at_hand() const;
    [[nodiscard]] bool waits_for_tool() const;
    [[nodiscard]] bool held_at_machine() const;
    [[nodiscard]] std::string zero_set_anew() const;
    [[nodiscard]] std::string why_not_on() const;
    [[nodiscard]] std::string what_to_do() const;
    [[nodiscard]] bool stops_here() const;
    void watch_change(double now);
    void begin_change(double now);
    void take_program_back();
    [[nodiscard]] bool has_tool_length() const;
    [[nodiscard]] Axes work_zero(const std::map<std::string, Axes>& offsets) const;
    void send_own(const ChangeLines& lines, ChangeStep step, double now);
    void go_on_changing(double now);
    void tool_is_changed(double now);
    [[nodiscard]] ChangeLines macro_lines() const;
    void begin_measuring(double now);
    void go_on_measuring(double now);
    [[nodiscard]] WayBack planned_way_back() const;
    [[nodiscard]] double lacking_height(double travel_top) const;
    [[nodiscard]] std::string why_no_way_back(WayBack& way) const;
    void go_back(double now);
    void resume_program(double now);
    void drop_change();

    // grbl_session_identity.cpp: who answers, and what it has
    void identify(const GrblIdentity& who);
    [[nodiscard]] bool ask_more(double now);
    void take_axis_count(std::size_t count);
    void take_feedback(const Feedback& feedback);
    void read_options(std::string_view text);
    void read_new_options(std::string_view text);
    void read_axis_letters(std::string_view text);

    SessionSettings settings_;
    Stage stage_ = Stage::closed;
    Readout readout_;
    std::string input_;
    bool link_lost_ = false;
    PositionDoubt doubt_;

    ProgramLines program_;
    ExecutedLineTracker tracker_;
    bool proof_closed_ = false; ///< the controller forgot what it had acknowledged
    Window window_;
    int next_line_ = 0;
    bool sent_alone_ = false; ///< the line under way: nothing follows it before its answer
    WorkZero zero_;
    internal::SendWindow send_window_;
    Asking asking_;
    std::string message_;

    Ending ending_;
    double ending_since_ = 0.0;
    int rest_reports_ = 0;    ///< in a row
    int idle_unanswered_ = 0; ///< reports since the last answer to a line, all of them idle
    int spare_welcomes_ = 0;  ///< that repeated resets may still bring
    int resets_due_ = 0;      ///< greetings that our resets will bring

    Hold hold_;
    Jogging jogging_;
    Activity at_ = Activity::none; ///< program or command, the current or last
    SingleBlock single_block_;
    CommandAnswer answer_;
    Check check_;

    std::optional<ToolChanges> changes_;
    std::optional<Change> change_; ///< under way
    std::vector<std::string> own_lines_;
    std::map<std::string, Axes> offsets_at_start_; ///< of the job
    ToolLength tool_length_;

    std::optional<StatusMessage> report_; ///< the last
    HostStall host_stall_;
    double last_heard_ = 0.0, last_answer_ = 0.0, next_poll_ = 0.0, last_reset_ = 0.0, last_brake_ = 0.0;
    OverrideSteps overrides_;
};

} // namespace millwright::drivers::grbl
