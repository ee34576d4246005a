#include "core/base/error.h"
#include "core/links/link.h"
#include "core/machine/internal/driver_rows.h"
#include "core/pmac/driver/arm_axes.h"
#include "core/pmac/driver/pmac_driver.h"

#include <array>
#include <utility>

namespace millwright::machine {

namespace {

/// A busy computer may be late with an answer. Meanwhile no sign of life is sent, and the card's watchdog
/// stops its motors, so that nothing depends on how long that is waited for.
constexpr double pmac_patience = 3.0; // s

constexpr std::array<DriverField, 1> pmac_fields{
    {{"fifth_axis",
      "Axis 5",
      "Motor 5 drives joint 5, on a second row of outputs or simulated in the card; the card must be "
      "configured for it",
      ToggleField{[](const DriverChoice& choice) { return choice.axes.find('B') != std::string::npos; },
                  [](DriverChoice& choice, bool on) { choice.axes = on ? "XYZAB" : "XYZA"; }}}}};

constexpr std::array<std::string_view, 8> pmac_options{
    "--port", "--unlock", "--home", "--trust-position", "--axes", "--power", "--keep-power", "--arm"};

} // namespace

constinit const DriverRow pmac_row{
    .name = "pmac",
    .label = "PMAC",
    .within_a_text = "PMAC",
    .tip = "Motor controller card of a robot arm, on a serial port or TCP address",
    .kind = MachineKind::arm,
    .address = DriverAddress{.label = "Port",
                             .tip = "Serial port such as /dev/ttyUSB0, or tcp:HOST:PORT",
                             .usual = "tcp:127.0.0.1:1025"},
    .fields = pmac_fields,
    .note = "Drives the joints of a Motoman L-3. Connecting does not move the arm.",
    .arm = "motoman-l3",
    .runs_projects = false,
    .in_alarm = "Inspect the arm, then unlock it. Unlocking does not enable the motors.",
    .why_no_home_in_alarm = "Alarm: inspect the arm, then unlock it.",
    .options = pmac_options,
    .make = [](const DriverChoice& choice,
               const MovedAxes& axes,
               Clock& clock) -> std::unique_ptr<drivers::Driver> {
        if (!axes.arm) {
            throw Error("no arm is loaded whose joints the card could move");
        }
        pmac::PmacSettings settings = pmac::within_limits(pmac::arm_settings_of(choice.axes), *axes.arm);
        settings.patience = pmac_patience;
        return std::make_unique<pmac::PmacDriver>(
            links::make_link(choice.address), clock, std::move(settings));
    }};

} // namespace millwright::machine
