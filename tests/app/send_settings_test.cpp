// Programs that are sent to a Grbl whose settings and modes decide what they do.
#include "tests/app/emulator.h"
#include "tests/app/sending.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>

#include <string>

namespace millwright::test {
namespace {

using testing::HasSubstr;

TEST_F(Send, ChecksTheTravelInTheModesThatTheControllerIsIn) {
    const std::string eeprom = (scratch / "eeprom").string();
    write_content(eeprom, "$N0=G20G54\n");
    write_content(file, "G90 G54\nG0 X10\nG0 X0\nM30\n");
    Emulator emulator(port, {"--eeprom", eeprom});
    const Ended inches = run(words());
    EXPECT_EQ(inches.exit_code, 1);
    EXPECT_THAT(inches.err, HasSubstr("254.000 mm, but its travel is only 200.000 mm"));
    EXPECT_THAT(inches.out, HasSubstr("from the modes of the controller: G0 G54 G17 G20"));
}

/// A program that does not name G90, at a controller that begins in G91: 10, 20 and 10 mm are 40.
TEST_F(Send, ChecksTheTravelOfAProgramWithoutG90WhereTheControllerIsInG91) {
    const std::string eeprom = (scratch / "eeprom").string();
    write_content(file, "G21\nG0 X10\nG0 X20\nG0 X10\nM30\n");
    for (const bool fits : {false, true}) {
        write_content(eeprom, fits ? "$N0=G91\n$130=41\n" : "$N0=G91\n$130=39\n");
        Emulator emulator(port, {"--eeprom", eeprom, "--speed", "20"});
        const Ended ended = run(words());
        EXPECT_EQ(ended.exit_code, fits ? 0 : 1) << ended.err;
        if (fits) {
            EXPECT_EQ(last_record(logs).at("position"), nlohmann::json({40.0, 0.0, 0.0}));
        } else {
            EXPECT_THAT(ended.err,
                        HasSubstr("zigzag.ngc:4: axis X would move from 0.000 mm to 40.000 mm in machine "
                                  "coordinates, a distance of 40.000 mm, but its travel is only 39.000 mm"));
            EXPECT_TRUE(last_record(logs).is_null()) << "nothing was sent";
        }
        (void)emulator.stop();
    }
}

TEST_F(Send, EndsWhereTheWorkSystemsOfTheProgramSay) {
    const std::string eeprom = (scratch / "eeprom").string();
    write_content(file, "G21 G90 G54\nG0 X0 Y0 Z5\nG1 X10 F1200\nG1 Y10\nG55\nG0 X0 Y0\nG1 X10\nM30\n");
    for (const char* const reports : {"$10=0", "$10=1", "$10=2"}) {
        write_content(eeprom, std::string(reports) + "\nG55=30,-5,2\n");
        Emulator emulator(port, {"--eeprom", eeprom, "--speed", "20"});
        auto trusting = words();
        trusting.emplace_back("--trust-position"); // a stored offset at a Grbl that was just switched on
        const Ended ended = run(trusting);
        EXPECT_EQ(ended.exit_code, 0) << ended.err;
        EXPECT_THAT(ended.out, HasSubstr("All 8 blocks were executed"));
        // M30 brings G54 back, which is zero: these are machine coordinates.
        EXPECT_EQ(last_record(logs).at("position"), nlohmann::json({40.0, -5.0, 5.0})) << reports;
        (void)emulator.stop();
    }
}

TEST_F(Send, SaysWhichAlarmEndedAHoming) {
    const std::string eeprom = (scratch / "eeprom").string();
    write_content(eeprom, "$22=1\n$130=20\n$131=20\n$132=20\n$25=3000\n");
    write_content(file, "G21 G90\nG53 G0 X-5 Y-5 Z-2\nM30\n");
    Emulator emulator(port, {"--eeprom", eeprom, "--no-switches", "--speed", "10"});
    auto homing = words();
    homing.emplace_back("--home");
    const Ended ended = run(homing);
    EXPECT_EQ(ended.exit_code, 1);
    EXPECT_THAT(ended.err, HasSubstr("alarm 9: homing failed: no limit switch was found"));
    EXPECT_THAT(ended.err, testing::Not(HasSubstr("stopping")));
    EXPECT_TRUE(last_record(logs).is_null()) << "the program was not begun";
}

TEST_F(Send, RefusesMistWhereGrblWasBuiltWithoutIt) {
    write_content(file, "G21 G90\nM7\nG0 X1\nM30\n");
    {
        Emulator emulator(port, {"--speed", "20"});
        const Ended ended = run(words());
        EXPECT_EQ(ended.exit_code, 1);
        EXPECT_THAT(ended.err,
                    HasSubstr("zigzag.ngc:2:1: this Grbl does not support mist coolant, M7 (error 20)"));
        (void)emulator.stop();
    }
    Emulator emulator(port, {"--speed", "20", "--mist"});
    EXPECT_EQ(run(words()).exit_code, 0);
}

} // namespace
} // namespace millwright::test
