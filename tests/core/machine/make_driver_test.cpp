#include "core/machine/make_driver.h"

#include "core/arm/arm_file.h"
#include "core/base/error.h"
#include "tests/support/machines.h"
#include "tests/support/scratch_folder.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <array>
#include <functional>
#include <string>
#include <utility>

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

DriverChoice choice_of(DriverKind kind, std::string address = {}) {
    DriverChoice choice;
    choice.kind = kind;
    choice.address = std::move(address);
    return choice;
}

constexpr std::array driver_kinds{DriverKind::virtual_machine,
                                  DriverKind::grbl,
                                  DriverKind::linuxcnc,
                                  DriverKind::stream,
                                  DriverKind::cordic,
                                  DriverKind::pmac};

TEST(MakeDriver, MakesEachKindUnderItsName) {
    SteadyClock clock;
    for (const DriverKind kind : driver_kinds) {
        const auto driver = make_driver(choice_of(kind, "tcp:127.0.0.1:9"), router_and_arm(), clock);
        EXPECT_EQ(driver->name(), to_text(kind));
        EXPECT_EQ(driver_kind(driver->name()), kind);
        EXPECT_EQ(driver->status().state, drivers::DriverState::disconnected) << driver->name();
    }
}

TEST(MakeDriver, TellsThatLinuxCncJogsThreeAxesAndOverridesTheFeedAlone) {
    SteadyClock clock;
    DriverChoice choice = choice_of(DriverKind::linuxcnc, "tcp:127.0.0.1:9");
    choice.axes = "XYZAC";
    const drivers::Capabilities can = make_driver(choice, {}, clock)->capabilities();
    EXPECT_EQ(can.axes.size(), 5U);
    EXPECT_EQ(can.jog_axes, "XYZ");
    EXPECT_TRUE(can.overrides);
    EXPECT_FALSE(can.other_overrides);
}

TEST(MakeDriver, RefusesWhatItCannotMake) {
    SteadyClock clock;
    for (const DriverKind kind : {DriverKind::grbl, DriverKind::linuxcnc, DriverKind::stream}) {
        EXPECT_THAT(driver_refusal([&] { (void)make_driver(choice_of(kind), router_and_arm(), clock); }),
                    HasSubstr("no port is specified"));
    }
    for (const DriverKind kind : {DriverKind::virtual_machine, DriverKind::stream, DriverKind::cordic}) {
        const DriverChoice choice = choice_of(kind, "tcp:127.0.0.1:9");
        EXPECT_THAT(driver_refusal([&] { (void)make_driver(choice, {}, clock); }),
                    HasSubstr("no machine is loaded"));
    }
    EXPECT_THAT(
        driver_refusal([&] { (void)make_driver(choice_of(DriverKind::pmac, "tcp:127.0.0.1:9"), {}, clock); }),
        HasSubstr("no arm"));
    DriverChoice axes = choice_of(DriverKind::linuxcnc, "tcp:127.0.0.1:9");
    axes.axes = "XYW";
    EXPECT_THAT(driver_refusal([&] { (void)make_driver(axes, {}, clock); }), HasSubstr("XYW"));
    EXPECT_THAT(driver_refusal([] { (void)driver_kind("marlin"); }), HasSubstr("marlin"));
}

TEST(MakeDriver, SendsAStreamIntoAFileFasterThanItsPeriod) {
    const test::ScratchFolder scratch;
    SteadyClock clock;
    DriverChoice choice = choice_of(DriverKind::stream, "file:" + (scratch / "out.txt").string());
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
