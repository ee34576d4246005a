#include "ui/panels/serial_fields.h"

#include "core/base/error.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <vector>

namespace millwright::panels {

namespace {

using links::SerialAddress;
using widgets::Option;

// In the order of their enumerators.
constexpr std::array<Option, 3> serial_parities{
    {{"none", "None", {}, {}}, {"even", "Even", {}, {}}, {"odd", "Odd", {}, {}}}};
constexpr std::array<Option, 2> serial_stops{{{"one", "1", {}, {}}, {"two", "2", {}, {}}}};

constexpr std::array<Option, 3> endings{
    {{"lf", "LF (line feed)", {}, {}}, {"crlf", "CR + LF", {}, {}}, {"cr", "CR", {}, {}}}};
constexpr std::array<std::string_view, 3> ending_bytes{"\n", "\r\n", "\r"};

} // namespace

std::optional<SerialAddress> serial_port_of(const std::string& address) {
    if (!links::is_serial_address(address)) {
        return std::nullopt;
    }
    try {
        return links::parse_serial_address(address);
    } catch (const Error&) { // said where it is connected to
        return std::nullopt;
    }
}

std::optional<std::string> serial_fields(widgets::Ui& ui, const std::string& address) {
    const std::optional<SerialAddress> now = serial_port_of(address);
    if (!now) {
        return std::nullopt;
    }
    const auto section = ui.section("serial", "Serial port settings", false);
    if (!section) {
        return std::nullopt;
    }
    std::vector<std::string> names;
    for (const unsigned rate : links::serial_rates) {
        names.push_back(std::to_string(rate));
    }
    std::vector<Option> rates;
    for (const std::string& name : names) {
        rates.push_back({name, name, {}, {}});
    }
    SerialAddress changed = *now;
    const auto* const rate = std::ranges::find(links::serial_rates, now->line.baud);
    if (const auto n =
            ui.choice("rate", "Baud rate", static_cast<int>(rate - links::serial_rates.begin()), rates)) {
        changed.line.baud = links::serial_rates[static_cast<std::size_t>(*n)];
    }
    if (const auto n = ui.choice("parity", "Parity", static_cast<int>(now->line.parity), serial_parities)) {
        changed.line.parity = static_cast<links::SerialParity>(*n);
    }
    if (const auto n = ui.choice("stop_bits", "Stop bits", now->line.stop_bits - 1, serial_stops)) {
        changed.line.stop_bits = *n + 1;
    }
    return changed == *now ? std::nullopt : std::optional(links::address_of(changed));
}

std::optional<std::string> ending_field(widgets::Ui& ui, const std::string& ending) {
    const auto* const at = std::ranges::find(ending_bytes, ending);
    const auto chosen =
        ui.choice("ending", "Line ending", static_cast<int>(at - ending_bytes.begin()), endings);
    return chosen ? std::optional<std::string>(ending_bytes[static_cast<std::size_t>(*chosen)])
                  : std::nullopt;
}

} // namespace millwright::panels
