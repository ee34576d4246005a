#include "ui/actions/hand_settings.h"

namespace millwright::actions {

std::string address_for(const HandSettings& hand, std::string_view driver) {
    if (hand.choice.driver == driver) {
        return hand.choice.address;
    }
    const auto given = hand.addresses.find(std::string(driver));
    if (given != hand.addresses.end()) {
        return given->second;
    }
    const auto& address = machine::driver_row(driver).address;
    return address ? std::string(address->usual) : std::string();
}

void choose_driver(HandSettings& hand, std::string_view driver) {
    hand.addresses[hand.choice.driver] = hand.choice.address;
    const std::string address = address_for(hand, driver);
    hand.choice.driver = driver;
    hand.choice.address = address;
}

} // namespace millwright::actions
