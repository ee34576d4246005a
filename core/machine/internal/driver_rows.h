// The rows of the drivers, each in a file of its own.
#pragma once

#include "core/machine/driver_row.h"

namespace millwright::machine {

extern const DriverRow virtual_row;
extern const DriverRow grbl_row;
extern const DriverRow linuxcnc_row;
extern const DriverRow stream_row;
extern const DriverRow cordic_row;
extern const DriverRow records_row;
extern const DriverRow pmac_row;

} // namespace millwright::machine
