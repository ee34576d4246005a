// The border to every machine: one interface, one implementation a kind of controller in drivers/. Lengths
// mm, angles rad, times s.
//
// Threads: every member may be called from any thread and returns soon; hold, stop and emergency_stop act at
// once. A driver runs what it needs in threads of its own and never calls back. Nothing moves before start();
// nothing moves after stop() came to rest, after emergency_stop(), close() or the destructor.
#pragma once

#include "core/gcode/program.h"
#include "core/gcode/writer.h"
#include "core/motion/trajectory.h"

#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::machine {

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

/// Of programmed feeds, rapids and spindle speeds, in percent.
struct Overrides {
    int feed = 100;
    int rapid = 100;
    int spindle = 100;

    friend bool operator==(const Overrides&, const Overrides&) = default;
};

/// What is known of the machine at one moment.
struct DriverStatus {
    DriverState state = DriverState::disconnected;
    kinematics::AxisPositions position; ///< programmed positions; empty while disconnected
    kinematics::AxisPositions velocity;
    int block = -1;            ///< of the current or last program, in execution or next; -1 without one
    double fraction = 0.0;     ///< of that block
    int executed_blocks = 0;   ///< of the current or last program, completely executed
    double planned_time = 0.0; ///< where in the planned trajectory that is, s; 0 where the controller plans
    double feed = 0.0;         ///< of the motion now, where the controller tells it, mm/s
    double spindle_rpm = 0.0;  ///< where the controller tells it
    Overrides overrides;
    std::string message; ///< why there is an alarm or a hold that nobody here asked for, in a sentence
};

/// What a driver can do beyond running programs.
struct Capabilities {
    bool plans = false;                   ///< executes text, without a trajectory
    std::vector<gcode::ProgramAxis> axes; ///< that it moves; empty: those of any program
    bool overrides = false;
    bool jog = false;
    bool home = false;
};

/// A straight move by hand, from where the machine stands.
struct Jog {
    kinematics::AxisPositions way; ///< of each axis
    double speed = 0.0;            ///< mm/s
    /// If positive: brakes unless another jog comes within this time, s. So nobody's dead hand moves a
    /// machine.
    double dead_man = 0.0;
};

/// What a driver is given to do: drivers of controllers that plan for themselves use the text alone. Of a
/// text that was not made here there is no program and no trajectory.
struct Work {
    std::shared_ptr<const gcode::Program> program;
    std::shared_ptr<const motion::Trajectory> trajectory; ///< planned from the machine's position
    std::shared_ptr<const gcode::Listing> listing;
};

class Driver {
public:
    virtual ~Driver() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    [[nodiscard]] virtual DriverStatus status() const = 0;
    [[nodiscard]] virtual Capabilities capabilities() const { return {}; }

    /// Makes the link; nothing moves. Does nothing if there is one. Throws Error if there is nothing to link
    /// to.
    virtual void connect() = 0;
    /// Begins to execute. Throws Error with the reason unless idle or stopped, or if the machine does not
    /// stand where the trajectory begins.
    virtual void start(Work work) = 0;
    /// Brakes along the path; the program can be resumed. Does nothing unless running.
    virtual void hold() = 0;
    /// Goes on with a held program. Does nothing unless holding.
    virtual void resume() = 0;
    /// Brakes along the path and forgets the program.
    virtual void stop() = 0;
    /// At once, whatever that does to the path.
    virtual void emergency_stop() = 0;
    /// After an alarm: a person has looked at the machine, it is idle again. Nothing moves.
    virtual void reset() = 0;
    /// Stops and drops the link; waits until the machine is at rest. Never throws.
    virtual void close() noexcept = 0;

    /// What follows throws Error where capabilities() says that it cannot be done, or if the state does not
    /// allow it. Overrides act at once and outlast no program; the nearest that the controller has is taken.
    virtual void set_overrides(const Overrides& wanted);
    /// While idle, stopped or jogging; several jogs are executed one after another.
    virtual void jog(const Jog& jog);
    /// Brakes and forgets all jogs. Does nothing unless jogging.
    virtual void stop_jog();
    /// Finds the machine's zero by its switches; also after an alarm.
    virtual void home();
};

} // namespace millwright::machine
