#include "core/drivers/grbl/firmware.h"

#include <algorithm>
#include <array>
#include <cstddef>

namespace millwright::drivers {

namespace {

constexpr std::array all_facts = {
    GrblFacts{.firmware = GrblFirmware::grbl, .name = "Grbl", .planner_blocks = 15, .segment_blocks = 6},
    // $398 goes up to 1000 blocks; [OPT:] reports them.
    GrblFacts{.firmware = GrblFirmware::grblhal,
              .name = "grblHAL",
              .planner_blocks = 1000,
              .segment_blocks = 10,
              .jog_time = 0.16,
              .cancel_drops_lines = true,
              .errors_stick = true,
              .settings = SettingForm::numbers_with_text,
              .rotary_mask = true,
              .homing_mask = true},
    // Its configuration allows 120 blocks, of which one stays empty, and 20 segments.
    GrblFacts{.firmware = GrblFirmware::fluidnc,
              .name = "FluidNC",
              .planner_blocks = 119,
              .segment_blocks = 20,
              .jog_time = 0.2,
              .cancel_drops_lines = true,
              .cancelled_jog_error = 130,
              .settings = SettingForm::names},
};

std::string version_word(std::string_view text) {
    return std::string(text.substr(0, text.find_first_of(" :")));
}

constexpr std::string_view fluidnc_mark = "FluidNC ";

} // namespace

const GrblFacts& facts_of(GrblFirmware firmware) {
    return all_facts[static_cast<std::size_t>(firmware)];
}

std::optional<GrblIdentity> read_greeting(std::string_view line) {
    constexpr std::string_view grblhal = "GrblHAL ";
    constexpr std::string_view grbl = "Grbl ";
    constexpr std::string_view help_of_grbl = "'$' for help";
    const bool hal = line.starts_with(grblhal);
    if (!line.ends_with("]") || !(hal || line.starts_with(grbl))) {
        return std::nullopt;
    }
    const std::string_view rest = line.substr(hal ? grblhal.size() : grbl.size());
    const std::size_t bracket = rest.find(" [");
    if (bracket == std::string_view::npos || bracket == 0) {
        return std::nullopt;
    }
    const std::string_view inside = rest.substr(bracket + 2, rest.size() - bracket - 3);
    const std::string version(rest.substr(0, bracket));
    if (hal && inside.ends_with("for help")) {
        return GrblIdentity{GrblFirmware::grblhal, version};
    }
    if (!hal && inside.starts_with(fluidnc_mark)) {
        return GrblIdentity{GrblFirmware::fluidnc, version_word(inside.substr(fluidnc_mark.size()))};
    }
    return !hal && inside == help_of_grbl ? std::optional(GrblIdentity{GrblFirmware::grbl, version})
                                          : std::nullopt;
}

GrblBuild read_build(std::string_view text) {
    GrblBuild result;
    const std::string_view version = text.substr(0, text.find(':'));
    if (const std::size_t mark = version.find(fluidnc_mark); mark != std::string_view::npos) {
        result.identity =
            GrblIdentity{GrblFirmware::fluidnc, version_word(version.substr(mark + fluidnc_mark.size()))};
        return result;
    }
    const std::size_t dot = version.rfind('.'); // 1.1h.20190825
    constexpr std::size_t digits_of_a_date = 8;
    if (dot != std::string_view::npos && version.size() - dot - 1 == digits_of_a_date) {
        result.build = version.substr(dot + 1);
    }
    return result;
}

std::string default_axis_letters(int count) {
    constexpr std::string_view letters = "XYZABCUVW";
    return std::string(letters.substr(0, static_cast<std::size_t>(std::clamp(count, 0, 9))));
}

} // namespace millwright::drivers
