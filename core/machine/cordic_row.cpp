#include "core/cordic_machine/cordic_driver.h"
#include "core/machine/internal/driver_rows.h"

#include <array>

namespace millwright::machine {

namespace {

constexpr std::array<std::string_view, 2> cordic_options{"--speed", "--clock"};

} // namespace

constinit const DriverRow cordic_row{
    .name = "cordic",
    .label = "CORDIC processor",
    .within_a_text = "CORDIC processor",
    .tip = "Simulated G-code processor with a simulated machine; X, Y and Z only",
    .kind = MachineKind::simulated,
    .options = cordic_options,
    .make = [](const DriverChoice&, const MovedAxes& axes, Clock& clock) -> std::unique_ptr<drivers::Driver> {
        expect_model(axes);
        return std::make_unique<cordic_machine::CordicDriver>(
            axes.position, drivers::VirtualSpeed{axes.speed}, clock, axes.model);
    }};

} // namespace millwright::machine
