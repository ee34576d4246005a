#include "core/drivers/records/records_driver.h"
#include "core/links/link.h"
#include "core/machine/internal/driver_rows.h"

#include <array>

namespace millwright::machine {

namespace {

using drivers::RecordFormat;

RecordFormat format_of(const DriverChoice& choice) {
    return choice.record.value_or(RecordFormat());
}

/// From then on the records are a person's own.
template <auto member, class Value> void change(DriverChoice& choice, const Value& value) {
    RecordFormat changed = format_of(choice);
    changed.*member = value;
    choice.record = changed;
}

template <auto member> std::string text_of(const DriverChoice& choice) {
    return format_of(choice).*member;
}

constexpr std::array<DriverField, 4> records_fields{
    {{"record",
      "Record",
      "Record format: axis letters in braces, {s} speed, {a} acceleration",
      TextField{text_of<&RecordFormat::pattern>, change<&RecordFormat::pattern, std::string>}},
     {"ending",
      {},
      {},
      LineEndField{text_of<&RecordFormat::ending>, change<&RecordFormat::ending, std::string>}},
     {"answer",
      "Response",
      "Response to each record; empty: none",
      TextField{text_of<&RecordFormat::answer>, change<&RecordFormat::answer, std::string>}},
     {"relative",
      "Relative",
      "Records contain distances, not positions",
      ToggleField{[](const DriverChoice& choice) { return format_of(choice).relative; },
                  [](DriverChoice& choice, bool on) { change<&RecordFormat::relative>(choice, on); }}}}};

constexpr std::array<std::string_view, 6> records_options{
    "--port", "--record", "--ending", "--relative", "--answer", "--patience"};

} // namespace

constinit const DriverRow records_row{
    .name = "records",
    .label = "Record-based XYZ table",
    .within_a_text = "XYZ table",
    .tip = "XYZ table that takes one record per move, such as t x y z a s",
    .kind = MachineKind::positioned,
    .address = DriverAddress{"Port", "Serial port such as /dev/ttyUSB0, tcp:HOST:PORT, or file:PATH"},
    .fields = records_fields,
    .note = "When it is connected, the table must be at the start point of the program, otherwise at zero.",
    .options = records_options,
    .make = [](const DriverChoice& choice,
               const MovedAxes& axes,
               Clock& clock) -> std::unique_ptr<drivers::Driver> {
        expect_model(axes);
        return std::make_unique<drivers::RecordsDriver>(
            links::make_link(choice.address),
            clock,
            axes.model,
            axes.position,
            drivers::RecordsOptions{.format = format_of(choice), .known = axes.known});
    }};

} // namespace millwright::machine
