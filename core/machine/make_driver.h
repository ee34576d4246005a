// The kinds of drivers, by name, and how one is made of what a person chose. So the command line and the
// workbench offer the same.
#pragma once

#include "core/arm/arm_model.h"
#include "core/base/clock.h"
#include "core/drivers/driver.h"
#include "core/drivers/stream/record_format.h"

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace millwright::machine {

enum class DriverKind { virtual_machine, grbl, linuxcnc, stream, cordic, records, pmac };

/// "virtual", "grbl", "linuxcnc", "stream", "cordic", "records", "pmac": as on the command line, and as
/// Driver::name().
[[nodiscard]] std::string_view to_text(DriverKind kind);
/// Throws Error for any other name.
[[nodiscard]] DriverKind driver_kind(std::string_view name);

/// What to connect to.
struct DriverChoice {
    DriverKind kind = DriverKind::virtual_machine;
    std::string address;      ///< as make_link() takes it; those inside this program need none
    std::string axes = "XYZ"; ///< of a LinuxCNC, see LinuxCncOptions; of a PMAC: axis 5 is one if B is
    bool one_by_one = false;  ///< Grbl: each line waits for the answer to the last
    double period = 0.01;     ///< of a coordinate stream: s between samples
    /// Of a coordinate stream: records in place of its own lines. Of a table that takes one record a move:
    /// not given means those of the KMITL thesis, without answers.
    std::optional<drivers::RecordFormat> record = {};

    friend bool operator==(const DriverChoice&, const DriverChoice&) = default;
};

/// The machine that is moved position by position, where no controller plans for itself.
struct MovedAxes {
    std::shared_ptr<const kinematics::MachineModel> model;
    kinematics::AxisPositions position; ///< where it stands
    double speed = 1.0;                 ///< of those inside this program, see VirtualSpeed
    /// Of a PMAC: whose joints its axes are, in order; none leaves its limits.
    std::shared_ptr<const arm::ArmModel> arm = nullptr;
    bool known = true; ///< `position`, by a person; else it is assumed, of a stream and of records
};

/// Disconnected; nothing moves. `axes` is for the virtual machine, the CORDIC processor, the coordinate
/// stream and records alone, its arm for a PMAC; `clock` must outlive the driver. A stream into a file goes
/// as fast as it can. Throws Error for what was chosen wrongly: no address, no model, no arm, a value out of
/// range.
[[nodiscard]] std::unique_ptr<drivers::Driver>
make_driver(const DriverChoice& choice, const MovedAxes& axes, Clock& clock);

} // namespace millwright::machine
