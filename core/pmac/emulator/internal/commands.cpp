#include "core/pmac/emulator/internal/commands.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::pmac::card {

namespace {

/// What ends the text that goes into an open buffer.
bool is_of_buffers(const Token& token) {
    return token.kind == Token::Kind::word &&
           (token.text == "OPEN" || token.text == "CLOSE" || token.text == "CLEAR");
}

} // namespace

Answer Commands::execute(std::string_view line) {
    answer_ = {};
    const auto words = words_of(line);
    if (!words) {
        answer_.error = error_code::unknown_command;
        return std::exchange(answer_, {});
    }
    Words at(*words);
    while (!at.ended() && answer_.error == 0) {
        const std::size_t here = at.place();
        const auto end =
            std::find_if(words->begin() + static_cast<std::ptrdiff_t>(here), words->end(), is_of_buffers);
        if (const auto stored = store({words->begin() + static_cast<std::ptrdiff_t>(here), end})) {
            answer_.error = *stored;
            at.go_to(static_cast<std::size_t>(end - words->begin()));
            continue;
        }
        answer_.error = one(at);
        if (answer_.error == error_code::unknown_command) {
            const std::vector<Token> rest(words->begin() + static_cast<std::ptrdiff_t>(here), words->end());
            answer_.error = compile(rest, false) ? error_code::needs_buffer : error_code::unknown_command;
        }
    }
    return std::exchange(answer_, {});
}

void Commands::reset() {
    motor_ = system_ = 0;
    buffer_ = Buffer::none;
    card_.rotary_open = false;
}

Commands::Code Commands::one(Words& words) {
    if (words.at_number() || ((words.at("-") || words.at("+")) && words.next().kind == Token::Kind::number)) {
        card_.set('P', 0, *words.take_number());
        return 0;
    }
    switch (words.now().kind) {
    case Token::Kind::symbol:
        return symbol(words);
    case Token::Kind::word:
        return words.now().text.size() == 1 ? letter(words) : keyword(words);
    default:
        return error_code::unknown_command;
    }
}

Commands::Code Commands::symbol(Words& words) {
    if (words.take("#")) {
        return address_motor(words);
    }
    if (words.take("&")) {
        if (const auto number = words.take_index(Card::systems)) {
            system_ = *number > 0 ? *number - 1 : system_;
            return *number > 0 ? 0 : error_code::unknown_command;
        }
        if (words.at_number()) {
            return error_code::unknown_command;
        }
        say(fmt::format("{}", system_ + 1));
        return 0;
    }
    if (words.take("@")) { // the only card
        const auto number = words.take_index(15);
        if (!number) {
            say("0");
        }
        return number.value_or(0) == 0 ? 0 : error_code::unknown_command;
    }
    if (words.take("%")) {
        constexpr double most = 225.0;
        const auto percent = words.at_number() ? words.take_number() : std::nullopt;
        if (!percent) {
            say(tenths_text(system().percent()));
        } else if (*percent > most) {
            return error_code::unknown_command;
        } else {
            system().set_percent(*percent);
        }
        return 0;
    }
    if (words.take("?")) {
        say(fmt::format("{:06X}{:06X}", card_.status_word_1(motor_), card_.status_word_2(motor_)));
        return 0;
    }
    if (words.take("??")) {
        say(fmt::format("{:06X}{:06X}", system().status_word_1(), system().status_word_2()));
        return 0;
    }
    if (words.take("???")) {
        say(global_state());
        return 0;
    }
    if (words.take("\\")) {
        system().hold();
        return 0;
    }
    return dollar(words);
}

Commands::Code Commands::dollar(Words& words) {
    const bool factory = words.at("$$$***");
    if (words.take("$$$***") || words.take("$$$")) {
        card_.reset(factory);
        reset();
        return 0;
    }
    if (words.take("$")) { // nothing to phase: the loop is closed where the motor stands
        motor().close_loop();
        return card_.settings(motor_).active ? 0 : error_code::unknown_command;
    }
    return error_code::unknown_command;
}

Commands::Code Commands::address_motor(Words& words) {
    const auto number = words.take_index(Card::motors);
    if (!number && words.at_number()) {
        return error_code::unknown_command;
    }
    if (!number) {
        say(fmt::format("{}", motor_ + 1));
        return 0;
    }
    if (*number == 0) {
        return error_code::unknown_command;
    }
    if (words.take("->")) {
        return define_axis(words, *number - 1);
    }
    motor_ = *number - 1;
    return 0;
}

Commands::Code Commands::define_axis(Words& words, int motor) {
    if (words.ended() || words.at("#")) {
        const int owner = card_.system_of(motor);
        say(owner < 0 ? "0" : card_.system(owner).definition(motor).text);
        return 0;
    }
    AxisDefinition definition;
    bool axis = false;
    while (words.at_number() || words.at("+") || words.at("-") ||
           (words.now().text.size() == 1 && axis_letters.find(words.now().text) != std::string_view::npos)) {
        const bool minus = words.at("-");
        const bool sign = minus || words.at("+");
        if (sign) {
            words.skip();
        }
        definition.text += minus ? "-" : sign ? "+" : "";
        double value = 1.0;
        const bool number = words.at_number();
        if (number) {
            definition.text += words.now().text;
            value = *words.take_number();
        }
        value = minus ? -value : value;
        const std::string& letter = words.now().text;
        if (letter.size() == 1 && axis_letters.find(letter) != std::string_view::npos) {
            definition.factors[axis_letters.find(letter)] += value;
            definition.text += letter;
            axis = true;
            words.skip();
        } else if (number) {
            definition.offset += value;
        } else {
            return error_code::unknown_command;
        }
    }
    if (!axis) {
        const bool removes = !definition.text.empty() && !(std::abs(definition.offset) > 0.0);
        return removes ? system().define(motor, {}) : error_code::unknown_command;
    }
    return system().define(motor, definition);
}

Commands::Code Commands::letter(Words& words) {
    const char name = words.now().text.front();
    const bool number = words.next().kind == Token::Kind::number;
    switch (name) {
    case 'I':
    case 'M':
        return variable(words);
    case 'P':
    case 'Q':
        if (number) {
            return variable(words);
        }
        break;
    case 'B':
        words.skip();
        return begin_at(words);
    case 'J':
        words.skip();
        return jog(words);
    default:
        break;
    }
    if (number && name != 'O') {
        return error_code::unknown_command; // words of programs
    }
    words.skip();
    return std::string_view("PVFKO").find(name) != std::string_view::npos ? motor_command(words, name)
                                                                          : system_command(words, name);
}

} // namespace millwright::pmac::card
