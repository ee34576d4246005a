#include "core/drivers/linuxcnc/linuxcnc_driver.h"
#include "core/links/link.h"
#include "core/machine/internal/driver_rows.h"

#include <array>

namespace millwright::machine {

namespace {

constexpr std::array<DriverField, 1> linuxcnc_fields{
    {{"axes",
      "Axes",
      "Axis letters of the machine: XYZ, followed by any of ABC",
      TextField{[](const DriverChoice& choice) { return choice.axes; },
                [](DriverChoice& choice, const std::string& axes) { choice.axes = axes; }}}}};

constexpr std::array<std::string_view, 6> linuxcnc_options{
    "--port", "--trace-box", "--unlock", "--home", "--trust-position", "--axes"};

} // namespace

constinit const DriverRow linuxcnc_row{
    .name = "linuxcnc",
    .label = "LinuxCNC",
    .within_a_text = "LinuxCNC",
    .tip = "A running LinuxCNC, connected through linuxcncrsh",
    .address = DriverAddress{.label = "Address",
                             .tip = "tcp:HOST:PORT of linuxcncrsh; the usual port is 5007",
                             .usual = "tcp:127.0.0.1:5007",
                             .serial = false},
    .fields = linuxcnc_fields,
    .runs_projects = false,
    .in_alarm =
        "Inspect the machine and unlock it, then home it unless you are sure the position is correct.",
    .why_no_home_in_alarm = "LinuxCNC homes after it is switched on: unlock it first.",
    .options = linuxcnc_options,
    .make =
        [](const DriverChoice& choice, const MovedAxes&, Clock& clock) -> std::unique_ptr<drivers::Driver> {
        drivers::LinuxCncOptions wanted;
        wanted.axes = choice.axes;
        return std::make_unique<drivers::LinuxCncDriver>(links::make_link(choice.address), clock, wanted);
    }};

} // namespace millwright::machine
