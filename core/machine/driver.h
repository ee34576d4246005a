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

/// What is known of the machine at one moment.
struct DriverStatus {
    DriverState state = DriverState::disconnected;
    kinematics::AxisPositions position; ///< programmed positions; empty while disconnected
    kinematics::AxisPositions velocity;
    int block = -1;            ///< of the current or last program, in execution or next; -1 without one
    double fraction = 0.0;     ///< of that block
    int executed_blocks = 0;   ///< of the current or last program, completely executed
    double planned_time = 0.0; ///< where in the planned trajectory that is, s
    std::string message;       ///< why there is an alarm, in a sentence
};

/// What a driver is given to do: drivers of controllers that plan for themselves use the text.
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
};

} // namespace millwright::machine
