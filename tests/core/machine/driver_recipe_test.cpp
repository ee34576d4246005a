// The worked example of docs/dev/recipes.md, "Add a driver": the whole row of a plotter that takes one record
// per move.
#include "core/drivers/records/records_driver.h"
#include "core/links/link.h"
#include "core/machine/driver_row.h"
#include "tests/support/machines.h"
#include "tests/support/scratch_folder.h"

#include <gtest/gtest.h>

#include <array>
#include <memory>
#include <string>
#include <string_view>
#include <variant>

namespace millwright::machine {
namespace {

const std::array<DriverField, 1> plotter_fields{
    {{"relative",
      "Relative",
      "Records contain distances, not positions",
      ToggleField{[](const DriverChoice& choice) { return choice.record && choice.record->relative; },
                  [](DriverChoice& choice, bool on) {
                      choice.record = drivers::RecordFormat{.pattern = "PA{X},{Y}", .relative = on};
                  }}}}};

constexpr std::array<std::string_view, 1> plotter_options{"--port"};

const DriverRow plotter_row{
    .name = "plotter",
    .label = "Plotter",
    .within_a_text = "plotter",
    .tip = "Pen plotter that takes one record per move",
    .kind = MachineKind::positioned,
    .address = DriverAddress{"Port", "Serial port such as /dev/ttyUSB0, or file:PATH"},
    .fields = plotter_fields,
    .note = "The pen must be at zero when the plotter is connected.",
    .options = plotter_options,
    .make = [](const DriverChoice& choice,
               const MovedAxes& axes,
               Clock& clock) -> std::unique_ptr<drivers::Driver> {
        expect_model(axes);
        return std::make_unique<drivers::RecordsDriver>(
            links::make_link(choice.address),
            clock,
            axes.model,
            axes.position,
            drivers::RecordsOptions{.format = choice.record.value_or(drivers::RecordFormat())});
    }};

TEST(DriverRecipe, ARowMakesADriverWithWhatAPersonSet) {
    const test::ScratchFolder scratch;
    DriverChoice choice;
    choice.driver = plotter_row.name;
    choice.address = "file:" + (scratch / "plot.txt").string();
    const auto& relative = std::get<ToggleField>(plotter_row.fields[0].value);
    EXPECT_FALSE(relative.value(choice));
    relative.set(choice, true);
    EXPECT_TRUE(relative.value(choice));

    SteadyClock clock;
    const auto driver =
        plotter_row.make(choice,
                         {std::make_shared<const kinematics::MachineModel>(test::machine("router-xyz")),
                          kinematics::AxisPositions::Zero(3)},
                         clock);
    driver->connect();
    EXPECT_EQ(driver->status().state, drivers::DriverState::idle);
    EXPECT_EQ(driver->address(), choice.address);
}

} // namespace
} // namespace millwright::machine
