// What a driver brings along: its name, what a person sets about it, what kind of machine it moves, and how
// it is made. A new driver is a file with its row; the window and the command line draw from it.
#pragma once

#include "core/arm/arm_model.h"
#include "core/base/clock.h"
#include "core/drivers/driver.h"
#include "core/drivers/stream/record_format.h"
#include "core/kinematics/machine_model.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>

namespace millwright::machine {

/// The machine inside this program, which is chosen at first.
inline constexpr std::string_view virtual_driver = "virtual";

/// What to connect to.
struct DriverChoice {
    std::string driver = std::string(virtual_driver); ///< DriverRow::name
    std::string address;                              ///< as make_link() takes it; empty where none is needed
    std::string axes = "XYZ"; ///< of a LinuxCNC, see LinuxCncOptions; of a PMAC: axis 5 is one if B is
    bool one_by_one = false;  ///< Grbl: each line waits for the answer to the last
    double period = 0.01;     ///< of a coordinate stream: s between samples
    /// Of a coordinate stream: records in place of its own lines. Of a table that takes one record per move:
    /// not given means those of the KMITL thesis, without answers.
    std::optional<drivers::RecordFormat> record = {};

    friend bool operator==(const DriverChoice&, const DriverChoice&) = default;
};

/// The machine that is moved position by position, where no controller plans for itself.
struct MovedAxes {
    std::shared_ptr<const kinematics::MachineModel> model;
    kinematics::AxisPositions position; ///< of each axis, as the model has them
    double speed = 1.0;                 ///< of those inside this program, see VirtualSpeed
    /// Of a PMAC: whose joints its axes are, in order; none leaves its limits.
    std::shared_ptr<const arm::ArmModel> arm = nullptr;
    bool known = true; ///< `position`, by a person; else it is assumed, of a stream and of records
};

enum class MachineKind : std::uint8_t {
    simulated,  ///< inside this program; nothing real moves
    controlled, ///< a controller reads G-code
    positioned, ///< given positions, and reports nothing back; a spindle is switched by hand
    arm         ///< joints of an arm
};

struct ToggleField {
    bool (*value)(const DriverChoice&);
    void (*set)(DriverChoice&, bool);
};

struct TextField {
    std::string (*value)(const DriverChoice&);
    void (*set)(DriverChoice&, const std::string&);
};

/// Bytes that end a line.
struct LineEndField {
    std::string (*value)(const DriverChoice&);
    void (*set)(DriverChoice&, const std::string&);
};

struct NumberField {
    double (*value)(const DriverChoice&); ///< in `unit`
    void (*set)(DriverChoice&, double);
    std::string_view unit;
    double least, most, usual;
    int decimals;
};

/// One thing that a person sets about a driver.
struct DriverField {
    std::string_view id; ///< never shown, and never changed after a release
    std::string_view label, tip;
    std::variant<ToggleField, TextField, LineEndField, NumberField> value;
};

struct DriverAddress {
    std::string_view label;
    std::string_view tip;
    std::string_view usual = {}; ///< before a person gave one
    bool serial = true;          ///< may be a serial port
};

struct DriverRow {
    std::string_view name;          ///< on the command line, in logs, and Driver::name()
    std::string_view label;         ///< in the list of drivers
    std::string_view within_a_text; ///< the same, in the middle of a sentence
    std::string_view tip;
    MachineKind kind = MachineKind::controlled;
    std::optional<DriverAddress> address = {}; ///< nothing: it is inside this program
    std::span<const DriverField> fields = {};
    std::string_view note = {};     ///< a sentence below the fields
    std::string_view arm = {};      ///< of MachineKind::arm: the shipped arm whose drives it knows
    bool runs_projects = true;      ///< by `millwright run`
    std::string_view in_alarm = {}; ///< what a person should do; empty: unlock, or home where it can
    std::string_view why_no_home_in_alarm = {};     ///< a sentence; empty: homing ends an alarm
    std::span<const std::string_view> options = {}; ///< of the command line, beside those of every driver
    /// Disconnected; nothing moves. The clock outlives what is made. Throws Error for what was chosen
    /// wrongly.
    std::unique_ptr<drivers::Driver> (*make)(const DriverChoice&, const MovedAxes&, Clock&) = nullptr;
};

/// Throws Error where no machine is loaded.
void expect_model(const MovedAxes& axes);

} // namespace millwright::machine
