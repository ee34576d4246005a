// On-line commands about programs and the buffers they are in, and those of one word.
#include "core/pmac/emulator/internal/commands.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::pmac::card {

namespace {

constexpr std::size_t most_lines = 20'000;

} // namespace

StoredProgram* Commands::buffer() {
    switch (buffer_) {
    case Buffer::program:
        return card_.program(open_number_);
    case Buffer::rotary:
        return &card_.make_program(Card::rotary(system_));
    case Buffer::plc:
        return &card_.plc(open_number_);
    default:
        return nullptr;
    }
}

/// Nothing if the line is none for the open buffer, or there is none.
std::optional<Commands::Code> Commands::store(const std::vector<Token>& words) {
    StoredProgram* const open = words.empty() ? nullptr : buffer();
    if (open == nullptr) {
        return std::nullopt;
    }
    if (open->lines().size() >= most_lines) {
        return error_code::no_room;
    }
    if (!open->add(words)) {
        return std::nullopt;
    }
    if (buffer_ == Buffer::rotary) {
        (void)open->join();
    }
    return 0;
}

bool Commands::is_running(int program) const {
    for (int n = 0; n < Card::systems; ++n) {
        if (card_.system(n).running() && (card_.system(n).program() == program)) {
            return true;
        }
    }
    return false;
}

Commands::Code Commands::open(Words& words) {
    constexpr int programs = 32767;
    if (buffer_ != Buffer::none) {
        return error_code::buffer_in_use;
    }
    if (words.take("ROT")) {
        buffer_ = Buffer::rotary;
        card_.rotary_open = true;
        return 0;
    }
    const bool plc = words.take("PLC");
    if (!plc && !words.take("PROG")) {
        return error_code::unknown_command;
    }
    const auto number = words.take_index(plc ? Card::plcs - 1 : programs);
    if (!number || (!plc && *number == 0)) {
        return error_code::unknown_command;
    }
    if (!plc && is_running(*number)) {
        return error_code::program_running;
    }
    if (plc) {
        card_.enable_plc(*number, false);
    } else {
        (void)card_.make_program(*number);
    }
    buffer_ = plc ? Buffer::plc : Buffer::program;
    open_number_ = *number;
    return 0;
}

Commands::Code Commands::clear() {
    if (StoredProgram* const open = buffer()) {
        open->clear();
        return 0;
    }
    return error_code::needs_buffer;
}

Commands::Code Commands::close() {
    StoredProgram* const open = buffer();
    buffer_ = Buffer::none;
    card_.rotary_open = false;
    return open == nullptr || open->join() ? 0 : error_code::bad_structure;
}

Commands::Code Commands::list(Words& words) {
    StoredProgram* program = buffer();
    constexpr int programs = 32767;
    if (words.take("PROG")) {
        const auto number = words.take_index(programs);
        program = number ? card_.program(*number) : nullptr;
    } else if (words.take("PLC")) {
        const auto number = words.take_index(Card::plcs - 1);
        program = number ? &card_.plc(*number) : nullptr;
    }
    if (program == nullptr) {
        return error_code::unknown_command;
    }
    constexpr int form = 9;
    const bool long_form = (static_cast<int>(card_.i(form)) & 1) != 0;
    for (const auto& line : program->lines()) {
        say(listing_of(line, long_form));
    }
    return 0;
}

Commands::Code Commands::plcs(Words& words, bool on) {
    if (!words.take("PLC")) {
        return error_code::unknown_command;
    }
    do {
        const auto first = words.take_index(Card::plcs - 1);
        const auto last = first && words.take("..") ? words.take_index(Card::plcs - 1) : first;
        if (!first || !last) {
            return error_code::unknown_command;
        }
        for (int n = *first; n <= *last; ++n) {
            card_.enable_plc(n, on);
        }
    } while (words.take(","));
    return 0;
}

/// INC, ABS and FRAX act at once, too.
Commands::Code Commands::modal(Words& words) {
    std::vector<Token> own{words.now()};
    words.skip();
    if (words.at("(")) {
        while (!words.ended() && !words.at(")")) {
            own.push_back(words.now());
            words.skip();
        }
        own.push_back(words.now());
        words.skip();
    }
    const auto statements = compile(own, false);
    if (!statements || statements->size() != 1) {
        return error_code::unknown_command;
    }
    system().modal(statements->front());
    return 0;
}

Commands::Code Commands::undefine(bool all) {
    for (int n = 0; n < Card::systems; ++n) {
        if ((all || n == system_) && card_.system(n).running()) {
            return error_code::program_running;
        }
    }
    for (int n = 0; n < Card::systems; ++n) {
        if (all || n == system_) {
            card_.system(n).undefine();
        }
    }
    return 0;
}

Commands::Code Commands::home_all_here() {
    for (int n = 0; n < Card::motors; ++n) {
        if (system().running()) {
            return error_code::program_running;
        }
        if (system().definition(n).exists()) {
            card_.motor(n).home_here();
        }
    }
    return 0;
}

Commands::Code Commands::keyword(Words& words) {
    const std::string name = words.now().text;
    if (name == "INC" || name == "ABS" || name == "FRAX") {
        return modal(words);
    }
    if (name.size() <= 3 && (name.front() == 'R' || name.front() == 'W') &&
        std::string_view("XYL").find(name.back()) != std::string_view::npos) {
        return memory(words);
    }
    words.skip();
    if (name == "OPEN") {
        return open(words);
    }
    if (name == "CLOSE") {
        return close();
    }
    if (name == "CLEAR") {
        return clear();
    }
    if (name == "LIST") {
        return list(words);
    }
    if (name == "ENABLE" || name == "DISABLE") {
        return plcs(words, name == "ENABLE");
    }
    if (name == "HOME" || name == "HOMEZ") {
        return home(name == "HOMEZ");
    }
    if (name == "UNDEFINE") {
        return undefine(words.take("ALL"));
    }
    if (name == "DELETE") {
        return words.take("GATHER") || words.take("TRACE") || words.take("STIMULUS")
                   ? 0
                   : error_code::unknown_command;
    }
    if (name == "ZZ") {
        return home_all_here();
    }
    if (name == "SIZE") {
        constexpr int free_words = 41301;
        say(fmt::format("{}", buffer_ == Buffer::none ? free_words : -free_words));
        return 0;
    }
    if (name == "TYPE") {
        say("PMAC1,ISA,BATTERY,PID,CLOCK X1");
        return 0;
    }
    if (name == "VERSION") {
        say("1.15");
        return 0;
    }
    if (name == "SAVE") {
        card_.save();
        return 0;
    }
    return error_code::unknown_command;
}

} // namespace millwright::pmac::card
