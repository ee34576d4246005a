#include "core/pmac_service/pmac_wiring.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <string>

namespace millwright::pmac {
namespace {

// C5.
TEST(PmacWiringC5, NoSignalSharesAPinOfAMotorWithAnother) {
    std::map<int, std::string> of_pin;
    for (const PmacPin& pin : pmac_pins()) {
        for (const int number : pin.of_motor) {
            ASSERT_GE(number, 0);
            ASSERT_LE(number, 60);
            if (number > 0) {
                const auto [known, added] = of_pin.emplace(number, pin.signal);
                EXPECT_EQ(known->second, pin.signal) << "pin " << number;
            }
        }
    }
}

TEST(PmacWiringC5, MarksWhatSourcesDisagreeAbout) {
    for (const PmacPin& pin : pmac_pins()) {
        const bool supply = pin.signal == "+5 V" || pin.signal == "GND";
        EXPECT_EQ(pin.trust == PinTrust::conflict, supply) << pin.signal;
        EXPECT_EQ(pin.trust == PinTrust::conflict, name_of(pin.trust) == "check before wiring");
    }
    EXPECT_TRUE(std::ranges::any_of(pmac_jumpers(), [](const PmacJumper& jumper) {
        return jumper.jumper == "E44-E47" && jumper.trust == PinTrust::conflict;
    }));
}

TEST(PmacWiringC5, TrustsTheThesisAloneOfTheOtherMotors) {
    const auto trust = [](std::string_view signal, int motor) {
        return trust_of(*std::ranges::find(pmac_pins(), signal, &PmacPin::signal), motor);
    };
    EXPECT_EQ(trust("DAC", 1), PinTrust::confirmed);
    EXPECT_EQ(trust("DAC", 2), PinTrust::thesis);
    EXPECT_EQ(trust("CHC/", 4), PinTrust::thesis);
    EXPECT_EQ(trust("AGND", 3), PinTrust::confirmed); // one pin for all
    EXPECT_EQ(trust("+5 V", 3), PinTrust::conflict);
}

TEST(PmacWiringC5, LimitInputsStopTheOtherDirection) {
    const auto plus = std::ranges::find(pmac_pins(), "+LIM", &PmacPin::signal);
    ASSERT_NE(plus, pmac_pins().end());
    EXPECT_EQ(plus->of_motor[0], 53);
    EXPECT_NE(plus->note.find("negative"), std::string_view::npos);
}

} // namespace
} // namespace millwright::pmac
