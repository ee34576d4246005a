// The host's side of a conversation with a PMAC. What is claimed, and what ends motion when:
// docs/reference/pmac.md.
#pragma once

#include "core/drivers/controller_session.h"
#include "core/drivers/host_stall.h"
#include "core/pmac/driver/internal/following_watch.h"
#include "core/pmac/driver/internal/guard_watch.h"
#include "core/pmac/driver/internal/guarded_line.h"
#include "core/pmac/driver/internal/motor_readings.h"
#include "core/pmac/driver/internal/steady_speed.h"
#include "core/pmac/driver/internal/typed_buffer.h"
#include "core/pmac/driver/pmac_settings.h"

#include <cstdint>
#include <deque>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::pmac::internal {

constexpr int most_motors = 8; ///< of a card

class PmacSession final : public drivers::ControllerSession {
public:
    explicit PmacSession(PmacSettings settings)
        : settings_(std::move(settings)), talk_(settings_.patience), readings_(settings_.axes),
          motors_(settings_.axes.size()), following_(settings_.axes.size()),
          own_jog_speeds_(settings_.axes.size()) {}

    void opened(double now) override;
    void lost(const std::string& why) override;
    void closed() override;
    void receive(std::string_view bytes, double now) override;
    void tick(double now) override;
    [[nodiscard]] std::string take_output() override;
    [[nodiscard]] std::vector<drivers::ConsoleLine> take_console() override;

    [[nodiscard]] drivers::DriverStatus status() const override;
    [[nodiscard]] bool greeted() const override { return stage_ != Stage::greeting; }
    [[nodiscard]] bool link_lost() const override { return link_ == Link::lost; }
    [[nodiscard]] std::optional<Diagnostic> stranger() const override;

    /// Writes the motion program `lines` and runs it.
    void start(const std::vector<std::string>& lines, double now);
    void hold(double now) override;
    void resume(double now) override;
    void stop(double now) override;
    void emergency_stop(double now) override;
    void leave(double now) override;
    /// What a person should know after leave(); "": by PmacSettings::parting, and the card has told so.
    [[nodiscard]] const std::string& farewell() const { return farewell_; }
    [[nodiscard]] bool any_power() const;
    void reset(double now) override;
    void home(double now) override;
    /// A held one (dead_man) ends at the border of what it may: it is renewed again and again from where the
    /// motors are. A step that would end beyond it is refused whole.
    void jog(const drivers::Jog& jog, double now) override;
    void stop_jog(double now) override;
    /// Lines of a file of settings. Throws Error while a motor has power.
    int load(const std::vector<std::string>& lines);
    /// Lines of on-line commands; `all`: also those behind a refused one. Without `all` lines of a buffer
    /// that is not closed yet are kept, and sent with its CLOSE. While motors move, only lines that ask or
    /// stop, which during a program, a jog and homing do what stop() does; taking power away is an alarm
    /// then. Throws Error for anything else, and for jogs without an end and open loops. In an alarm only
    /// variables are set, besides lines that ask, kill or disable PLC programs.
    int command(const std::vector<std::string>& given, bool all);
    /// Lines that wait for the CLOSE of their buffer, from its OPEN on.
    [[nodiscard]] const std::vector<std::string>& kept_lines() const { return typed_.kept(); }
    void set_overrides(const drivers::Overrides& wanted) override;
    /// Closes the loops of the motors where they stand: the one way back from a kill.
    void enable(double now);
    void set_parting(Parting parting) { settings_.parting = parting; }
    /// From now on lines of command() may give it, too: a person has looked.
    void let_lines_give_power() { lines_may_power_ = true; }

    /// Every motor has found its zero since the card started.
    [[nodiscard]] bool position_known() const;
    [[nodiscard]] bool enabled() const;
    /// By the card's I-variables; what it has not reported yet is missing.
    [[nodiscard]] std::vector<drivers::MachineLimits::Axis> limits() const { return readings_.limits(); }
    /// As MotorReadings; nothing while the card is being asked again.
    [[nodiscard]] std::optional<std::vector<std::string>> protections_off() const;

private:
    static constexpr int patient_polls = 25; ///< half a second

    enum class Stage {
        closed,
        greeting,
        ready,
        loading,
        running,
        commanding,
        moving_by_command, ///< a command set motors going
        jogging,
        homing,
        stopping,
        stopped,
        parting, ///< killed, and that has to be seen before the link is dropped
        alarm
    };
    enum class Kind {
        greet,
        poll,
        rating,
        reading,
        watch,
        jog_speeds,
        step,
        run,
        program,
        command,
        address,
        definitions ///< of the axes of all motors, after a run was refused
    };

    enum class Link { silent, heard, lost }; ///< since it was opened

    struct Request {
        std::string line;
        Kind kind = Kind::step;
        std::size_t axis = 0; ///< of a rating
        int tries = 0;        ///< in which it did not come as it was sent
    };
    struct MotorState {
        double counts = 0.0, last_counts = 0.0, speed = 0.0; ///< counts/s, by the last two positions
        SteadySpeed shown_speed{};
        std::uint32_t word_1 = 0, word_2 = 0;
        double target = 0.0;          ///< of the last jog
        bool had_power = false;       ///< since what is under way began
        bool gets_power = false;      ///< by the command that is under way
        bool was_given_power = false; ///< by that command, until what it set going is over
        bool lag_is_old = false; ///< left_behind() was so when the card told for the first time, and since
        [[nodiscard]] bool enabled() const { return (word_2 >> 14 & 1U) != 0; }
        [[nodiscard]] bool faulty() const { return (word_2 >> 3 & 1U) != 0; } ///< its amplifier
        [[nodiscard]] bool left_behind() const { return (word_2 >> 2 & 1U) != 0; }
        [[nodiscard]] bool home() const { return (word_2 >> 10 & 1U) != 0; }
        [[nodiscard]] bool searching() const { return (word_1 >> 10 & 1U) != 0; }
        [[nodiscard]] bool in_place() const { return !enabled() || (word_2 & 1U) != 0; }
        [[nodiscard]] bool standing() const { return !enabled() || (word_1 >> 13 & 1U) != 0; }
    };

    // What belongs to one of the things that a session does, each from its own begin on.

    /// The order of questions and answers.
    struct Exchange {
        bool buffer_open = false; ///< nothing may be asked meanwhile
        bool asked_poll = false;  ///< by the last line
        bool look_first = false;  ///< before anything is sent again that moves: the card may have been reset
    };
    /// The watchdog in the card, which stops the motors when it does not hear us.
    struct CardWatchdog {
        bool armed = false;
        bool mark_is_ours = false; ///< P1000 was set back since it was armed
        bool stays_armed = false;  ///< at rest, too: something in the card may begin motion without a command
    };
    /// What may give motors their power, since the link was made.
    struct PowerSources {
        bool found = false;    ///< some motor has had power since before
        bool given = false;    ///< to some motor, by a request
        bool plcs_run = false; ///< other PLC programs than the guard may, as far as is known
    };
    /// The program that is loaded or runs, or the last one.
    struct ProgramRun {
        int lines = 0, executed = 0;
        bool marks_tell = false; ///< lines are executed in their order
        bool held = false;
    };
    struct Jogging {
        std::optional<double> until; ///< dead-man's time, s
        bool stopping = false;
    };
    struct Homing {
        std::size_t axis = 0;
        double from = 0.0;      ///< counts
        bool backs_off = false; ///< to the side of its flag from which a motor finds it
    };
    struct Braking {
        std::optional<double> by; ///< s; the motors lose their power then
        bool due = false;         ///< which motors move is not known yet
    };
    /// The link is going to be dropped.
    struct Leaving {
        std::optional<double> kill_by{}; ///< once it was killed, s; then a kill counts as unseen
        int quiet_reports = 0;           ///< in which no motor had power, behind the last kill
    };
    /// Lines that a person gave, until the last is answered; or the last ones.
    struct Command {
        std::deque<std::string> lines; ///< to be sent yet
        std::string opened_by;         ///< the line of theirs that opened the buffer
        std::string text;              ///< all lines
        std::vector<double> from;      ///< counts of each motor when it was given
        bool goes_on = false;          ///< behind a refused line
        bool refused = false;          ///< a line of it, and it went on
        bool closes_loops = false;
        bool only_sets = false; ///< variables: nothing moves
    };

    // pmac_session.cpp: the conversation
    void greet(double now);
    void make_guard(const std::vector<std::string>& servo_time);
    void ask(std::string line, Kind kind = Kind::step) { queue_.push_back({std::move(line), kind, 0}); }
    void handle(const GuardedLine::Reply& reply, double now);
    void refused(const Request& request, int error);
    void refused_command(const Request& request, bool loop_is_open, const std::string& why);
    void answered(const Request& request, const std::vector<std::string>& lines, double now);
    [[nodiscard]] static std::string asked(const Request& request);
    void next_command();
    [[nodiscard]] bool is_step(const std::string& line) const;
    void finish_command(drivers::CommandAnswer::State state);
    [[nodiscard]] std::string poll_line() const;
    void ask_ratings();
    void ask_something(double now);
    [[nodiscard]] bool shows_life(const Request& request) const;
    void watch_time(double now);
    void arm();
    void tell(bool sent, drivers::ConsoleKind kind, std::string text);
    [[nodiscard]] static bool is_ours(Kind kind);
    [[nodiscard]] bool may_repeat(Kind kind) const;

    // pmac_watch.cpp: what the card tells
    void read_poll(const std::vector<std::string>& lines, double now);
    void watch(double now);
    void watch_motors();
    void watch_killed();
    void watch_power();
    void watch_guard();
    void watch_following(double now);
    void watch_way_home();
    void watch_limits();
    void watch_zone();
    void watch_rest();
    [[nodiscard]] std::vector<double> axes_deg() const;
    /// `now`: of what is under way alone; a motor that was killed before tells its old one.
    void watch_own_stop();
    [[nodiscard]] std::string reason_of_kill(bool now) const;
    /// As a person knows it: the arm's joint, or the axis.
    [[nodiscard]] std::string name_of(std::size_t axis) const;

    // pmac_stages.cpp: how what is under way goes on and ends
    [[nodiscard]] bool standing() const;
    void watch_stage();
    void watch_program(bool stands);
    void watch_homing();
    void watch_stopping();
    void rest();
    [[nodiscard]] std::string off_target_sentence() const;
    [[nodiscard]] bool at_limit(std::size_t n) const;
    [[nodiscard]] std::string limit_sentence() const;
    [[nodiscard]] std::string commanded_limit() const;
    [[nodiscard]] std::string unheard() const;
    void finish(Stage stage, std::string why = {});
    void fail(std::string why);
    void kill();
    void forget_all();

    // pmac_parting.cpp: before the link is dropped
    [[nodiscard]] bool takes_power() const;
    void part(double now);
    void watch_parting();
    void switch_plcs_off();

    // pmac_requests.cpp: what a person wants
    [[nodiscard]] bool active() const;
    [[nodiscard]] bool rests() const; ///< nothing of ours is under way
    void halt();
    void brake();
    void forget_queue();
    void home_axis(std::size_t axis);
    void require_rest(std::string_view what) const;
    void require_enabled(std::string_view what) const;
    [[nodiscard]] std::string every_motor(std::string_view command) const;

    // pmac_jogs.cpp
    void jog_axis(std::size_t axis, double target, double speed_deg_per_s);
    void let_go_of(std::size_t axis);
    void halt_jog();
    [[nodiscard]] std::string leaves_limits(const std::vector<double>& from,
                                            const std::vector<double>& targets) const;
    [[nodiscard]] double share_within(const std::vector<double>& from, const std::vector<double>& way) const;
    void set_jog_speed(std::size_t axis, double counts_per_ms);
    void slow_down(const std::vector<std::string>& jog_speeds);
    void give_jog_speeds_back();
    [[nodiscard]] double most_jog_speed(std::size_t axis) const;

    // pmac_commands.cpp: lines that are typed, or of a file
    void check_command(const std::vector<std::string>& lines) const;
    static void check_guard(const std::string& line);
    static void check_stays_in_buffer(const std::string& line);
    void check_goals(const std::vector<std::string>& lines) const;
    void check_open(const std::vector<std::string>& lines) const;
    void check_buffers(const std::vector<std::string>& lines) const;
    void check_programs(const std::vector<std::string>& lines, bool file) const;
    bool acted_on_key(const std::vector<std::string>& given);
    void skip_buffer();
    void keep_until_close(const std::vector<std::string>& lines);
    void begin_command(const std::vector<std::string>& lines, bool all);
    bool stopped_by_command(const std::vector<std::string>& lines);
    [[nodiscard]] std::optional<std::size_t> given_power(const std::vector<std::string>& lines) const;
    bool brakes_instead(const std::vector<std::string>& lines);

    // pmac_status.cpp: in the words of the Driver interface
    [[nodiscard]] drivers::DriverState state() const;
    [[nodiscard]] drivers::Activity activity() const;
    [[nodiscard]] int sent_lines() const;
    void ask_whose_loop_is_open(const std::string& refusal);
    void explain_open_loop(const std::string& sentence);
    [[nodiscard]] std::string loop_advice(const std::vector<std::string>& definitions) const;

    PmacSettings settings_;
    GuardedLine talk_;
    Stage stage_ = Stage::closed;
    std::vector<drivers::ConsoleLine> told_;
    std::string message_;
    Link link_ = Link::silent;
    bool unseen_ = false; ///< silent since the last report: what it reported is old

    std::deque<Request> queue_;
    std::optional<Request> sent_;
    drivers::HostStall host_stall_;
    double next_poll_ = 0.0, next_reading_ = 0.0, greet_at_ = 0.0, opened_at_ = 0.0;
    std::size_t greet_step_ = 0;
    std::string greeting_heard_{}; ///< before the first question
    Exchange exchange_;
    bool polled_ = false;

    MotorReadings readings_;
    std::vector<MotorState> motors_;
    FollowingWatch following_;
    GuardWatch guard_;
    double polled_at_ = 0.0, read_at_ = 0.0;
    std::uint32_t system_1_ = 0, system_2_ = 0;
    double mark_ = 0.0; ///< P1000, which programs and the watchdog set

    ProgramRun run_;
    std::string run_refusal_{}; ///< until the card has reported whose loop is open
    CardWatchdog watchdog_;
    int quiet_polls_ = 0;
    int off_target_polls_ = 0; ///< a motor stands where it was not sent
    int power_polls_ = 0;      ///< for which power that was given is still waited for
    bool unexplained_ = false; ///< a motor was killed, and the card has not reported yet by what
    bool was_home_ = false;    ///< to tell when the card forgets
    Homing homing_;
    bool lines_may_power_ = false;                      ///< those of commands
    std::vector<double> watched_deg_;                   ///< of each axis, at the last look at the limits
    std::vector<double> rest_counts_;                   ///< of each motor, where it came to rest
    std::vector<std::optional<double>> own_jog_speeds_; ///< Ix22 as a person left it, where a jog changed it
    Braking braking_;                                   ///< while stopping
    PowerSources power_;
    std::optional<Leaving> leaving_;
    std::string farewell_{};
    Jogging jogging_;
    drivers::Overrides overrides_;

    TypedBuffer typed_;
    Command command_;
    std::string addresses_ = "#1&1"; ///< those of the person's commands
    drivers::CommandAnswer answer_;
};

} // namespace millwright::pmac::internal
