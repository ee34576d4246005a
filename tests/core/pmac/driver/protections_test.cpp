// F1: which protections a card has off, and that the files that ship leave none off.
#include "core/pmac/driver/protections.h"

#include "core/base/files.h"
#include "core/pmac/driver/pmac_file.h"
#include "tests/core/pmac/driver/pmac_wire.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

namespace millwright::pmac {
namespace {

using test::PmacWire;
using testing::ElementsAre;
using testing::IsEmpty;

/// Of the emulated card, when a driver connects to it.
std::vector<std::string> told_off(const std::string& setup, std::string_view letters = "XYZA") {
    const PmacWire wire({}, false, letters, {}, setup);
    return wire.session.protections_off().value();
}

std::string lines_of(const std::string& sample) {
    std::string lines;
    for (const auto& line : read_pmac_file(read_file("assets/samples/" + sample), sample).lines) {
        lines += line.text + "\n";
    }
    return lines;
}

TEST(PmacProtectionsF1, EachThatIsOffIsToldWithWhatItMeans) {
    EXPECT_THAT(
        protections_off(
            {{1, 0.0, 1.0, -1.0, 0xC000}, {2, 32000.0, 0.0, 0.0, 0x13C004}, {4, 0.0, 1.0, -1.0, 0}}),
        ElementsAre("motors 1 and 4 have no following-error limit and are not stopped by it (I111, I411 = 0)",
                    "motor 2 has no upper position limit in the card (I213 = 0)",
                    "motor 2 has no lower position limit in the card (I214 = 0)",
                    "motor 2 keeps its amplifier enabled even if it is killed (I225 bit 16)",
                    "motor 2 runs through its limit switches, which are ignored (I225 bit 17)",
                    "motor 2 continues if its amplifier reports a fault (I225 bit 20)"));
    EXPECT_THAT(protections_off({{1, 32000.0, 21000.0, -21000.0, 0xC000}}), IsEmpty());
    EXPECT_EQ(protections_notice({}), "");
    EXPECT_EQ(protections_notice({"one", "two"}), "Protections disabled in the card:\none\ntwo");
}

TEST(PmacProtectionsF1, TheCardIsAskedWhenItIsConnectedAndAfterCommands) {
    const std::string limits = lines_of("pmac-arm.ini");
    PmacWire wire({}, false, "XYZA", {}, limits + "I111=0\nI225=$13C004\n");
    EXPECT_THAT(wire.session.protections_off().value(), testing::SizeIs(4));
    (void)wire.session.command({"I111=32000", "I225=$C004"}, true);
    wire.pass(1.0);
    EXPECT_THAT(wire.session.protections_off().value(), IsEmpty());
    (void)wire.session.command({"I411=0"}, false);
    wire.pass(1.0);
    EXPECT_THAT(wire.session.protections_off().value(),
                ElementsAre("motor 4 has no following-error limit and is not stopped by it (I411 = 0)"));
}

TEST(PmacProtectionsF1, MotorsThatAreNotActiveHaveNone) {
    EXPECT_THAT(told_off("I100=0\nI200=0\nI300=0\n"),
                ElementsAre("motor 4 has no upper position limit in the card (I413 = 0)",
                            "motor 4 has no lower position limit in the card (I414 = 0)"));
}

TEST(PmacProtectionsF1, TheFilesThatShipSwitchEveryOneOn) {
    std::string off;
    for (int motor = 1; motor <= 5; ++motor) {
        off += "I" + std::to_string(motor) + "11=0\nI" + std::to_string(motor) + "13=0\nI" +
               std::to_string(motor) + "14=0\n";
        off += motor < 5 ? "I" + std::to_string(motor) + "25=$13C000\n" : "";
    }
    EXPECT_THAT(told_off(off), testing::SizeIs(6));
    EXPECT_THAT(told_off(off + lines_of("pmac-arm.ini")), IsEmpty());
    EXPECT_THAT(told_off(off + lines_of("pmac-l3.ini")), IsEmpty());
    EXPECT_THAT(told_off(off + lines_of("pmac-arm.ini") + lines_of("pmac-axis-5.ini"), "XYZAB"), IsEmpty());
}

} // namespace
} // namespace millwright::pmac
