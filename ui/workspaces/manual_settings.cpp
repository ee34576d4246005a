#include "ui/workspaces/manual_settings.h"

namespace millwright::actions {

std::string address_for(const ManualSettings& manual, std::string_view driver) {
    if (manual.choice.driver == driver) {
        return manual.choice.address;
    }
    const auto given = manual.addresses.find(std::string(driver));
    if (given != manual.addresses.end()) {
        return given->second;
    }
    const auto& address = machine::driver_row(driver).address;
    return address ? std::string(address->usual) : std::string();
}

void choose_driver(ManualSettings& manual, std::string_view driver) {
    manual.addresses[manual.choice.driver] = manual.choice.address;
    const std::string address = address_for(manual, driver);
    manual.choice.driver = driver;
    manual.choice.address = address;
}

} // namespace millwright::actions
