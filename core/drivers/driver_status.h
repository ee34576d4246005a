// What is known of a machine at one moment. Lengths mm, angles rad, times s.
#pragma once

#include "core/gcode/modal_state.h"
#include "core/kinematics/machine_model.h"

#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::drivers {

enum class DriverState {
    disconnected,
    idle,     ///< ready; after a program: it ran to its end
    running,  ///<
    holding,  ///< braking for a hold or at rest in it; can be resumed
    stopping, ///< braking for good
    stopped,  ///< at rest after stop(); the program cannot be resumed
    alarm     ///< at rest after a fault or an emergency stop; nothing starts before reset()
};

[[nodiscard]] std::string_view to_text(DriverState state);
/// Behind "is": "idle", "in alarm".
[[nodiscard]] std::string_view in_words(DriverState state);

/// Running, holding or stopping: it is not at rest for good, or stands in the middle of something.
[[nodiscard]] bool is_at_work(DriverState state);

/// What a machine is at while it is running, holding or stopping.
enum class Activity { none, program, command, jog, homing, check };

[[nodiscard]] std::string_view to_text(Activity activity);

/// Of programmed feeds, rapids and spindle speeds, in percent.
struct Overrides {
    int feed = 100;
    int rapid = 100;
    int spindle = 100;

    friend bool operator==(const Overrides&, const Overrides&) = default;
};

/// Switches that are on.
struct Inputs {
    std::string limits; ///< letters of the axes whose limit switch is hit
    bool probe = false;
    bool door = false;
    bool hold = false, reset = false, start = false; ///< buttons at the machine

    friend bool operator==(const Inputs&, const Inputs&) = default;
};

/// How the last probing ended.
struct Probing {
    int number = 0;                     ///< counts since connect(), so that a new one can be recognised
    bool touched = false;               ///<
    kinematics::AxisPositions position; ///< where, in machine coordinates
};

/// What a controller tells of the motor of an axis.
struct MotorReading {
    double following_error = 0.0; ///< where it was sent minus where it is, mm or rad
    double output_V = 0.0;        ///< to its amplifier

    friend bool operator==(const MotorReading&, const MotorReading&) = default;
};

struct Coolant {
    bool mist = false, flood = false;

    friend bool operator==(const Coolant&, const Coolant&) = default;
};

/// What became of the last command().
struct CommandAnswer {
    enum class State { none, pending, done, refused };

    int number = 0; ///< counts since connect()
    State state = State::none;
    std::string text; ///< what the controller said; of a refusal why, in plain words

    [[nodiscard]] bool pending() const { return state == State::pending; }
    /// That of the next command; gives its number.
    int begin(State its_state = State::pending, std::string its_text = {}) {
        state = its_state;
        text = std::move(its_text);
        return ++number;
    }
    /// That of a command which something else follows is not shown any more.
    void forget() {
        state = State::none;
        text.clear();
    }
    void add_line(std::string_view line) { text.append(text.empty() ? "" : "\n").append(line); }
    /// Does nothing unless pending.
    void end(State its_state) { state = pending() ? its_state : state; }
    /// The command did not get to its end. Does nothing unless pending.
    void break_off(std::string_view why) {
        if (pending()) {
            state = State::refused;
            text = why.empty() ? "stopped" : why;
        }
    }
};

/// A tool change that is made by the driver (Work::tool_changes).
struct ToolChangeStatus {
    int line = 0, tool = 0; ///< of ToolStop
    /// Rests until a person goes on by resume(): jogs, commands and homing are taken.
    bool waits = false;
    bool held = false;       ///< by hold(): the next resume() ends the hold, and nothing else
    bool keeps_zero = false; ///< the tool is measured against the first one: the zero of Z has to stay

    friend bool operator==(const ToolChangeStatus&, const ToolChangeStatus&) = default;
};

struct DriverStatus {
    DriverState state = DriverState::disconnected;
    Activity activity = Activity::none;
    kinematics::AxisPositions position; ///< machine coordinates; empty while disconnected
    /// Why the machine may no longer stand where `position` says, a part of a sentence; empty: nothing speaks
    /// against it. Ended by homing, by a new zero of every axis, or by Driver::trust_position().
    std::string position_doubt;
    bool position_lost =
        false; ///< the doubt is about something that costs the position, as a reset in motion
    std::string position_confirmed; ///< the doubt that a person has ended by a word; empty: none
    kinematics::AxisPositions velocity;
    bool powered = true; ///< its motors, where that is reported
    /// False: `position` counts from wherever the machine stood when it was switched on, until it is homed;
    /// or it was assumed, until the machine was sent to a position or Driver::stands_at(). Where the
    /// controller does not report it this is true.
    bool position_known = true;
    std::vector<MotorReading> motors; ///< of each axis; empty where the controller does not tell
    /// Machine position minus work position: all offsets that are in force. Empty while disconnected.
    kinematics::AxisPositions work_offset;
    int work_system = 0; ///< in force, 1 is G54, 9 is G59.3; 0: not reported
    std::string modes;   ///< G- and M-codes in force, as "G0 G54 G17 G21"; empty: not reported
    int block =
        -1; ///< of the current or last program, in execution or next, as far as is known; -1 without one
    double fraction = 0.0;   ///< of that block
    int executed_blocks = 0; ///< of the current or last program, completely executed
    int sent_blocks = 0;     ///< of it, given to the controller; 0 where that is done at once
    /// Where in the planned trajectory that is, s. 0 where the controller plans; the dispatcher's reports
    /// tell it there too, by `block` and `fraction`.
    double planned_time = 0.0;
    double feed = 0.0; ///< of the motion now, where the controller tells it, mm/s
    gcode::SpindleTurning spindle = gcode::SpindleTurning::stopped; ///< as commanded
    double spindle_rpm = 0.0;                                       ///< where the controller tells it
    Coolant coolant;
    int tool = 0; ///< in the spindle, where the controller tells it
    Overrides overrides;
    Inputs inputs;
    std::optional<Probing> probe;
    CommandAnswer answer;
    std::optional<ToolChangeStatus> tool_change; ///< under way
    /// Of the current or last program: lines that are not of it and were sent for its tool changes.
    std::vector<std::string> own_lines;
    bool link_lost = false; ///< an alarm because the controller no longer answers; reset() reconnects
    std::string message;    ///< why there is an alarm or a hold that was not requested here, in a sentence

    /// What a program calls the position.
    [[nodiscard]] kinematics::AxisPositions work_position() const {
        return work_offset.size() == position.size() ? kinematics::AxisPositions(position - work_offset)
                                                     : position;
    }
};

/// What a person should know and do, from DriverStatus::position_doubt or what a log holds of it.
[[nodiscard]] std::string doubt_sentence(std::string_view why);

} // namespace millwright::drivers
