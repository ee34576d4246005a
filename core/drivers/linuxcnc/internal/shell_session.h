// The host's side of a conversation with linuxcncrsh. What is claimed, and why: docs/reference/linuxcnc.md.
#pragma once

#include "core/drivers/controller_session.h"
#include "core/drivers/host_stall.h"
#include "core/drivers/internal/jog_feed.h"
#include "core/drivers/linuxcnc/internal/program_file.h"
#include "core/drivers/linuxcnc/internal/replies.h"

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::drivers::linuxcnc {

struct ShellSettings {
    std::string password = "EMC", enable_password = "EMCTOO";
    std::string axes = "XYZ";        ///< letters, in LinuxCNC's order X Y Z A B C
    double poll_interval = 0.1;      ///< s
    double patience = 5.0;           ///< s without an answer after which the controller counts as silent
    double jog_acceleration = 500.0; ///< mm/s^2: no less than the machine's, since LinuxCNC does not tell
};

class ShellSession final : public ControllerSession {
public:
    explicit ShellSession(ShellSettings settings = {}) : settings_(std::move(settings)) {}

    void opened(double now) override;
    void lost(const std::string& why) override;
    void closed() override;
    void receive(std::string_view bytes, double now) override;
    void tick(double now) override;

    [[nodiscard]] DriverStatus status() const override;
    [[nodiscard]] bool greeted() const override {
        return stage_ != Stage::greeting && stage_ != Stage::waking;
    }
    [[nodiscard]] bool link_lost() const override { return link_lost_; }
    [[nodiscard]] std::optional<Diagnostic> stranger() const override;

    /// `path`: where LinuxCNC finds the text of `file`.
    void start(const program::Listing& listing, const ProgramFile& file, const std::string& path, double now);
    void hold(double now) override;
    void resume(double now) override;
    void stop(double now) override;
    void emergency_stop(double now) override;
    void leave(double now) override;
    void reset(double now) override;
    void home(double now) override;
    void jog(const Jog& jog, double now) override;
    void stop_jog(double now) override;
    int command(const std::string& lines, double now);
    void set_overrides(const Overrides& wanted) override;

private:
    enum class Stage {
        closed,
        greeting, ///< hello, and what surrounds it
        waking,   ///< out of the emergency stop, because a person asked for it
        ready,
        foreign, ///< a program runs that somebody else has begun
        running,
        commanding,
        jogging,
        homing,
        stopping,
        stopped,
        alarm
    };

    // shell_session.cpp: questions and answers
    void send(const std::string& request, std::string subject);
    void set(const std::string& words);
    void get(const std::string& subject);
    void handle(const Reply& reply, double now);
    void refused(const std::string& request, double now);
    void ask(double now);
    [[nodiscard]] const std::string& value(const std::string& subject) const;
    [[nodiscard]] bool idle_now() const;

    // shell_watch.cpp: what a round of answers says
    void round_done(double now);
    [[nodiscard]] bool watch_power(double now);
    void take_machine();
    void watch_others();
    void watch_program(double now);
    void watch_command(double now);
    void watch_jog(double now);
    [[nodiscard]] bool jog_is_over(double now) const;
    void watch_homing(double now);
    void pump_jog();
    [[nodiscard]] double unit() const; ///< mm
    [[nodiscard]] kinematics::AxisPositions axes_of(const std::string& subject) const;

    // shell_requests.cpp: what a person wants
    void finish(Stage stage, std::string why = {});
    void fail(std::string why, double now);
    void fall_silent();
    void require_rest(std::string_view what) const;
    [[nodiscard]] bool active() const;

    // shell_status.cpp
    [[nodiscard]] DriverState state() const;
    [[nodiscard]] Activity activity() const;
    [[nodiscard]] int work_system() const;

    ShellSettings settings_;
    Stage stage_ = Stage::closed;
    std::string input_;
    bool link_lost_ = false;
    std::string message_;

    struct Request {
        std::string text, subject;
    };
    std::deque<Request> outstanding_;           ///< sent and not answered; answers come in order
    std::map<std::string, std::string> values_; ///< the last of each get
    HostStall host_stall_;
    double next_round_ = 0.0, last_heard_ = 0.0, since_ = 0.0, last_round_ = 0.0;
    bool in_round_ = false;
    std::string error_; ///< of this round; empty: none

    kinematics::AxisPositions position_, offset_;
    double speed_ = 0.0; ///< along X Y Z, by the last two positions, mm/s
    Overrides overrides_;

    /// A program of ours, since it was begun: what LinuxCNC has shown of it.
    struct Run {
        program::Listing listing;
        ProgramFile file;
        kinematics::AxisPositions start; ///< where the machine stood
        bool seen_running = false;
        bool marked = false;     ///< it reported the mark at the end of the file
        bool left_start = false; ///< the machine has left its place
        int last_bound = 0, executed = 0;
    };
    std::optional<Run> run_; ///< the current or last
    bool paused_ = false;
    Stage after_stopping_ = Stage::stopped; ///< or alarm
    int quiet_rounds_ = 0;                  ///< idle, one after the other
    int busy_rounds_ = 0;                   ///< not idle, the same
    bool off_without_estop_ = false;        ///< in the round before
    double last_noise_ = 0.0;               ///< when the last round was that was not

    std::deque<std::string> lines_; ///< of a command, to be sent
    CommandAnswer answer_;
    internal::JogFeed jog_feed_;
    bool jog_stopping_ = false;
    std::optional<double> jog_until_;
};

} // namespace millwright::drivers::linuxcnc
