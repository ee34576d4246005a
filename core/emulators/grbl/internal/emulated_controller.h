// An emulated Grbl without its wire: states, lines, real-time bytes. Grbl is one loop that reads a line, does
// what it says, answers, and looks after the real-time bytes in between; where the real one waits inside a
// line, this one keeps a list of tasks.
#pragma once

#include "core/emulators/grbl/grbl_emulator.h"
#include "core/emulators/grbl/internal/homing.h"
#include "core/emulators/grbl/internal/input.h"
#include "core/emulators/grbl/internal/parser.h"
#include "core/emulators/grbl/internal/planner.h"
#include "core/emulators/grbl/internal/report.h"

#include <bitset>
#include <cstddef>
#include <deque>
#include <map>
#include <optional>

namespace millwright::emulators::internal {

/// From 0x90, all feeds to their standard, to 0xA1, the mist.
constexpr std::size_t override_bytes = 0xA2 - 0x90;

enum class State { idle, run, hold, jog, alarm, door, check, home, sleep, tool };

class EmulatedController {
public:
    explicit EmulatedController(GrblEmulatorOptions options);

    void receive(unsigned char byte);
    void advance(double seconds);
    [[nodiscard]] std::string take_output();

    [[nodiscard]] double time() const { return time_; }
    [[nodiscard]] const Axes& position() const { return stepper_.position(); }
    [[nodiscard]] bool moving() const { return !stepper_.at_rest() || state_ == State::home; }
    [[nodiscard]] int planned_blocks() const { return planner_.capacity() - planner_.free_blocks(); }
    [[nodiscard]] const Build& build() const { return build_; }
    [[nodiscard]] Truth truth() const;

    void hit_limit_switch();
    void raise_alarm();
    void set_door(bool open);
    void break_limit_switches() { switches_broken_ = true; }
    void power_on();

private:
    // realtime.cpp: bytes that act at once
    void reset();
    void hold();
    void resume();
    void open_door();
    void cancel_jog();
    void take_overrides();
    void change_accessory(unsigned char byte);
    void report_status();
    [[nodiscard]] bool take_realtime(unsigned char byte);
    [[nodiscard]] bool needs_homing() const;
    [[nodiscard]] std::string_view state_text() const;
    void greet();
    void run_startup_lines();
    void alarm(int code);
    void probe_alarm(int code);
    void stop_everything();

    // system_commands.cpp: lines that begin with $; each returns 0 or the number of its error
    [[nodiscard]] int system_command(std::string_view line);
    [[nodiscard]] int named_command(std::string_view line);
    [[nodiscard]] int jog(std::string_view line);
    [[nodiscard]] int check_mode();
    [[nodiscard]] int unlock();
    [[nodiscard]] int home(std::string_view line);
    [[nodiscard]] int restore(std::string_view what);
    [[nodiscard]] int startup_line(std::string_view line);
    [[nodiscard]] int store_setting(std::string_view line);
    [[nodiscard]] int build_info(std::string_view line);
    [[nodiscard]] int named_setting(std::string_view line);
    void store(const Eeprom& eeprom);
    [[nodiscard]] const Eeprom& eeprom_to_be() const { return pending_eeprom_ ? *pending_eeprom_ : eeprom_; }

    // tasks.cpp: what a line makes it do
    void take_over(const Parsed& parsed);
    [[nodiscard]] bool do_tasks();
    [[nodiscard]] bool do_task(Task& task);
    [[nodiscard]] bool do_move(Task& task);
    [[nodiscard]] bool do_probe(const Task& task);
    [[nodiscard]] bool do_dwell(const Task& task);
    void end_program();
    void finish_probe(bool touched);
    [[nodiscard]] bool inside_travel(const Axes& target) const;
    [[nodiscard]] bool at_rest();
    [[nodiscard]] bool writing() const;
    void block_done(std::int64_t owner);

    // emulated_controller.cpp: time and the loop
    void work();
    void execute(const InputLine& line);
    [[nodiscard]] int execute_gcode(const std::string& text);
    void acknowledge(int error);
    void start_cycle();
    [[nodiscard]] double next_event() const;
    void pass(double seconds);
    void after_motion();
    void watch_limits();
    void watch_probe(const Axes& before);
    void say(std::string_view text) { output_ += text; }

    /// The line being executed, with what of it waits.
    struct ExecutedLine {
        std::deque<Task> tasks;
        bool answer_due = false;     ///< it is acknowledged when its tasks are done
        std::int64_t owner = -1;     ///< its number in the truth log
        int number = 0;              ///< its N word
        double arrived = 0.0;        ///< with its end
        std::optional<double> dwell; ///< until this time
        bool probing = false;
        bool paused = false; ///< by M0
    };
    struct Door {
        bool open = false;
        std::optional<double> restore; ///< spindle and coolant come back until this time
    };
    enum class StatusQuery { none, usual, all }; ///< all: of a grblHAL, every field

    GrblEmulatorOptions options_;
    Build build_;
    Eeprom eeprom_;
    std::optional<Eeprom> pending_eeprom_; ///< what a task will store
    Modes modes_;
    Planner planner_;
    Stepper stepper_;
    SerialLine serial_line_;
    Input input_;
    StatusReport report_;
    Overrides overrides_;
    std::bitset<override_bytes> override_flags_; ///< bytes that came since the last pass of the loop
    Probe probe_;
    State state_ = State::idle;
    double time_ = 0.0;
    double busy_until_ = 0.0;    ///< reading and working out a line takes its time
    double writing_until_ = 0.0; ///< the EEPROM
    std::string output_;

    ExecutedLine line_;
    std::optional<Homing> homing_;
    StatusQuery asked_ = StatusQuery::none;
    int last_error_ = 0; ///< of a grblHAL, which refuses G-code with it until a $ line was right
    int last_alarm_ = 0;
    bool homed_ = false;
    bool critical_ = false; ///< only a reset helps
    bool jog_cancel_ = false;
    std::optional<int> trip_; ///< alarm to raise as soon as it is at rest
    Door door_;
    bool spindle_stopped_ = false; ///< by the override
    bool switches_broken_ = false;
    double last_motion_ = -1.0;
    int lost_bytes_ = 0;
    std::deque<TruthLine> truth_;
    std::map<std::int64_t, int> blocks_left_; ///< of each line that is not executed yet
};

} // namespace millwright::emulators::internal
