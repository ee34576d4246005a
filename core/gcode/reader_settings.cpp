#include "core/gcode/reader_settings.h"

namespace millwright::gcode {

std::optional<Dialect> dialect_of(std::string_view name) {
    if (name == "linuxcnc") {
        return Dialect::linuxcnc;
    }
    if (name == "grbl") {
        return Dialect::grbl;
    }
    return std::nullopt;
}

} // namespace millwright::gcode
