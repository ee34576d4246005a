#include "core/pmac_service/maestro_amplifier.h"

#include "core/base/error.h"
#include "tests/support/without_traps.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace millwright::pmac {
namespace {

// C4: the corrected formulas against the printed tables, resistors of the E24 series or nearly so.
TEST(MaestroAmplifierC4, GivesTheTableOfNominalCurrents) {
    int fitted = 0;
    for (const FittedResistor& row : nominal_current_table()) {
        const ResistorValue value = nominal_current_resistor(row.current, row.peak);
        ASSERT_EQ(value.corrected.has_value(), row.kilo_ohm.has_value()) << row.model << " " << row.current;
        if (row.kilo_ohm) {
            ++fitted;
            EXPECT_NEAR(*value.corrected, *row.kilo_ohm, 0.09 * *row.kilo_ohm);
            EXPECT_NEAR(*value.printed, 10.0 * *value.corrected, 1e-9);
        }
    }
    EXPECT_EQ(fitted, 9);
    EXPECT_NEAR(nominal_current_resistor(7.0, 16.0).corrected.value(), 18.18, 0.005);
    EXPECT_NEAR(nominal_current_resistor(4.0, 28.0).corrected.value(), 1.04, 0.005);
}

TEST(MaestroAmplifierC4, GivesMostOfTheTableOfPeakCurrents) {
    int near = 0, far = 0;
    for (const FittedResistor& row : peak_current_table()) {
        const auto value = peak_current_resistor(row.peak / 2.0, row.current, row.peak).corrected;
        ASSERT_EQ(value.has_value(), row.kilo_ohm.has_value());
        if (value) {
            ++(std::abs(*value - *row.kilo_ohm) < 0.2 * *row.kilo_ohm ? near : far);
        }
    }
    EXPECT_EQ(near, 7);
    EXPECT_EQ(far, 3); // 14 of 8/16, 26 and 24 of 14/28: no formula is known
    EXPECT_NEAR(peak_current_resistor(4.0, 8.0, 16.0).printed.value(), 1100.0, 1e-9);
}

TEST(MaestroAmplifierC4, GivesResistorsForTheTachometer) {
    EXPECT_NEAR(speed_resistor(3000.0, 7.0).value(), 200.0 * 16.0, 1e-9);
    EXPECT_NEAR(speed_resistor(1000.0, 5.0).value(), 0.0, 1e-9); // a bridge
    EXPECT_FALSE(speed_resistor(500.0, 7.0).has_value());
    EXPECT_NEAR(tacho_loss_resistor(3000.0, 7.0).value(), 183000.0 * 0.428, 1e-6);
    EXPECT_FALSE(tacho_loss_resistor(1000.0, 7.0).has_value());
}

TEST(MaestroAmplifierC4, RefusesWhatIsNoCurrentOrSpeed) {
    const test::WithoutTraps without_traps;
    EXPECT_THROW((void)speed_resistor(0.0, 7.0), Error);
    EXPECT_THROW((void)tacho_loss_resistor(3000.0, std::nan("")), Error);
    EXPECT_THROW((void)nominal_current_resistor(-1.0, 16.0), Error);
    EXPECT_THROW((void)peak_current_resistor(4.0, std::numeric_limits<double>::infinity(), 16.0), Error);
}

} // namespace
} // namespace millwright::pmac
