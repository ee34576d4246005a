#include "core/machine/emulators/grbl/internal/report.h"

#include "core/base/text.h"

#include <fmt/format.h>

namespace millwright::machine::emulated {

namespace {

constexpr int report_mask = 10;
constexpr unsigned machine_position_bit = 1;
constexpr unsigned buffer_bit = 2;

std::string length(double value, const Eeprom& eeprom) {
    return eeprom.is_on(report_inches_setting) ? fixed(value / mm_per_inch, 4) : fixed(value, 3);
}

Axes difference(const Axes& from, const Axes& subtract) {
    return {from[0] - subtract[0], from[1] - subtract[1], from[2] - subtract[2]};
}

} // namespace

std::string coordinates(const Axes& axes, const Eeprom& eeprom) {
    return length(axes[0], eeprom) + "," + length(axes[1], eeprom) + "," + length(axes[2], eeprom);
}

std::string StatusReport::text(const Snapshot& now, const Eeprom& eeprom, bool busy) {
    const auto mask = static_cast<unsigned>(eeprom.setting(report_mask));
    const bool machine = (mask & machine_position_bit) != 0;
    std::string text =
        fmt::format("<{}|{}Pos:{}",
                    now.state,
                    machine ? 'M' : 'W',
                    coordinates(machine ? now.position : difference(now.position, now.offset), eeprom));
    if ((mask & buffer_bit) != 0) {
        text += fmt::format("|Bf:{},{}", now.free_blocks, now.free_bytes);
    }
    if (now.line_number > 0) {
        text += fmt::format("|Ln:{}", now.line_number);
    }
    const double feed = eeprom.is_on(report_inches_setting) ? now.feed / mm_per_inch : now.feed;
    text += fmt::format("|FS:{:.0f},{:.0f}", feed, now.spindle_rpm);
    if (!now.pins.empty()) {
        text += "|Pn:" + now.pins;
    }
    if (offset_wait_ > 0) {
        --offset_wait_;
    } else {
        text += "|WCO:" + coordinates(now.offset, eeprom);
        offset_wait_ = busy ? 29 : 9;
        override_wait_ += override_wait_ == 0 ? 1 : 0; // never both in one report
    }
    if (override_wait_ > 0) {
        --override_wait_;
    } else {
        text += fmt::format("|Ov:{},{},{}", now.overrides.feed, now.overrides.rapid, now.overrides.spindle);
        override_wait_ = busy ? 19 : 9;
        if (!now.accessories.empty()) {
            text += "|A:" + now.accessories;
        }
    }
    return text + ">\r\n";
}

std::string settings_report(const Eeprom& eeprom) {
    std::string text;
    for (const Setting& setting : eeprom.settings) {
        text += fmt::format("${}={}\r\n", setting.number, fixed(setting.value, setting.decimals));
    }
    return text;
}

std::string probe_report(const Probe& probe, const Eeprom& eeprom) {
    return fmt::format("[PRB:{}:{}]\r\n", coordinates(probe.position, eeprom), probe.touched ? 1 : 0);
}

std::string parameters_report(const Modes& modes, const Probe& probe, const Eeprom& eeprom) {
    std::string text;
    constexpr int first_offset = 54;
    for (std::size_t n = 0; n < eeprom.work_offsets.size(); ++n) {
        text += fmt::format(
            "[G{}:{}]\r\n", first_offset + static_cast<int>(n), coordinates(eeprom.work_offsets[n], eeprom));
    }
    text += "[G28:" + coordinates(eeprom.g28, eeprom) + "]\r\n";
    text += "[G30:" + coordinates(eeprom.g30, eeprom) + "]\r\n";
    text += "[G92:" + coordinates(modes.g92, eeprom) + "]\r\n";
    text += "[TLO:" + length(modes.tool_length_offset, eeprom) + "]\r\n";
    return text + probe_report(probe, eeprom);
}

} // namespace millwright::machine::emulated
