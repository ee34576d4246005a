#include "core/pmac/driver/pmac_file.h"

#include "core/base/text.h"
#include "core/pmac/driver/guard_rules.h"
#include "core/pmac/driver/internal/buffer_words.h"
#include "core/pmac/driver/internal/command_kind.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <map>
#include <optional>
#include <regex>

namespace millwright::pmac {

namespace {

std::string bare(std::string_view line) {
    std::string text(line.substr(0, line.find(';')));
    text.erase(0, text.find_first_not_of(" \t"));
    text.erase(text.find_last_not_of(" \t\r") + 1);
    return text;
}

struct Setting {
    int variable = 0;
    double value = 0.0;
};

/// I{n}={number}, and nothing else; `text` has no blanks and no small letters.
std::optional<Setting> setting_of(std::string_view text) {
    const std::size_t equals = text.find('=');
    if (text.empty() || text.front() != 'I' || equals == std::string_view::npos) {
        return std::nullopt;
    }
    Setting found;
    const auto name = std::from_chars(text.data() + 1, text.data() + equals, found.variable);
    std::string_view value = text.substr(equals + 1);
    const char* const end = value.data() + value.size();
    bool whole = name.ec == std::errc{} && name.ptr == text.data() + equals && !value.empty();
    if (whole && value.front() == '$') {
        std::int64_t bits = 0;
        constexpr int hexadecimal = 16;
        const auto read = std::from_chars(value.data() + 1, end, bits, hexadecimal);
        whole = read.ec == std::errc{} && read.ptr == end;
        found.value = static_cast<double>(bits);
    } else if (whole) {
        const auto read = std::from_chars(value.data(), end, found.value);
        whole = read.ec == std::errc{} && read.ptr == end && std::isfinite(found.value);
    }
    return whole ? std::optional(found) : std::nullopt;
}

/// The first value that is too great; 0: any number will do.
double range_of(int variable) {
    constexpr int hundred = 100, first_motor = 100, last_motor = 899;
    if (variable >= first_motor && variable <= last_motor) {
        switch (variable % hundred) {
        case 0:
        case 1:
            return 2.0;
        case 69:
            return 32768.0;
        case 80:
            return 4.0;
        default:
            return 0.0;
        }
    }
    constexpr int first_encoder = 900, last_encoder = 979;
    if (variable >= first_encoder && variable <= last_encoder) {
        return 16.0;
    }
    return variable == 5 ? 4.0 : variable == 7 || variable == 8 ? 256.0 : 0.0;
}

struct Final {
    double value = 0.0;
    int line = 0;
};

class Reader {
public:
    Reader(const std::filesystem::path& file, bool program) : file_(file), program_(program) {}

    void take(std::string_view raw, int line) {
        const std::string text = bare(raw);
        for (std::size_t n = 0; n < text.size(); ++n) {
            if ((text[n] < ' ' && text[n] != '\t') || text[n] > '~') {
                throw Error(Diagnostic{
                    {file_, line, static_cast<int>(n) + 1},
                    "PMAC commands must be plain text",
                    "remove control characters: they act immediately and are not sent from files"});
            }
        }
        for (const std::string& part : internal::split_at_buffer_words(text)) {
            take_part(part, line);
        }
    }

    PmacFile finish() {
        for (const auto& [variable, last] : values_) {
            protection(variable, last);
        }
        std::stable_sort(result_.warnings.begin(), result_.warnings.end(), [](const auto& a, const auto& b) {
            return a.place.line < b.place.line;
        });
        return std::move(result_);
    }

private:
    const std::filesystem::path& file_;
    PmacFile result_;
    std::map<int, Final> values_;
    bool program_;     ///< all lines are one's
    std::string open_; ///< the line that opened the buffer; empty where none is open

    /// A line, or a part of one that a word about buffers begins.
    void take_part(const std::string& text, int line) {
        if (text.empty()) {
            return;
        }
        std::string tight;
        for (const char c : text) {
            const bool blank = c == ' ' || c == '\t';
            tight += blank ? "" : std::string(1, c >= 'a' && c <= 'z' ? static_cast<char>(c - 'a' + 'A') : c);
        }
        const auto setting = setting_of(tight);
        if (setting) {
            check_bits(*setting, line, text);
        }
        if (!program_ && is_left_out(text, tight, line)) {
            return;
        }
        if (!program_ && !open_.empty() && tight.starts_with("OPEN")) {
            throw Error(Diagnostic{
                {file_, line, 1}, internal::second_open_message(text), internal::second_open_hint(open_)});
        }
        if (const bool stored = program_ || (!open_.empty() && tight != "CLOSE");
            stored && internal::acts_at_once(tight)) {
            throw Error(
                Diagnostic{{file_, line, 1}, internal::at_once_message(text), internal::at_once_hint});
        }
        if (!sets_something(text, tight)) {
            ++result_.left_out;
            if (tight.find_first_not_of("0123456789.+-") == std::string::npos) {
                omit(line, fmt::format("{} is skipped: a number alone sets P0", text), "write P0=" + text);
            } else {
                omit(line,
                     fmt::format("{} is skipped: it does not set anything", text),
                     "use only settings: a settings file must not move motors");
            }
            return;
        }
        if (setting) {
            note(*setting, line, text);
        }
        result_.lines.push_back({line, text});
    }

    /// Between OPEN and CLOSE everything is the program's.
    bool sets_something(const std::string& text, const std::string& tight) {
        if (program_) {
            return true;
        }
        if (!open_.empty()) {
            open_ = tight == "CLOSE" ? "" : open_;
            return true;
        }
        open_ = tight.starts_with("OPEN") ? text : "";
        static const std::regex settings(
            "[IPQM][0-9]+(\\.\\.[0-9]+)?=.+|M[0-9]+(\\.\\.[0-9]+)?->.*|(&[0-9]+)?#[0-9]+->.*|[&#][0-9]+|"
            "(&[0-9]+)?(%[0-9.]+|ABS.*|INC.*|FRAX.*|UNDEFINE.*)|OPEN.+|CLOSE|CLEAR|DELETE.+|"
            "(ENABLE|DISABLE)PLC.+|W(X|Y|L|D|DP|F|HX|HY):?[$0-9].*|SAVE|ENDGATHER|ENDTRACE|TYPE|VERSION|"
            "SIZE");
        return std::regex_match(tight, settings);
    }
    /// Settings that are the driver's. A program would not be the same without its line: Error.
    bool is_left_out(const std::string& text, const std::string& tight, int line) {
        const std::string why = guard_refusal(text);
        if (!why.empty() && (!open_.empty() || tight.starts_with("OPEN"))) {
            throw Error(Diagnostic{
                {file_, line, 1},
                fmt::format("'{}' would weaken the guard that stops the motors when the connection is lost",
                            text),
                why});
        }
        if (!why.empty()) {
            omit(line,
                 fmt::format("{} is skipped: it would weaken the guard that stops the motors when the "
                             "connection is lost",
                             text),
                 why);
        } else if (sets_handshake(text)) {
            omit(line, fmt::format("{} is skipped: the handshake is controlled by the driver", text), {});
        } else {
            return false;
        }
        return true;
    }
    void warn(int line, std::string message, std::string hint) {
        result_.warnings.push_back({{file_, line, 1}, std::move(message), std::move(hint)});
    }
    void omit(int line, std::string message, std::string hint) {
        result_.omissions.push_back({{file_, line, 1}, std::move(message), std::move(hint)});
    }
    void check_bits(const Setting& setting, int line, const std::string& text) const {
        constexpr double beyond_words = 1 << 24; // of the card
        if (!(std::abs(setting.value) < beyond_words)) {
            throw Error(Diagnostic{{file_, line, 1},
                                   fmt::format("'{}': settings of the card have at most 24 bits", text),
                                   "check for an extra digit"});
        }
    }
    void note(const Setting& setting, int line, const std::string& text) {
        const double range = range_of(setting.variable);
        if (range > 0.0 && !(setting.value >= 0.0 && setting.value < range)) {
            warn(line,
                 fmt::format("{}: the card wraps this value around without an error", text),
                 fmt::format("use 0 to {:.0f}", range - 1.0));
        }
        values_[setting.variable] = {setting.value, line};
    }
    void protection(int variable, const Final& last) {
        constexpr int hundred = 100;
        const int motor = variable / hundred;
        if (motor < 1 || motor > 8) {
            return;
        }
        if (variable % hundred == 11 && !(last.value > 0.0)) {
            warn(last.line,
                 fmt::format("I{}=0: a following error does not stop motor {}", variable, motor),
                 "32000 are 2000 counts");
        }
        const bool limit = variable % hundred == 13 || variable % hundred == 14;
        if (limit && !(std::abs(last.value) > 0.0)) {
            warn(last.line,
                 fmt::format("I{}=0: the card has no position limit for motor {}", variable, motor),
                 "set the counts of the joint's limit");
        }
        if (variable % hundred != 25) {
            return;
        }
        constexpr std::array<std::pair<int, std::string_view>, 3> parts{
            {{16, "its amplifier is never disabled"},
             {17, "its limit switches are ignored"},
             {20, "a fault of its amplifier is ignored"}}};
        const auto bits = static_cast<std::int64_t>(last.value);
        for (const auto& [bit, what] : parts) {
            if ((bits >> bit & 1) != 0) {
                warn(last.line, fmt::format("I{} bit {}: motor {}: {}", variable, bit, motor, what), {});
            }
        }
    }
};

} // namespace

namespace {

PmacFile read(std::string_view text, const std::filesystem::path& file, Reader reader) {
    refuse_wide_text(text, file);
    text = without_byte_order_mark(text);
    for (int line = 1; !text.empty(); ++line) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        reader.take(text.substr(0, end), line);
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return reader.finish();
}

} // namespace

PmacFile read_pmac_file(std::string_view text, const std::filesystem::path& file) {
    return read(text, file, Reader(file, false));
}

std::vector<PmacFile::Line> read_pmac_program(std::string_view text, const std::filesystem::path& file) {
    return read(text, file, Reader(file, true)).lines;
}

std::string_view pmac_error(int number) {
    constexpr std::array<std::string_view, 18> words{
        "",
        "not allowed while a program runs",
        "a password is set",
        "no such command, or invalid data",
        "invalid character",
        "no buffer is open",
        "buffer full",
        "a buffer is already open",
        "auxiliary communication failed",
        "invalid program structure",
        "a motor is at both of its limits",
        "the previous move is not finished",
        "a motor is in open loop",
        "a motor is not activated",
        "no motor is in the coordinate system",
        "there is no such program",
        "invalid program structure",
        "the motors are not at the position where they were held"};
    return number >= 0 && number < std::ssize(words) ? words[static_cast<std::size_t>(number)] : "";
}

} // namespace millwright::pmac
