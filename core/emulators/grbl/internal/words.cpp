#include "core/emulators/grbl/internal/words.h"

#include "core/emulators/grbl/internal/error_codes.h"

#include <algorithm>
#include <cctype>
#include <cmath>
#include <cstdint>
#include <string>

namespace millwright::emulators::internal {

namespace {

/// The longest number at the beginning of `text`, which is taken off; digits and one point, no exponent.
std::optional<double> take_number(std::string_view& text) {
    std::size_t length = 0;
    bool digits = false;
    bool point = false;
    if (length < text.size() && (text[length] == '-' || text[length] == '+')) {
        ++length;
    }
    for (; length < text.size(); ++length) {
        const bool digit = std::isdigit(static_cast<unsigned char>(text[length])) != 0;
        if (!digit && (text[length] != '.' || point)) {
            break;
        }
        digits = digits || digit;
        point = point || !digit;
    }
    if (!digits) {
        return std::nullopt;
    }
    const double value = std::strtod(std::string(text.substr(0, length)).c_str(), nullptr);
    text.remove_prefix(length);
    return std::isfinite(value) ? std::optional(value) : std::nullopt;
}

constexpr int one_tenth = 10; // of the hundredths of a Code

/// A number as Grbl takes a G or an M apart: the whole part in eight bits, what it then lacks in sixteen. So
/// M300 is 44 and 256 more.
struct Code {
    int whole = 0;
    int hundredths = 0;
};

Code code_of(double value) {
    constexpr double most = 1e9;
    value = std::clamp(value, -most, most);
    const auto whole = static_cast<std::uint8_t>(static_cast<std::int64_t>(value));
    return {whole, static_cast<std::uint16_t>(std::llround(100.0 * (value - whole)))};
}

class Reader {
public:
    Reader(std::string_view line, const Build& build) : rest_(line), build_(build) {}

    ReadWords read() {
        while (!rest_.empty() && result_.error == error_code::none) {
            result_.error = read_word();
        }
        return result_;
    }

private:
    std::string_view rest_;
    const Build& build_;
    ReadWords result_;

    Words& words() { return result_.words; }

    int read_word() {
        const char letter = rest_.front();
        if (letter < 'A' || letter > 'Z') {
            return error_code::no_letter;
        }
        rest_.remove_prefix(1);
        const auto value = take_number(rest_);
        if (!value) {
            return error_code::bad_number;
        }
        if (letter == 'G' || letter == 'M') {
            const Code code = code_of(*value);
            return letter == 'G' ? read_g(code) : read_m(code);
        }
        return read_value(letter, *value);
    }

    static int set(int& group, int code) {
        if (group >= 0) {
            return error_code::two_of_a_group;
        }
        group = code;
        return error_code::none;
    }

    static int set(bool& flag) {
        if (flag) {
            return error_code::two_of_a_group;
        }
        flag = true;
        return error_code::none;
    }

    int use_axes(AxisUse use) {
        if (words().axis_use != AxisUse::none) {
            return error_code::axis_conflict;
        }
        words().axis_use = use;
        return error_code::none;
    }

    int set_with_axes(int& group, int code, AxisUse use) {
        const int conflict = use_axes(use);
        return conflict != error_code::none ? conflict : set(group, code);
    }

    /// What must be a whole number of `group`.
    static int set_whole(int& group, const Code& code) {
        return code.hundredths == 0 ? set(group, 10 * code.whole) : error_code::not_an_integer;
    }

    int read_g(const Code& code) {
        const int tenths = 10 * code.whole;
        switch (code.whole) {
        case 10:
            return code.hundredths == 0 ? set_with_axes(words().non_modal, tenths, AxisUse::non_modal)
                                        : error_code::not_an_integer;
        case 28:
        case 30:
        case 92:
            return code.hundredths == 0 ? set_with_axes(words().non_modal, tenths, AxisUse::non_modal)
                   : code.hundredths == one_tenth ? set(words().non_modal, tenths + 1)
                                                  : error_code::unsupported_command;
        case 4:
        case 53:
            return set_whole(words().non_modal, code);
        case 0:
        case 1:
        case 2:
        case 3:
        case 38:
            return read_motion(code);
        case 80:
            return set_whole(words().motion, code);
        case 43:
        case 49: // of which it reads no fraction
            return read_tool_length(code);
        default:
            return read_mode(code);
        }
    }

    int read_motion(const Code& code) {
        const int conflict = use_axes(AxisUse::motion);
        if (conflict != error_code::none) {
            return conflict;
        }
        constexpr int probe = 38;
        if (code.whole != probe) {
            return set_whole(words().motion, code);
        }
        const bool known = code.hundredths >= 2 * one_tenth && code.hundredths <= 5 * one_tenth &&
                           code.hundredths % one_tenth == 0;
        return known ? set(words().motion, 10 * probe + code.hundredths / one_tenth)
                     : error_code::unsupported_command;
    }

    int read_tool_length(const Code& code) {
        constexpr int cancels = 49;
        const int conflict = use_axes(AxisUse::tool_length);
        if (conflict != error_code::none) {
            return conflict;
        }
        if (code.whole == cancels) {
            return set(words().tool_length, 10 * cancels); // and makes nothing of axis words
        }
        return code.hundredths == one_tenth ? set(words().tool_length, 10 * code.whole + 1)
                                            : error_code::unsupported_command;
    }

    int read_mode(const Code& code) {
        const bool whole = code.hundredths == 0;
        switch (code.whole) {
        case 17:
        case 18:
        case 19:
            return set_whole(words().plane, code);
        case 90:
        case 91:
            if (whole) {
                return set(words().distance, 10 * code.whole);
            }
            return code.whole == 91 && code.hundredths == one_tenth ? set(words().arc_distance)
                                                                    : error_code::unsupported_command;
        case 93:
        case 94:
            return set_whole(words().feed_mode, code);
        case 20:
        case 21:
            return set_whole(words().units, code);
        case 40:
            return whole ? set(words().cutter_off) : error_code::not_an_integer;
        case 61:
            return whole ? set(words().exact_path) : error_code::unsupported_command;
        case 54:
        case 55:
        case 56:
        case 57:
        case 58:
        case 59:
            return set_whole(words().coordinates, code);
        default:
            return error_code::unsupported_command;
        }
    }

    int read_m(const Code& code) {
        if (code.hundredths != 0) {
            return error_code::not_an_integer;
        }
        switch (code.whole) {
        case 0:
        case 1:
        case 2:
        case 30:
            return set_whole(words().flow, code);
        case 3:
        case 4:
        case 5:
            return set_whole(words().spindle, code);
        case 7:
            return build_.mist ? set_whole(words().coolant, code) : error_code::unsupported_command;
        case 8:
        case 9:
            return set_whole(words().coolant, code);
        case 6:
            return build_.is(EmulatedFirmware::grblhal) ? set(words().changes_tool)
                                                        : error_code::unsupported_command;
        default:
            return error_code::unsupported_command;
        }
    }

    int read_value(char letter, double value) {
        constexpr std::string_view known = "FIJKLNPRST";
        constexpr std::string_view positive = "FNPST";
        if (known.find(letter) == std::string_view::npos && build_.axes.find(letter) == std::string::npos) {
            return error_code::unsupported_command;
        }
        constexpr double last_tool = 255.0;
        if (letter == 'T' && value > last_tool) {
            return error_code::no_such_tool;
        }
        auto& place = words().values[static_cast<std::size_t>(letter - 'A')];
        if (place) {
            return error_code::repeated_word;
        }
        if (value < 0.0 && positive.find(letter) != std::string_view::npos) {
            return error_code::negative_value;
        }
        place = value;
        return error_code::none;
    }
};

} // namespace

ReadWords read_words(std::string_view line, const Build& build) {
    return Reader(line, build).read();
}

} // namespace millwright::emulators::internal
