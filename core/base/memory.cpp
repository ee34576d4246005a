#include "core/base/memory.h"

#include <fstream>
#include <limits>
#include <string>

namespace millwright {

std::optional<std::size_t> free_memory() {
    constexpr std::size_t kibibyte = 1024;
    std::ifstream lines("/proc/meminfo"); // of Linux: lines of "MemAvailable:   20480 kB"
    std::string name;
    std::size_t amount = 0;
    while (lines >> name >> amount) {
        if (name == "MemAvailable:") {
            return amount * kibibyte;
        }
        lines.ignore(std::numeric_limits<std::streamsize>::max(), '\n');
    }
    return std::nullopt;
}

} // namespace millwright
