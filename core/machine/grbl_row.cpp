#include "core/drivers/grbl/grbl_driver.h"
#include "core/links/link.h"
#include "core/machine/internal/driver_rows.h"

#include <array>

namespace millwright::machine {

namespace {

constexpr std::array<DriverField, 1> grbl_fields{
    {{"one_by_one",
      "Send line by line",
      "Wait for the response to each line before sending the next. Slower; for controllers with a small "
      "buffer",
      ToggleField{[](const DriverChoice& choice) { return choice.one_by_one; },
                  [](DriverChoice& choice, bool on) { choice.one_by_one = on; }}}}};

constexpr std::array<std::string_view, 12> grbl_options{"--port",
                                                        "--one-by-one",
                                                        "--check",
                                                        "--check-only",
                                                        "--trace-box",
                                                        "--tool-change",
                                                        "--tool-sensor",
                                                        "--spin-up",
                                                        "--right-tool",
                                                        "--unlock",
                                                        "--home",
                                                        "--trust-position"};

} // namespace

constinit const DriverRow grbl_row{
    .name = "grbl",
    .label = "Grbl",
    .within_a_text = "Grbl",
    .tip = "Grbl 1.1, grblHAL or FluidNC controller on a serial port or TCP address",
    .address = DriverAddress{"Port", "Serial port such as /dev/ttyUSB0, or tcp:HOST:PORT"},
    .fields = grbl_fields,
    .options = grbl_options,
    .make =
        [](const DriverChoice& choice, const MovedAxes&, Clock& clock) -> std::unique_ptr<drivers::Driver> {
        return std::make_unique<drivers::GrblDriver>(
            links::make_link(choice.address), clock, drivers::GrblOptions{.one_by_one = choice.one_by_one});
    }};

} // namespace millwright::machine
