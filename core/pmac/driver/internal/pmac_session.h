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
    [[nodiscard]] bool link_lost() const override { return link_lost_; }
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
    void end_leaving();
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
    std::string output_;
    std::vector<drivers::ConsoleLine> told_;
    std::string message_;
    bool link_lost_ = false;
    bool heard_ = false;  ///< something since the link was opened
    bool unseen_ = false; ///< silent since the last report: what it reported is old

    std::deque<Request> queue_;
    std::optional<Request> sent_;
    drivers::HostStall host_stall_;
    double next_poll_ = 0.0, next_reading_ = 0.0, greet_at_ = 0.0, opened_at_ = 0.0;
    std::size_t greet_step_ = 0;
    std::string greeting_heard_{}; ///< before the first question
    bool buffer_open_ = false;     ///< nothing may be asked meanwhile
    bool polled_ = false;
    bool asked_poll_ = false; ///< by the last line
    bool look_first_ = false; ///< before anything is sent again that moves: the card may have been reset

    MotorReadings readings_;
    std::vector<MotorState> motors_;
    FollowingWatch following_;
    GuardWatch guard_;
    double polled_at_ = 0.0, read_at_ = 0.0;
    std::uint32_t system_1_ = 0, system_2_ = 0;
    double mark_ = 0.0; ///< P1000, which programs and the watchdog set

    int program_lines_ = 0, executed_ = 0;
    std::string run_refusal_{}; ///< until the card has reported whose loop is open
    bool marks_tell_ = false;   ///< lines are executed in their order
    bool held_ = false;
    bool armed_ = false;        ///< the watchdog in the card
    bool mark_is_ours_ = false; ///< P1000 was set back since the watchdog was armed
    bool stays_armed_ = false;  ///< at rest, too: something in the card may begin motion without a command
    int quiet_polls_ = 0;
    int off_target_polls_ = 0; ///< a motor stands where it was not sent
    int power_polls_ = 0;      ///< for which power that was given is still waited for
    bool unexplained_ = false; ///< a motor was killed, and the card has not reported yet by what
    bool was_home_ = false;    ///< to tell when the card forgets
    std::size_t homing_axis_ = 0;
    double homing_from_ = 0.0;           ///< counts
    std::vector<double> commanded_from_; ///< counts of each motor when the last command was given
    std::string commanded_;              ///< its lines
    bool lines_may_power_ = false;       ///< those of commands
    bool closes_loops_ = false;          ///< the last command
    bool only_set_ = false;              ///< variables, by its lines: nothing moves
    std::vector<double> watched_deg_;    ///< of each axis, at the last look at the limits
    std::vector<double> rest_counts_;    ///< of each motor, where it came to rest
    bool homing_backs_off_ = false;      ///< to the side of its flag from which a motor finds it
    std::vector<std::optional<double>> own_jog_speeds_; ///< Ix22 as a person left it, where a jog changed it
    std::optional<double> brake_by_;  ///< while stopping, s; the motors lose their power then
    bool unbraked_ = false;           ///< stopping, and which motors move is not known yet
    bool found_power_ = false;        ///< some motor has had power since before the link was made
    bool gave_power_ = false;         ///< to some motor, by a request since then
    bool leaving_ = false;            ///< the link is going to be dropped
    int quiet_reports_ = 0;           ///< in which no motor had power, behind the last kill
    bool plcs_run_ = false;           ///< other PLC programs than the guard may, as far as is known
    std::optional<double> kill_by_{}; ///< s; then a kill counts as unseen
    std::string farewell_{};
    std::optional<double> jog_until_;
    bool jog_stopping_ = false;
    drivers::Overrides overrides_;

    TypedBuffer typed_;
    std::deque<std::string> command_lines_;
    std::string opened_by_{}; ///< the line of theirs that opened the buffer
    bool command_goes_on_ = false;
    bool command_refused_ = false;   ///< a line of it, and it went on
    std::string addresses_ = "#1&1"; ///< those of the person's commands
    drivers::CommandAnswer answer_;
};

} // namespace millwright::pmac::internal
