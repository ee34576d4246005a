#include "core/machine/drivers_by_name.h"

#include "core/arm/arm_file.h"
#include "core/base/error.h"
#include "tests/support/machines.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <variant>

namespace millwright::machine {
namespace {

using testing::HasSubstr;

std::string driver_refusal(const std::function<void()>& what) {
    try {
        what();
    } catch (const Error& error) {
        return error.what();
    }
    return "nothing was refused";
}

MovedAxes router_and_arm() {
    return {std::make_shared<const kinematics::MachineModel>(test::machine("router-xyz")),
            kinematics::AxisPositions::Zero(3),
            1.0,
            std::make_shared<const arm::ArmModel>(arm::read_arm("assets/arms/motoman-l3.json").arm)};
}

DriverChoice choice_of(std::string_view driver, std::string address = {}) {
    DriverChoice choice;
    choice.driver = driver;
    choice.address = std::move(address);
    return choice;
}

TEST(MakeDriver, MakesEachDriverUnderItsName) {
    SteadyClock clock;
    for (const DriverRow& row : driver_rows()) {
        const auto driver = make_driver(choice_of(row.name, "tcp:127.0.0.1:9"), router_and_arm(), clock);
        EXPECT_EQ(driver->name(), row.name);
        EXPECT_EQ(&driver_row(driver->name()), &row);
        EXPECT_EQ(driver->status().state, drivers::DriverState::disconnected) << driver->name();
    }
}

TEST(DriverRows, AreComplete) {
    std::set<std::string_view> names;
    for (const DriverRow& row : driver_rows()) {
        EXPECT_TRUE(names.insert(row.name).second) << row.name << " stands twice";
        EXPECT_FALSE(row.label.empty() || row.within_a_text.empty() || row.tip.empty()) << row.name;
        EXPECT_EQ(row.address.has_value(), row.kind != MachineKind::simulated) << row.name;
        EXPECT_EQ(row.arm.empty(), row.kind != MachineKind::arm) << row.name;
        EXPECT_EQ(std::ranges::count(row.options, "--port"), row.address ? 1 : 0) << row.name;
        for (const std::string_view option : row.options) {
            EXPECT_TRUE(option.starts_with("--")) << row.name << ": " << option;
        }
    }
}

/// Sets another value than there is, and reads it again.
struct ReadsBack {
    DriverChoice& choice;

    bool operator()(const ToggleField& field) const {
        const bool wanted = !field.value(choice);
        field.set(choice, wanted);
        return field.value(choice) == wanted;
    }
    bool operator()(const TextField& field) const { return text(field); }
    bool operator()(const LineEndField& field) const { return text(field); }
    bool operator()(const NumberField& field) const {
        field.set(choice, field.least);
        const bool reads_back = std::equal_to{}(field.value(choice), field.least);
        return reads_back && field.least < field.usual && field.usual < field.most;
    }
    template <class Field> bool text(const Field& field) const {
        const std::string wanted = field.value(choice) + "B";
        field.set(choice, wanted);
        return field.value(choice) == wanted;
    }
};

TEST(DriverRows, EachFieldChangesWhatItShowsAndNothingElse) {
    for (const DriverRow& row : driver_rows()) {
        for (const DriverField& field : row.fields) {
            DriverChoice choice = choice_of(row.name);
            EXPECT_TRUE(std::visit(ReadsBack{choice}, field.value)) << row.name << " " << field.id;
            EXPECT_NE(choice, choice_of(row.name)) << row.name << " " << field.id;
            EXPECT_EQ(choice.driver, row.name) << field.id;
            EXPECT_TRUE(choice.address.empty()) << row.name << " " << field.id;
        }
    }
}

TEST(DriverRows, AnUnknownNameIsRefusedWithThoseThatThereAre) {
    try {
        (void)driver_row("marlin");
        FAIL() << "nothing was refused";
    } catch (const Error& error) {
        EXPECT_THAT(error.what(), HasSubstr("marlin"));
        EXPECT_EQ(error.diagnostic().hint, "use virtual, grbl, linuxcnc, stream, cordic, records or pmac");
    }
}

TEST(MakeDriver, TellsThatLinuxCncJogsThreeAxesAndOverridesTheFeedAlone) {
    SteadyClock clock;
    DriverChoice choice = choice_of("linuxcnc", "tcp:127.0.0.1:9");
    choice.axes = "XYZAC";
    const drivers::Capabilities can = make_driver(choice, {}, clock)->capabilities();
    EXPECT_EQ(can.axes.size(), 5U);
    EXPECT_EQ(can.manual.jog_axes, "XYZ");
    EXPECT_EQ(can.overrides, drivers::Capabilities::OverrideRange::feed);
}

TEST(MakeDriver, RefusesWhatItCannotMake) {
    SteadyClock clock;
    for (const char* const kind : {"grbl", "linuxcnc", "stream"}) {
        EXPECT_THAT(driver_refusal([&] { (void)make_driver(choice_of(kind), router_and_arm(), clock); }),
                    HasSubstr("no port is specified"));
    }
    for (const char* const kind : {"virtual", "stream", "cordic"}) {
        const DriverChoice choice = choice_of(kind, "tcp:127.0.0.1:9");
        EXPECT_THAT(driver_refusal([&] { (void)make_driver(choice, {}, clock); }),
                    HasSubstr("no machine is loaded"));
    }
    EXPECT_THAT(driver_refusal([&] { (void)make_driver(choice_of("pmac", "tcp:127.0.0.1:9"), {}, clock); }),
                HasSubstr("no arm"));
    DriverChoice axes = choice_of("linuxcnc", "tcp:127.0.0.1:9");
    axes.axes = "XYW";
    EXPECT_THAT(driver_refusal([&] { (void)make_driver(axes, {}, clock); }), HasSubstr("XYW"));
}

TEST(MakeDriver, SendsAStreamIntoAFileFasterThanItsPeriod) {
    const test::ScratchFolder scratch;
    SteadyClock clock;
    DriverChoice choice = choice_of("stream", "file:" + (scratch / "out.txt").string());
    choice.period = 1.0; // paced, this would be an hour
    const auto driver = make_driver(choice, router_and_arm(), clock);
    driver->connect();
    (void)driver->command("G21 G91 G94 G1 X100 F1.7");
    while (driver->status().activity != drivers::Activity::none) {
        clock.wait(0.001);
    }
    EXPECT_NEAR(driver->status().position[0], 100.0, 1e-9);
}

} // namespace
} // namespace millwright::machine
