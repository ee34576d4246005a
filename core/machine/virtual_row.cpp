#include "core/drivers/virtual_machine/virtual_machine.h"
#include "core/machine/internal/driver_rows.h"

#include <array>

namespace millwright::machine {

namespace {

constexpr std::array<std::string_view, 1> virtual_options{"--speed"};

} // namespace

constinit const DriverRow virtual_row{
    .name = virtual_driver,
    .label = "Virtual machine",
    .within_a_text = "virtual machine",
    .tip = "Simulated machine; no hardware required",
    .kind = MachineKind::simulated,
    .options = virtual_options,
    .make = [](const DriverChoice&, const MovedAxes& axes, Clock& clock) -> std::unique_ptr<drivers::Driver> {
        expect_model(axes);
        return std::make_unique<drivers::VirtualMachine>(
            axes.position, drivers::VirtualSpeed{axes.speed}, clock, axes.model);
    }};

} // namespace millwright::machine
