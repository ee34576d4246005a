#include "core/pmac/emulator/internal/port.h"

#include <fmt/format.h>

#include <utility>

namespace millwright::pmac::card {

namespace {

constexpr int handshake_mode = 3, checksum_mode = 4, error_mode = 6;
constexpr char cr = '\r', lf = '\n', ack = '\x06', bell = '\a';
constexpr std::size_t longest_line = 255;

char sum_of(std::string_view text) {
    unsigned sum = 0;
    for (const char c : text) {
        sum += static_cast<unsigned char>(c);
    }
    return static_cast<char>(sum & 0xFFU);
}

} // namespace

void Port::receive(std::string_view characters) {
    for (const char character : characters) {
        take(character);
    }
}

std::string Port::take_output() {
    return std::exchange(output_, {});
}

void Port::take(char character) {
    const auto code = static_cast<unsigned char>(character);
    constexpr unsigned char first_printable = 32, last_ascii = 127;
    if (echoes_ && (code >= first_printable || character == cr)) {
        output_ += character;
    }
    if (character == cr) {
        const std::string line = std::exchange(line_, {});
        const bool overrun = std::exchange(overrun_, false);
        const bool bad = std::exchange(bad_character_, false);
        if (bad || overrun) {
            refuse(bad ? error_code::bad_character : error_code::unknown_command, false);
            return;
        }
        enter(line);
    } else if (code > last_ascii) {
        bad_character_ = true;
    } else if (code >= first_printable || character == lf || character == '\0') {
        // a line feed is a blank: files are sent with it
        if (character != lf && character != '\0') {
            overrun_ = overrun_ || line_.size() >= longest_line;
            line_ += overrun_ ? "" : std::string(1, character);
        }
    } else {
        control(character);
    }
}

void Port::enter(const std::string& line) {
    last_line_ = line;
    const Answer answered = commands_.execute(line);
    if (answered.error != 0) {
        for (const std::string& one : answered.lines) {
            put_line(one);
        }
        refuse(answered.error, false);
        return;
    }
    answer(answered.lines, true);
    if ((mode(checksum_mode) & 1) != 0) {
        output_ += sum_of(line);
    }
}

void Port::put_line(const std::string& text) {
    const std::string sent = ((mode(handshake_mode) & 1) != 0 ? std::string(1, lf) : "") + text + cr;
    output_ += sent;
    if ((mode(checksum_mode) & 1) != 0) {
        output_ += sum_of(sent);
    }
}

void Port::answer(const std::vector<std::string>& lines, bool closes) {
    for (const std::string& one : lines) {
        put_line(one);
    }
    const int handshake = mode(handshake_mode);
    if (closes && handshake > 0) {
        output_ += handshake == 1 ? lf : ack;
    }
}

void Port::refuse(int error, bool of_program) {
    const int told = mode(error_mode);
    if (of_program && told == 2) {
        return;
    }
    output_ += bell;
    if ((told & 1) == 0) {
        return;
    }
    output_ += told == 3 ? std::string(1, cr) : "";
    put_line(fmt::format("ERR{:03}", error));
}

void Port::serve_programs() {
    while (!card_.said().empty()) {
        put_line(card_.said().front());
        card_.said().pop_front();
    }
    constexpr int most = 200; // a queue that overflows loses what comes later
    for (int n = 0; n < most && !card_.asked().empty(); ++n) {
        const std::string line = card_.asked().front();
        card_.asked().pop_front();
        if (line.size() == 1 && line.front() < ' ') {
            control(line.front());
            continue;
        }
        const Answer answered = of_programs_.execute(line);
        answer(answered.lines, false);
        if (answered.error != 0) {
            refuse(answered.error, true);
        }
    }
    card_.asked().clear();
}

void Port::reset() {
    commands_.reset();
    of_programs_.reset();
    line_.clear();
    output_.clear();
    overrun_ = bad_character_ = echoes_ = false;
}

/// What a control character asks of all motors or systems; nothing: it asks nothing.
std::optional<std::string> Port::report(char character) const {
    switch (character | '@') {
    case 'B':
        return commands_.motor_states();
    case 'C':
        return commands_.system_states();
    case 'F':
        return commands_.following_errors();
    case 'G':
        return commands_.global_state();
    case 'P':
        return commands_.positions();
    case 'V':
        return commands_.velocities();
    default:
        return std::nullopt;
    }
}

void Port::control(char character) {
    if (const auto told = report(character)) {
        return answer({*told}, true);
    }
    switch (character | '@') {
    case 'A':
        card_.abort_all();
        card_.asked().clear();
        break;
    case 'D':
        for (int n = 0; n < Card::plcs; ++n) {
            card_.enable_plc(n, false);
        }
        break;
    case 'E':
        output_ += commands_.gathered();
        break;
    case 'H':
        if (!line_.empty()) {
            line_.pop_back();
        }
        break;
    case 'I':
        enter(std::string(last_line_)); // a line that is half typed stays
        break;
    case 'K':
        card_.kill_all();
        break;
    case 'N':
        output_ += sum_of(line_);
        break;
    case 'T':
        echoes_ = !echoes_;
        break;
    case 'U':
        (void)commands_.execute("OPEN ROT");
        break;
    case 'W':
        enter(commands_.shared_line());
        break;
    case 'X':
        output_.clear();
        line_.clear();
        overrun_ = bad_character_ = false;
        break;
    default:
        control_systems(character);
        break;
    }
}

void Port::control_systems(char character) {
    const auto each_system = [&](auto&& act) {
        for (int n = 0; n < Card::systems; ++n) {
            act(card_.system(n));
        }
    };
    switch (character | '@') {
    case 'O':
        each_system([](CoordinateSystem& system) { system.hold(); });
        break;
    case 'Q':
        each_system([](CoordinateSystem& system) { system.quit(); });
        break;
    case 'R':
        each_system([](CoordinateSystem& system) { (void)system.run(false); });
        break;
    case 'S':
        each_system([](CoordinateSystem& system) { (void)system.run(true); });
        break;
    default: // ^Z: this is the only port
        break;
    }
}

} // namespace millwright::pmac::card
