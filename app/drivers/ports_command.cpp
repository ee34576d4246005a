#include "app/drivers/driver_commands.h"
#include "core/links/serial_link.h"

#include <fmt/format.h>

namespace millwright::app {

namespace {

int show_ports() {
    const std::vector<links::SerialPort> ports = links::serial_ports();
    for (const links::SerialPort& port : ports) {
        fmt::print("{}{}{}\n", port.path.string(), port.label.empty() ? "" : "  ", port.label);
    }
    if (ports.empty()) {
        fmt::print(stderr, "millwright: no serial ports found\n");
    }
    return 0;
}

} // namespace

void add_ports_command(CLI::App& app, Command& chosen) {
    CLI::App& command = *app.add_subcommand("ports", "List the serial ports");
    command.callback([&chosen] { chosen = show_ports; });
}

} // namespace millwright::app
