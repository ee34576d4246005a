// On-line commands about variables and memory.
#include "core/pmac/emulator/internal/commands.h"

#include <fmt/format.h>

#include <cmath>

namespace millwright::pmac::card {

Commands::Code Commands::variable(Words& words) {
    const char kind = words.now().text.front();
    words.skip();
    const auto first = words.take_index(Variables::count - 1);
    if (!first) {
        return error_code::unknown_command;
    }
    int last = *first;
    if (words.take("..")) {
        const auto told = words.take_index(Variables::count - 1);
        if (!told || *told < *first) {
            return error_code::unknown_command;
        }
        last = *told;
    }
    if (kind == 'M' && words.take("->")) {
        return pointer(words, *first);
    }
    if (words.take("=")) {
        return assign(kind, *first, last, words);
    }
    for (int n = *first; n <= last; ++n) {
        report(kind, n);
    }
    return 0;
}

Commands::Code Commands::assign(char kind, int first, int last, Words& words) {
    if (words.take("*")) {
        for (int n = first; n <= last; ++n) {
            kind == 'I' ? card_.set('I', n, IVariables::factory(n)) : card_.set(kind, n, 0.0);
        }
        return 0;
    }
    const auto value = take_expression(words);
    if (!value) {
        return error_code::unknown_command;
    }
    const double number = value->value(card_);
    for (int n = first; n <= last; ++n) {
        card_.set(kind, n, number);
    }
    return 0;
}

void Commands::report(char kind, int index) {
    constexpr int form = 9;
    const int i9 = static_cast<int>(card_.i(form));
    const double value = card_.value(kind, index);
    const bool hexadecimal = (i9 & 2) != 0 && kind == 'I' && IVariables::is_address(index);
    const std::string text =
        hexadecimal ? fmt::format("${:X}", static_cast<std::int64_t>(value)) : number_text(value);
    say((i9 & 1) != 0 ? fmt::format("{}{}={}", kind, index, text) : text);
}

Commands::Code Commands::pointer(Words& words, int index) {
    if (words.ended()) {
        say(card_.memory().pointer(index).text);
        return 0;
    }
    const auto pointer = take_pointer(words);
    if (!pointer) {
        return error_code::unknown_command;
    }
    card_.memory().point(index, *pointer);
    return 0;
}

/// RX:$..[,n] RHL:$..[,n] WX:$..,v[,v]
Commands::Code Commands::memory(Words& words) {
    const std::string name = words.now().text;
    words.skip();
    (void)words.take(":");
    const auto begin = words.take_index(greatest_address);
    if (!begin) {
        return error_code::unknown_command;
    }
    const char side = name.back();
    int address = *begin;
    if (name.front() == 'W') {
        do {
            const auto value = words.take(",") ? words.take_number() : std::nullopt;
            if (!value || address > greatest_address || std::abs(*value) > 1e12) {
                return error_code::unknown_command;
            }
            const auto bits = static_cast<std::int64_t>(*value);
            if (side == 'L') {
                constexpr int word = 24;
                card_.memory().set_word('X', address, static_cast<std::uint32_t>(bits >> word));
            }
            card_.memory().set_word(side == 'X' ? 'X' : 'Y', address, static_cast<std::uint32_t>(bits));
            ++address;
        } while (words.at(","));
        return 0;
    }
    constexpr int most = 16;
    const auto count = words.take(",") ? words.take_index(most) : std::optional(1);
    if (!count) {
        return error_code::unknown_command;
    }
    const bool hexadecimal = name.size() == 3;
    for (int n = 0; n < *count; ++n, ++address) {
        const std::uint32_t x = card_.memory().word('X', address);
        const std::uint32_t y = card_.memory().word('Y', address);
        if (side == 'L') {
            say(hexadecimal ? fmt::format("{:06X}{:06X}", x, y)
                            : fmt::format("{}", (static_cast<std::int64_t>(x) << 24) | y));
        } else {
            const std::uint32_t word = side == 'X' ? x : y;
            say(hexadecimal ? fmt::format("{:06X}", word) : fmt::format("{}", word));
        }
    }
    return 0;
}

std::string Commands::gathered() const {
    constexpr int mask_index = 20, sources = 24, bytes = 3;
    constexpr std::uint32_t x_side = 1U << 22, both_sides = 1U << 23;
    std::string result;
    const auto put = [&](char side, std::uint32_t source) {
        const std::uint32_t word = card_.memory().word(side, static_cast<int>(source & greatest_address));
        for (int n = bytes - 1; n >= 0; --n) {
            result += static_cast<char>(word >> (8 * n) & 0xFFU);
        }
    };
    const auto mask = static_cast<std::uint32_t>(card_.i(mask_index));
    for (int n = 0; n < sources; ++n) {
        if ((mask >> n & 1U) == 0) {
            continue;
        }
        const auto source = static_cast<std::uint32_t>(card_.i(mask_index + 1 + n));
        if ((source & (x_side | both_sides)) != 0) {
            put('X', source);
        }
        if ((source & x_side) == 0 || (source & both_sides) != 0) {
            put('Y', source);
        }
    }
    return result;
}

std::string Commands::shared_line() const {
    constexpr int begin = 0xD18C, end = 0xD1B4; // behind the word of control
    std::string line;
    for (int address = begin; address < end; ++address) {
        for (const char side : {'Y', 'X'}) {
            const std::uint32_t word = card_.memory().word(side, address);
            for (const std::uint32_t letter : {word & 0xFFU, word >> 8 & 0xFFU}) {
                if (letter == 0) {
                    return line;
                }
                line += static_cast<char>(letter);
            }
        }
    }
    return line;
}

} // namespace millwright::pmac::card
