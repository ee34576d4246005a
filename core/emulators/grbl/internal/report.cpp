#include "core/emulators/grbl/internal/report.h"

#include "core/base/text.h"

#include <fmt/format.h>

namespace millwright::emulators::internal {

namespace {

constexpr int report_mask = 10;
constexpr unsigned machine_position_bit = 1;
constexpr unsigned buffer_bit = 2;

std::string length(double value, const Eeprom& eeprom) {
    return eeprom.is_on(report_inches_setting) ? fixed(value / mm_per_inch, 4) : fixed(value, 3);
}

Axes difference(Axes from, const Axes& subtract) {
    for (std::size_t n = 0; n < from.size(); ++n) {
        from[n] -= subtract[n];
    }
    return from;
}

/// A FluidNC keeps its limits under names, and shows some of them by the numbers that Grbl has for X, Y and
/// Z.
bool is_shown_by_fluidnc(int number) {
    return number == 10 || number == 13 || (number >= 20 && number <= 22) ||
           (number >= 100 && number < 140 && number % 10 < 3);
}

constexpr int plain_systems = 6; // G54 to G59

} // namespace

std::string coordinates(const Axes& axes, const Eeprom& eeprom, const Build& build) {
    std::string text;
    for (std::size_t n = 0; n < build.axis_count(); ++n) {
        const bool inches = eeprom.is_on(report_inches_setting);
        const double unit = axis_unit(n, inches, eeprom, build);
        text += (n == 0 ? "" : ",") + fixed(axes[n] / unit, unit > 1.0 ? 4 : 3);
    }
    return text;
}

std::string message(std::string_view text, const Build& build) {
    return fmt::format("[MSG:{}{}]\r\n", build.is(EmulatedFirmware::fluidnc) ? "INFO: " : "", text);
}

std::string build_report(const Eeprom& eeprom, const Build& build, bool line_numbers, bool rt) {
    const Sizes sizes = sizes_of(build.firmware);
    const std::string_view mist = build.mist ? "M" : "";
    switch (build.firmware) {
    case EmulatedFirmware::grblhal:
        return fmt::format("[VER:1.1f.20240817:{}]\r\n[OPT:VN{}SL,{},{},{},0]\r\n[AXS:{}:{}]\r\n"
                           "[NEWOPT:ENUMS,RT{},HOME,TC,SED]\r\n[FIRMWARE:grblHAL]\r\n[NVS STORAGE:*FLASH]\r\n"
                           "[DRIVER:emulated]\r\n[DRIVER VERSION:240812]\r\n[BOARD:emulated]\r\n"
                           "[AUX IO:0,0,0,0]\r\n",
                           eeprom.build_text,
                           mist,
                           sizes.planner_blocks,
                           sizes.receive_bytes,
                           build.axis_count(),
                           build.axis_count(),
                           build.axes,
                           rt ? "+" : "-");
    case EmulatedFirmware::fluidnc:
        return fmt::format("[VER:3.7 FluidNC v3.7.12:{}]\r\n[OPT:{}PHS]\r\n[MSG:INFO: Machine: emulated]\r\n"
                           "[MSG: No Wifi]\r\n",
                           eeprom.build_text,
                           mist);
    case EmulatedFirmware::grbl:
        break;
    }
    // A build for more axes names them, as Grbl's forks do.
    const std::string axes = build.axis_count() > 3
                                 ? fmt::format("[AXS:{}:{}]\r\n", build.axis_count(), build.axes)
                                 : std::string();
    return fmt::format("[VER:1.1h.20190825:{}]\r\n[OPT:V{}{},{},{}]\r\n{}",
                       eeprom.build_text,
                       line_numbers ? "N" : "",
                       mist,
                       sizes.planner_blocks,
                       sizes.receive_bytes,
                       axes);
}

std::string StatusReport::text(const Snapshot& now, const Eeprom& eeprom, const Build& build, bool busy) {
    const bool hal = build.is(EmulatedFirmware::grblhal);
    const auto mask = static_cast<unsigned>(eeprom.setting(report_mask));
    const bool machine = (mask & machine_position_bit) != 0;
    std::string text = fmt::format(
        "<{}{}|{}Pos:{}",
        now.state,
        hal && now.alarm > 0 && now.state == "Alarm" ? fmt::format(":{}", now.alarm) : std::string(),
        machine ? 'M' : 'W',
        coordinates(machine ? now.position : difference(now.position, now.offset), eeprom, build));
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
        text += "|WCO:" + coordinates(now.offset, eeprom, build);
        text += hal ? fmt::format("|WCS:G{}|H:{}|T:{}", now.work_system, now.homed ? 1 : 0, now.tool) : "";
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
    text += hal && now.all ? "|MPG:0|Sc:|TLR:0|FW:grblHAL" : "";
    return text + ">\r\n";
}

std::string settings_report(const Eeprom& eeprom, const Build& build) {
    std::string text;
    for (const Setting& setting : eeprom.settings) {
        if (build.is(EmulatedFirmware::fluidnc) && !is_shown_by_fluidnc(setting.number)) {
            continue;
        }
        text += fmt::format("${}={}\r\n", setting.number, fixed(setting.value, setting.decimals));
    }
    if (build.is(EmulatedFirmware::grblhal)) {
        text += "$70=3\r\n$300=grblHAL\r\n$302=192.168.5.1\r\n$307=N/A\r\n";
    }
    return text;
}

std::string probe_report(const Probe& probe, const Eeprom& eeprom, const Build& build) {
    return fmt::format("[PRB:{}:{}]\r\n", coordinates(probe.position, eeprom, build), probe.touched ? 1 : 0);
}

std::string
parameters_report(const Modes& modes, const Probe& probe, const Eeprom& eeprom, const Build& build) {
    std::string text;
    const auto add = [&](std::string_view name, const Axes& axes) {
        text += fmt::format("[{}:{}]\r\n", name, coordinates(axes, eeprom, build));
    };
    constexpr int first_offset = 54;
    for (int n = 0; n < plain_systems; ++n) {
        add(fmt::format("G{}", first_offset + n), eeprom.work_offsets[static_cast<std::size_t>(n)]);
    }
    if (build.is(EmulatedFirmware::grblhal)) { // which nothing here sets
        for (const std::string_view name : {"G59.1", "G59.2", "G59.3"}) {
            add(name, {});
        }
    }
    add("G28", eeprom.g28);
    add("G30", eeprom.g30);
    add("G92", modes.g92);
    if (build.is(EmulatedFirmware::grblhal) && eeprom.is_on(homing_setting)) {
        text += fmt::format("[HOME:{}:7]\r\n", coordinates({}, eeprom, build));
    }
    text += "[TLO:" + length(modes.tool_length_offset(), eeprom) + "]\r\n";
    return build.is(EmulatedFirmware::fluidnc) ? text : text + probe_report(probe, eeprom, build);
}

} // namespace millwright::emulators::internal
