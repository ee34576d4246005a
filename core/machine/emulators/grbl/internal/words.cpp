#include "core/machine/emulators/grbl/internal/words.h"

#include "core/machine/emulators/grbl/internal/error_codes.h"

#include <cctype>
#include <cmath>
#include <string>

namespace millwright::machine::emulated {

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

class Reader {
public:
    explicit Reader(std::string_view line) : rest_(line) {}

    ReadWords read() {
        while (!rest_.empty() && result_.error == error_code::none) {
            result_.error = read_word();
        }
        return result_;
    }

private:
    std::string_view rest_;
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
            constexpr double most = 1000.0;
            if (!(*value >= 0.0 && *value < most)) {
                return error_code::unsupported_command;
            }
            const double tenths = *value * 10.0;
            if (std::abs(tenths - std::round(tenths)) > 1e-3) {
                return error_code::not_an_integer;
            }
            const int code = static_cast<int>(std::lround(tenths));
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

    int read_g(int code) {
        switch (code) {
        case 0:
        case 10:
        case 20:
        case 30:
        case 382:
        case 383:
        case 384:
        case 385:
            return set_with_axes(words().motion, code, AxisUse::motion);
        case 800:
            return set(words().motion, code);
        case 100:
        case 280:
        case 300:
        case 920:
            return set_with_axes(words().non_modal, code, AxisUse::non_modal);
        case 40:
        case 530:
        case 281:
        case 301:
        case 921:
            return set(words().non_modal, code);
        case 431:
        case 490: // which makes nothing of them
            return set_with_axes(words().tool_length, code, AxisUse::tool_length);
        default:
            return read_mode(code);
        }
    }

    int read_mode(int code) {
        switch (code) {
        case 170:
        case 180:
        case 190:
            return set(words().plane, code);
        case 900:
        case 910:
            return set(words().distance, code);
        case 911:
            return set(words().arc_distance);
        case 930:
        case 940:
            return set(words().feed_mode, code);
        case 200:
        case 210:
            return set(words().units, code);
        case 400:
            return set(words().cutter_off);
        case 610:
            return set(words().exact_path);
        case 540:
        case 550:
        case 560:
        case 570:
        case 580:
        case 590:
            return set(words().coordinates, code);
        case 591:
        case 592:
        case 593:
            return error_code::no_such_offset;
        default:
            return error_code::unsupported_command;
        }
    }

    int read_m(int code) {
        switch (code) {
        case 0:
        case 10:
        case 20:
        case 300:
            return set(words().flow, code);
        case 30:
        case 40:
        case 50:
            return set(words().spindle, code);
        case 70:
            return set(words().mist);
        case 80:
            return set(words().flood);
        case 90:
            return set(words().coolant_off);
        default:
            return code % 10 != 0 ? error_code::not_an_integer : error_code::unsupported_command;
        }
    }

    int read_value(char letter, double value) {
        constexpr std::string_view known = "FIJKLNPRSTXYZ";
        constexpr std::string_view positive = "FNPST";
        if (known.find(letter) == std::string_view::npos) {
            return error_code::unsupported_command;
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

ReadWords read_words(std::string_view line) {
    return Reader(line).read();
}

} // namespace millwright::machine::emulated
