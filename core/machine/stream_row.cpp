#include "core/drivers/stream/stream_driver.h"
#include "core/links/link.h"
#include "core/machine/internal/driver_rows.h"

#include <array>

namespace millwright::machine {

namespace {

constexpr double ms_per_s = 1e3;

constexpr std::array<DriverField, 1> stream_fields{
    {{"period",
      "Period",
      "Sample period",
      NumberField{[](const DriverChoice& choice) { return ms_per_s * choice.period; },
                  [](DriverChoice& choice, double ms) { choice.period = ms / ms_per_s; },
                  "ms",
                  0.5,
                  1000.0,
                  10.0,
                  1}}}};

constexpr std::array<std::string_view, 7> stream_options{
    "--port", "--period", "--record", "--ending", "--relative", "--answer", "--patience"};

} // namespace

constinit const DriverRow stream_row{
    .name = "stream",
    .label = "Coordinate stream",
    .within_a_text = "coordinate stream",
    .tip = "Machine that receives axis positions at a fixed rate and sends no feedback",
    .kind = MachineKind::positioned,
    .address = DriverAddress{"Port", "Serial port such as /dev/ttyUSB0, tcp:HOST:PORT, or file:PATH"},
    .fields = stream_fields,
    .note = "This machine sends no feedback. It must be at zero when it is connected.",
    .options = stream_options,
    .make = [](const DriverChoice& choice,
               const MovedAxes& axes,
               Clock& clock) -> std::unique_ptr<drivers::Driver> {
        expect_model(axes);
        const bool to_file = choice.address.starts_with("file:");
        return std::make_unique<drivers::StreamDriver>(
            links::make_link(choice.address),
            clock,
            axes.model,
            axes.position,
            drivers::StreamOptions{
                .period = choice.period, .paced = !to_file, .record = choice.record, .known = axes.known});
    }};

} // namespace millwright::machine
