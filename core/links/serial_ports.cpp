#include "core/links/serial_ports.h"

#include <algorithm>
#include <array>
#include <map>
#include <string_view>
#include <system_error>

namespace millwright::links {

namespace fs = std::filesystem;

namespace {

bool is_port(const std::string& name) {
    constexpr std::array<std::string_view, 4> beginnings = {"ttyUSB", "ttyACM", "ttyAMA", "rfcomm"};
    return std::ranges::any_of(beginnings, [&](std::string_view one) { return name.starts_with(one); });
}

/// /dev/serial/by-id names ports after maker, model and serial number.
std::map<fs::path, std::string> labels(const fs::path& devices) {
    std::map<fs::path, std::string> found;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(devices / "serial" / "by-id", ignored)) {
        found[fs::weakly_canonical(entry.path(), ignored).filename()] = entry.path().filename().string();
    }
    return found;
}

} // namespace

std::vector<SerialPort> serial_ports(const fs::path& devices) {
    const auto known = labels(devices);
    std::vector<SerialPort> found;
    std::error_code ignored;
    for (const auto& entry : fs::directory_iterator(devices, ignored)) {
        const fs::path name = entry.path().filename();
        if (is_port(name.string())) {
            const auto label = known.find(name);
            found.push_back({entry.path(), label == known.end() ? std::string() : label->second});
        }
    }
    std::ranges::sort(found, {}, &SerialPort::path);
    return found;
}

} // namespace millwright::links
