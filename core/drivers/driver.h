// The border to every machine: one interface, one implementation per kind of controller in drivers/. Lengths
// mm, angles rad, times s.
//
// Threads: every member may be called from any thread and returns soon; hold, stop and emergency_stop act at
// once. A driver runs what it needs in threads of its own and never calls back, but for Work::ahead. Nothing
// moves before start(); nothing moves after stop() came to rest, after emergency_stop(), close() or the
// destructor.
#pragma once

#include "core/drivers/driver_status.h"
#include "core/drivers/point_track.h"
#include "core/drivers/tool_change.h"
#include "core/gcode/reader_settings.h"
#include "core/motion/trajectory.h"
#include "core/program/listing.h"
#include "core/program/program.h"

#include <filesystem>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::drivers {

/// What a driver can do beyond running programs.
struct Capabilities {
    /// What it executes of Work.
    enum class Takes {
        trajectory, ///< of a program
        text,       ///< without a trajectory
        points      ///< Work::points, without a trajectory, and nothing else
    };
    enum class OverrideRange { none, feed, all }; ///< all: of rapids and spindle speed, too

    struct ManualControl {
        bool jog = false;
        bool power = false; ///< motors get theirs from enable(), never by themselves
        bool home = false;
        bool command = false;        ///< MDI; spindle, coolant and work offsets go this way too (mdi_lines.h)
        bool probe = false;          ///< G38.2 as a command
        std::string_view jog_axes{}; ///< letters of the axes that jog; empty: all
        std::string_view why_no_home{}; ///< a sentence where it could, but is set up otherwise; else empty
    };
    struct Reports {
        bool position = true;  ///< false: a person enters it, stands_at()
        bool execution = true; ///< false: only the sending of a block is known
        bool spindle = true;   ///< whether it turns
    };
    struct ProgramControl {
        bool check_mode = false;    ///< reads a program without moving: check_there()
        bool single_block = false;  ///< can stand still after each block
        bool optional_stop = false; ///< has a switch for M1 here
        bool piecewise = false;     ///< gives a program to the controller bit by bit, and asks Work::ahead
        bool tool_changes =
            false; ///< stops for another tool where its controller does not: Work::tool_changes
    };

    Takes takes = Takes::trajectory;
    std::vector<program::ProgramAxis> axes; ///< that it moves; empty: those of any program
    OverrideRange overrides = OverrideRange::none;
    ManualControl manual;
    Reports reports;
    ProgramControl program;
    bool mist = true;   ///< has M7
    bool laser = false; ///< the controller is in the mode of a laser, in which feed moves burn
    std::string_view firmware = "Grbl";        ///< of a controller that speaks Grbl's protocol
    std::optional<gcode::Dialect> dialect{};   ///< in which it reads text
    std::span<const std::string_view> words{}; ///< of its single lines, to complete what is typed

    [[nodiscard]] bool takes_text() const { return takes == Takes::text; }
    [[nodiscard]] bool takes_points() const { return takes == Takes::points; }
};

/// What is known of the machine's limits: of each axis, machine coordinates, mm or rad, and per second.
struct MachineLimits {
    struct Axis {
        char letter = 'X';
        std::optional<double> min, max; ///< of the travel
        std::optional<double> speed;    ///< greatest
        std::optional<double> acceleration{};
        std::optional<double> jog_speed{}; ///< in force for jogs
        std::optional<double> output_V{};  ///< greatest, to its amplifier
        std::optional<double> travel{};    ///< its length, where its zero is unknown
    };
    std::vector<Axis> axes;
    std::optional<double> spindle_rpm; ///< greatest
};

/// One of the controller's own settings.
struct ControllerSetting {
    std::string name; ///< as the controller calls it, $110
    double value = 0.0;
    std::string_view title, unit, explanation; ///< unit: may be empty
};

/// A stored offset, as G54, G28 or G92: machine coordinates of its zero, or of a place to go to.
struct StoredOffset {
    std::string name;
    kinematics::AxisPositions value;
};

/// A straight move by hand, from where the machine stands.
struct Jog {
    kinematics::AxisPositions way; ///< of each axis
    double speed = 0.0;            ///< mm/s
    /// If positive: brakes unless another jog comes within this time, s. So a machine never keeps moving
    /// after its operator has let go.
    double dead_man = 0.0;
};

/// What a driver is given to do: drivers of controllers that plan for themselves use the text alone. Of a
/// text that was not made here there is no program and no trajectory.
struct Work {
    std::shared_ptr<const program::Program> program;
    std::shared_ptr<const motion::Trajectory> trajectory; ///< planned from the machine's position
    std::shared_ptr<const program::Listing> listing;
    /// A piecewise driver gives no block to the controller before it has asked here, from a thread of its own
    /// and without its locks, so that no hold waits for the answer. Whoever answers does not call the driver.
    /// Asked for the number of blocks that are wanted, counted from the program's first, it returns how many
    /// may be sent; less than wanted: nothing more is sent. Empty: all may.
    std::function<int(int wanted)> ahead{};
    /// What a driver plays whose capabilities() say points; then there is no trajectory.
    std::shared_ptr<const PointTrack> points{};
    /// A driver whose capabilities() say tool_changes makes them; nothing: they are left to the controller.
    std::optional<ToolChanges> tool_changes{};
};

/// Whether a person has to confirm the position before a job moves the machine: it is in doubt, and something
/// has happened that costs it, or `offsets` holds a work offset, which counts from a zero that may be gone.
[[nodiscard]] bool needs_confirmation(const DriverStatus& status, const std::vector<StoredOffset>& offsets);

class Console;

class Driver {
public:
    virtual ~Driver() = default;
    [[nodiscard]] virtual std::string name() const = 0;
    /// What answers at the other end, with its version; empty where that is not known, or while disconnected.
    [[nodiscard]] virtual std::string firmware() const { return {}; }
    /// As make_link() takes it; empty where there is no link.
    [[nodiscard]] virtual std::string address() const { return {}; }
    [[nodiscard]] virtual DriverStatus status() const = 0;
    [[nodiscard]] virtual Capabilities capabilities() const { return {}; }

    /// Throws Error naming `file`, line and column for what start() would refuse; needs no link.
    virtual void check(const program::Listing& listing, const std::filesystem::path& file) const;
    /// Makes the link; nothing moves. Does nothing if there is one. Throws Error if there is nothing to link
    /// to.
    virtual void connect() = 0;
    /// Begins to execute. At M0, M60, M6 and, if they are switched on, optional stops the machine rests,
    /// DriverState::holding with the reason as message, until resume(). Throws Error with the reason unless
    /// idle or stopped, or if the machine does not stand where the trajectory begins.
    virtual void start(Work work) = 0;
    /// Brakes along the path; the program can be resumed. Does nothing unless running.
    virtual void hold() = 0;
    /// Goes on with a held program. Does nothing unless holding.
    virtual void resume() = 0;
    /// Brakes along the path and forgets the program.
    virtual void stop() = 0;
    /// Something is wrong that the driver cannot know: as stop(), and then, where the driver can, in alarm
    /// with `why` as message.
    virtual void break_off(std::string why);
    /// At once, whatever that does to the path.
    virtual void emergency_stop() = 0;
    /// After an alarm: a person has looked at the machine, it is idle again. Nothing moves.
    virtual void reset() = 0;
    /// A person has looked: the machine stands where DriverStatus::position says.
    virtual void trust_position();
    /// A person has read the position at the machine. Throws Error unless it is at rest, and where
    /// capabilities() says that it reports its position.
    virtual void stands_at(const kinematics::AxisPositions& position);
    /// The caller has a reason to doubt DriverStatus::position that the driver cannot see; `why` and `lost`
    /// as DriverStatus::position_doubt and position_lost. Drivers whose position cannot be wrong unnoticed do
    /// nothing.
    virtual void doubt_position(std::string why, bool lost);
    /// Stops and drops the link; waits until the machine is at rest. Never throws.
    virtual void close() noexcept = 0;

    /// What follows throws Error where capabilities() says that it cannot be done, or if the state does not
    /// allow it. Overrides act at once and outlast no program; the nearest that the controller has is taken.
    virtual void set_overrides(const Overrides& wanted);
    /// While idle, stopped or jogging; several jogs are executed one after another. hold() and stop() end it
    /// too.
    virtual void jog(const Jog& jog);
    /// Brakes and forgets all jogs. Does nothing unless jogging.
    virtual void stop_jog();
    /// Gives the motors power where they stand. Only ever because a person looked and said so.
    virtual void enable();
    /// Finds the machine's zero by its switches; also after an alarm.
    virtual void home();
    /// Lines of G-code, or of what else the controller takes as lines (settings), executed now, while idle or
    /// stopped; after a refused one the rest is left out. What became of them: DriverStatus::answer, whose
    /// number is returned.
    virtual int command(const std::string& lines);
    /// Has the controller itself read a program in a mode in which nothing moves, while idle or stopped;
    /// stop() ends it. What it refuses: DriverStatus::answer, a line for each, whose number is returned.
    /// Throws Error for what must not be sent, and where the check would change something that stays.
    virtual int check_there(const program::Listing& listing);
    /// The same as command() for a whole file of settings: what is behind a refused line is sent all the
    /// same, and the answer has a line for each refusal.
    virtual int load(const std::vector<std::string>& lines);
    /// After each block with anything to do the machine rests, DriverState::holding, until resume(). Also
    /// while a program runs: it rests as soon as it can.
    virtual void set_single_block(bool on);
    /// Whether M1 stops the program as M0 does; at first it does not.
    virtual void set_optional_stop(bool on);

    /// Nothing where the controller does not tell, or while disconnected.
    [[nodiscard]] virtual MachineLimits limits() const { return {}; }
    /// Empty where there are no settings, or while disconnected.
    [[nodiscard]] virtual std::vector<ControllerSetting> settings() const { return {}; }
    [[nodiscard]] virtual std::vector<StoredOffset> stored_offsets() const { return {}; }
    /// What a person should know of the way the controller is set up, in sentences; empty while disconnected.
    [[nodiscard]] virtual std::vector<std::string> remarks() const { return {}; }
    /// What went over the link; none where there is no link. Lives as long as the driver.
    [[nodiscard]] virtual Console* console() { return nullptr; }
};

} // namespace millwright::drivers
