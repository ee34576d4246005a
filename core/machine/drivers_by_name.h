// Every driver by its name, and how one is made of what a person chose. So the command line and the workbench
// offer the same.
#pragma once

#include "core/machine/driver_row.h"

#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::machine {

/// In the order in which they are offered.
[[nodiscard]] std::span<const DriverRow> driver_rows();

/// Throws Error for any other name.
[[nodiscard]] const DriverRow& driver_row(std::string_view name);

/// Of every row that `fits`, or of all.
[[nodiscard]] std::vector<std::string> driver_names(bool (*fits)(const DriverRow&) = nullptr);

/// Disconnected; nothing moves. `axes` is for the virtual machine, the CORDIC processor, the coordinate
/// stream and records alone, its arm for a PMAC; `clock` must outlive the driver. A stream into a file goes
/// as fast as it can. Throws Error for what was chosen wrongly: no such driver, no address, no model, no arm,
/// a value out of range.
[[nodiscard]] std::unique_ptr<drivers::Driver>
make_driver(const DriverChoice& choice, const MovedAxes& axes, Clock& clock);

} // namespace millwright::machine
