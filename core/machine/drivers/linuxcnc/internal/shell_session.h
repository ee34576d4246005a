// The host's side of a conversation with linuxcncrsh, without wires, threads and clocks: bytes come in, bytes
// go out, time is told. What is claimed, and why: docs/reference/linuxcnc.md.
#pragma once

#include "core/machine/driver.h"
#include "core/machine/drivers/internal/jog_feed.h"
#include "core/machine/drivers/linuxcnc/internal/program_file.h"
#include "core/machine/drivers/linuxcnc/internal/replies.h"

#include <deque>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::machine::linuxcnc {

struct ShellSettings {
    std::string password = "EMC", enable_password = "EMCTOO";
    std::string axes = "XYZ";        ///< letters, in LinuxCNC's order X Y Z A B C
    double poll_interval = 0.1;      ///< s
    double patience = 5.0;           ///< s without an answer after which the controller counts as silent
    double jog_acceleration = 500.0; ///< mm/s^2: no less than the machine's, since LinuxCNC does not tell
};

class ShellSession {
public:
    explicit ShellSession(ShellSettings settings = {}) : settings_(std::move(settings)) {}

    // What happens to it.
    void opened(double now);
    void lost(const std::string& why);
    void closed();
    void receive(std::string_view bytes, double now);
    void tick(double now);
    [[nodiscard]] std::string take_output();

    // What it knows.
    [[nodiscard]] DriverStatus status() const;
    [[nodiscard]] bool greeted() const { return stage_ != Stage::greeting && stage_ != Stage::waking; }
    [[nodiscard]] bool link_lost() const { return link_lost_; }

    // What a person wants, as in Driver. `path`: where LinuxCNC finds the text of `file`.
    void start(const gcode::Listing& listing, const ProgramFile& file, const std::string& path, double now);
    void hold();
    void resume();
    void stop(double now);
    void emergency_stop();
    void reset(double now);
    void home(double now);
    void jog(const Jog& jog, double now);
    void stop_jog(double now);
    int command(const std::string& lines, double now);
    void set_overrides(const Overrides& wanted);

private:
    enum class Stage {
        closed,
        greeting, ///< hello, and what surrounds it
        waking,   ///< out of the emergency stop, because a person asked for it
        ready,
        running,
        commanding,
        jogging,
        homing,
        stopping,
        stopped,
        alarm
    };

    void send(const std::string& request, std::string subject);
    void set(const std::string& words);
    void get(const std::string& subject);
    void handle(const Reply& reply, double now);
    void refused(const std::string& request, double now);
    void ask(double now);
    void round_done(double now);
    void take_machine();
    void watch_program(double now);
    void watch_command(double now);
    void watch_jog(double now);
    void pump_jog();
    void fail(std::string why, double now);
    void require_rest(std::string_view what) const;
    [[nodiscard]] bool active() const;
    [[nodiscard]] bool idle_now() const;
    [[nodiscard]] const std::string& value(const std::string& subject) const;
    [[nodiscard]] kinematics::AxisPositions axes_of(const std::string& subject) const;
    [[nodiscard]] DriverState state() const;
    void finish(Stage stage, std::string why = {});

    ShellSettings settings_;
    Stage stage_ = Stage::closed;
    std::string output_, input_;
    bool link_lost_ = false;
    std::string message_;

    struct Request {
        std::string text, subject;
    };
    std::deque<Request> outstanding_;           ///< sent and not answered; answers come in order
    std::map<std::string, std::string> values_; ///< the last of each get
    double next_round_ = 0.0, last_heard_ = 0.0, since_ = 0.0, last_round_ = 0.0;
    bool in_round_ = false;
    std::string error_; ///< of this round; empty: none

    kinematics::AxisPositions position_, offset_;
    double speed_ = 0.0; ///< along X Y Z, by the last two positions, mm/s
    Overrides overrides_;

    gcode::Listing listing_;
    ProgramFile file_;
    bool seen_running_ = false, paused_ = false, marked_ = false, ending_in_fault_ = false,
         has_program_ = false;
    int quiet_rounds_ = 0; ///< idle, one after the other
    int last_bound_ = 0, executed_ = 0;

    std::deque<std::string> lines_; ///< of a command, to be sent
    CommandAnswer answer_;
    internal::JogFeed jog_feed_;
    bool jog_stopping_ = false;
    std::optional<double> jog_until_;
};

} // namespace millwright::machine::linuxcnc
