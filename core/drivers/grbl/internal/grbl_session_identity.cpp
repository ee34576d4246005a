// Who answers: which firmware in which version, with which axes, buffers and settings.
#include "core/base/text.h"
#include "core/drivers/grbl/internal/grbl_session.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <charconv>
#include <utility>

namespace millwright::drivers::grbl {

namespace {

/// "16" of $/planner_blocks=16; nothing for what is no count.
std::optional<int> count_in(const std::map<std::string, std::string>& named, const std::string& name) {
    constexpr double most = 10'000.0;
    const auto found = named.find(name);
    const auto value = found == named.end() ? std::nullopt : read_number(found->second);
    return value && *value >= 1.0 && *value < most ? std::optional(static_cast<int>(*value)) : std::nullopt;
}

/// The numbers under which Grbl keeps the limits that a FluidNC has by name.
struct NamedLimit {
    std::string_view name;
    int first_number;
};
constexpr std::array named_limits = {NamedLimit{"max_rate_mm_per_min", 110},
                                     NamedLimit{"acceleration_mm_per_sec2", 120},
                                     NamedLimit{"max_travel_mm", 130}};
constexpr std::array<std::string_view, 3> homing_items = {
    "homing/cycle", "homing/mpos_mm", "homing/positive_direction"};

} // namespace

void GrblSession::identify(const GrblIdentity& who) {
    readout_.firmware = who.firmware;
    readout_.version = who.version;
    readout_.segment_blocks = facts().segment_blocks;
    if (!asking_.told_sizes) {
        readout_.planner_blocks = facts().planner_blocks;
    }
}

void GrblSession::take_axis_count(std::size_t count) {
    readout_.axes = asking_.axis_letters.size() == count ? asking_.axis_letters
                                                         : default_axis_letters(static_cast<int>(count));
    readout_.machine_position.resize(count);
    readout_.offset.resize(count);
}

/// What depends on who answers. False: there is nothing more to ask.
bool GrblSession::ask_more(double now) {
    if (std::exchange(asking_.asked_more, true)) {
        return false;
    }
    constexpr int last_of_grbl = 132;
    const bool more_than_grbl =
        readout_.axes.size() > 3 ||
        (!readout_.settings.empty() && readout_.settings.rbegin()->first > last_of_grbl);
    if (facts().settings == SettingForm::names) {
        asking_.questions = {"$/planner_blocks", "$/stepping/segments"};
        for (const char letter : readout_.axes) {
            const std::string axis = std::string("$/axes/") +
                                     static_cast<char>(std::tolower(static_cast<unsigned char>(letter))) +
                                     "/";
            for (const NamedLimit& limit : named_limits) {
                asking_.questions.push_back(axis + std::string(limit.name));
            }
            for (const std::string_view item : homing_items) {
                asking_.questions.push_back(axis + std::string(item));
            }
        }
    } else if (facts().firmware == GrblFirmware::grbl && more_than_grbl) {
        asking_.questions = {"$I+"}; // a grblHAL that greets as Grbl does
    }
    if (asking_.questions.empty()) {
        return false;
    }
    ending_since_ = now;
    ask_next();
    return true;
}

void GrblSession::handle(const SettingMessage& setting, double) {
    readout_.settings[setting.number] = setting.value;
}

void GrblSession::handle(const NamedSetting& setting, double now) {
    if (facts().settings == SettingForm::numbers && stage_ != Stage::asking) {
        return handle(Garbage{}, now);
    }
    readout_.named[setting.name] = setting.value;
    const auto value = read_number(setting.value);
    for (std::size_t n = 0; value && n < readout_.axes.size(); ++n) {
        const std::string axis =
            std::string("/axes/") +
            static_cast<char>(std::tolower(static_cast<unsigned char>(readout_.axes[n]))) + "/";
        for (const NamedLimit& limit : named_limits) {
            if (setting.name == axis + std::string(limit.name)) {
                readout_.settings[limit.first_number + static_cast<int>(n)] = *value;
            }
        }
    }
    if (const auto blocks = count_in(readout_.named, "/planner_blocks"); blocks && !asking_.told_sizes) {
        readout_.planner_blocks = std::max(1, *blocks - 1); // one stays empty
    }
    if (const auto segments = count_in(readout_.named, "/stepping/segments")) {
        readout_.segment_blocks = *segments;
    }
}

/// V,15,128: options, planner blocks, bytes of the receive buffer. A FluidNC reports its options alone.
void GrblSession::read_options(std::string_view text) {
    const std::size_t comma = text.find(',');
    readout_.line_numbers = text.substr(0, comma).find('N') != std::string_view::npos;
    readout_.mist = text.substr(0, comma).find('M') != std::string_view::npos;
    if (comma == std::string_view::npos) {
        return;
    }
    text.remove_prefix(comma + 1);
    int blocks = 0;
    int bytes = 0;
    const auto first = std::from_chars(text.data(), text.data() + text.size(), blocks);
    if (first.ec != std::errc{} || first.ptr == text.data() + text.size()) {
        return;
    }
    const auto second = std::from_chars(first.ptr + 1, text.data() + text.size(), bytes);
    constexpr int most = 10'000;
    if (second.ec == std::errc{} && blocks > 0 && blocks < most && bytes >= 80 && bytes < most) {
        readout_.planner_blocks = blocks;
        readout_.buffer_bytes = bytes;
        asking_.told_sizes = true;
    }
}

/// "ENUMS,RT-,HOME": with RT- the characters ? ! ~ are text in $ lines and comments.
void GrblSession::read_new_options(std::string_view text) {
    readout_.printable_realtime = text.find("RT-") == std::string_view::npos;
}

/// "5:XYZAB".
void GrblSession::read_axis_letters(std::string_view text) {
    std::string letters(text.substr(std::min(text.find(':'), text.size() - 1) + 1));
    std::string sorted = letters;
    std::ranges::sort(sorted);
    const bool known = std::ranges::all_of(letters, [](char letter) {
        return std::string_view("XYZABCUVW").find(letter) != std::string_view::npos;
    });
    if (known && std::ranges::adjacent_find(sorted) == sorted.end()) { // two motors may share a letter
        asking_.axis_letters = std::move(letters);
        readout_.axes =
            asking_.axis_letters.size() == readout_.axes.size() ? asking_.axis_letters : readout_.axes;
    }
}

void GrblSession::take_feedback(const Feedback& feedback) {
    constexpr std::array<std::string_view, 13> offsets = {
        "G54", "G55", "G56", "G57", "G58", "G59", "G59.1", "G59.2", "G59.3", "G28", "G30", "G92", "TLO"};
    if (feedback.tag == "VER") {
        GrblBuild build = read_build(feedback.text);
        readout_.build = std::move(build.build);
        if (build.identity) {
            identify(*build.identity);
        }
    } else if (feedback.tag == "FIRMWARE" && feedback.text == facts_of(GrblFirmware::grblhal).name) {
        identify({GrblFirmware::grblhal, readout_.version});
    } else if (feedback.tag == "OPT") {
        read_options(feedback.text);
    } else if (feedback.tag == "NEWOPT") {
        read_new_options(feedback.text);
    } else if (feedback.tag == "AXS" && !feedback.text.empty()) {
        read_axis_letters(feedback.text);
    } else if (feedback.tag == "GC") {
        readout_.modes = read_modes(feedback.text, report_unit());
    } else if (feedback.tag == "PRB" && stage_ == Stage::running) { // else it was asked for
        if (const auto result = read_probe_result(feedback.text)) {
            readout_.probe = ProbeResult{scaled(result->position), result->touched};
            ++readout_.probings;
        }
    } else if (std::ranges::find(offsets, feedback.tag) != offsets.end()) {
        if (const auto offset = read_offset(feedback.text)) {
            readout_.offsets[feedback.tag] = scaled(*offset);
        }
    }
}

} // namespace millwright::drivers::grbl
