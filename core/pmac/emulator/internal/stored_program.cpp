#include "core/pmac/emulator/internal/stored_program.h"

#include <array>
#include <cmath>
#include <utility>

namespace millwright::pmac::card {

namespace {

struct Plain {
    std::string_view word;
    Verb verb;
};

constexpr std::array<Plain, 11> plain_words{{{"LINEAR", Verb::linear},
                                             {"RAPID", Verb::rapid},
                                             {"CIRCLE1", Verb::circle_clockwise},
                                             {"CIRCLE2", Verb::circle_counter_clockwise},
                                             {"ELSE", Verb::otherwise},
                                             {"ENDIF", Verb::end_if},
                                             {"ENDWHILE", Verb::end_while},
                                             {"RETURN", Verb::return_back},
                                             {"STOP", Verb::stop},
                                             {"BLOCKSTART", Verb::block_start},
                                             {"BLOCKSTOP", Verb::block_stop}}};

constexpr std::array<Plain, 10> words_with_data{{{"F", Verb::feed},
                                                 {"TM", Verb::move_time},
                                                 {"TA", Verb::acceleration_time},
                                                 {"TS", Verb::s_curve_time},
                                                 {"DWELL", Verb::dwell},
                                                 {"DELAY", Verb::delay},
                                                 {"GOTO", Verb::go_to},
                                                 {"GOSUB", Verb::go_sub},
                                                 {"CALL", Verb::call},
                                                 {"N", Verb::label}}};

bool is_in(const std::string& word, std::string_view letters) {
    return word.size() == 1 && letters.find(word.front()) != std::string_view::npos;
}

class Compiler {
public:
    Compiler(const std::vector<Token>& line, bool plc) : words_(line), plc_(plc) {}

    std::optional<std::vector<Statement>> run() {
        while (!words_.ended()) {
            if (!take()) {
                return std::nullopt;
            }
        }
        end_line();
        return result_.empty() ? std::nullopt : std::optional(std::move(result_));
    }

private:
    Words words_;
    bool plc_;
    std::vector<Statement> result_;
    int move_ = -1; ///< the line's move, where more axes are added
    int open_whiles_ = 0, open_ifs_ = 0;

    Statement& add(Verb verb) {
        result_.push_back({});
        result_.back().verb = verb;
        return result_.back();
    }

    /// IF and WHILE with anything behind them end with the line.
    void end_line() {
        if (result_.empty()) {
            return;
        }
        const Verb last = result_.back().verb;
        if (last == Verb::if_true || last == Verb::otherwise || last == Verb::while_true) {
            (last == Verb::while_true ? open_whiles_ : open_ifs_) = 0;
        }
        for (; open_whiles_ > 0; --open_whiles_) {
            add(Verb::end_while).implied = true;
        }
        for (; open_ifs_ > 0; --open_ifs_) {
            add(Verb::end_if).implied = true;
        }
    }

    bool take() {
        return condition() || (plc_ ? assignment() || text() || plc_switch() || plain() : motion());
    }
    bool motion() {
        return assignment() || text() || plc_switch() || axes_of_mode() || home() || with_data() || place() ||
               normal() || axis_word() || code() || plain();
    }

    bool condition() {
        const bool is_while = words_.at("WHILE");
        if (!is_while && !words_.at("IF")) {
            return false;
        }
        words_.skip();
        auto condition = take_condition(words_);
        if (!condition) {
            return false;
        }
        add(is_while ? Verb::while_true : Verb::if_true).data = std::move(*condition);
        ++(is_while ? open_whiles_ : open_ifs_);
        return true;
    }

    bool assignment() {
        if (!is_in(words_.now().text, "IPQM") || words_.now().kind != Token::Kind::word) {
            return false;
        }
        const std::size_t here = words_.place();
        const char letter = words_.now().text.front();
        words_.skip();
        const auto index = words_.at("(") || words_.at_number() ? take_data(words_) : std::nullopt;
        if (!index || !words_.take("=")) {
            words_.go_to(here);
            return false;
        }
        auto value = take_expression(words_);
        if (!value) {
            return false;
        }
        Statement& set = add(Verb::set);
        set.letter = letter;
        set.data = *index;
        set.value = std::move(*value);
        return true;
    }

    bool text() {
        const bool command = words_.at("CMD");
        const std::string& character = words_.next(2).text;
        if (command && words_.next().text == "^" && character.size() == 1 && character >= "A" &&
            character <= "Z") {
            words_.go_to(words_.place() + 3);
            add(Verb::command).text = static_cast<char>(character.front() - '@');
            return true;
        }
        if ((!command && !words_.at("SEND")) || words_.next().kind != Token::Kind::quoted) {
            return false;
        }
        words_.skip();
        add(command ? Verb::command : Verb::send).text = words_.now().text;
        words_.skip();
        return true;
    }

    bool plc_switch() {
        const bool on = words_.at("ENABLE");
        if ((!on && !words_.at("DISABLE")) || words_.next().text != "PLC") {
            return false;
        }
        words_.skip();
        words_.skip();
        return numbers(add(on ? Verb::enable_plc : Verb::disable_plc), 31);
    }
    bool numbers(Statement& statement, int most) {
        do {
            const auto number = words_.take_index(most);
            if (!number) {
                return false;
            }
            statement.numbers.push_back(*number);
        } while (words_.take(","));
        return true;
    }

    bool axes_of_mode() {
        const bool absolute = words_.at("ABS");
        const bool incremental = words_.at("INC");
        if (!absolute && !incremental && !words_.at("FRAX")) {
            return false;
        }
        words_.skip();
        Statement& mode = add(absolute ? Verb::absolute : incremental ? Verb::incremental : Verb::feed_axes);
        if (!words_.take("(")) {
            return true;
        }
        do {
            const std::string letter = words_.now().text;
            const bool radius = letter == "R" && mode.verb != Verb::feed_axes;
            if (!radius && !is_in(letter, axis_letters)) {
                return false;
            }
            mode.radius = mode.radius || radius;
            mode.axes += radius ? "" : letter;
            words_.skip();
        } while (words_.take(","));
        return words_.take(")");
    }

    bool home() {
        const bool zero = words_.at("HOMEZ");
        if (!zero && !words_.at("HOME")) {
            return false;
        }
        words_.skip();
        return numbers(add(zero ? Verb::home_zero : Verb::home), 8);
    }

    bool with_data() {
        for (const Plain& one : words_with_data) {
            if (!words_.at(one.word)) {
                continue;
            }
            words_.skip();
            if (one.verb == Verb::label) {
                constexpr int greatest_label = 262'143;
                move_ = -1;
                return numbers(add(Verb::label), greatest_label);
            }
            auto data = take_data(words_);
            if (!data) {
                return false;
            }
            put(one.verb).data = std::move(*data);
            return true;
        }
        return false;
    }
    /// Feeds and times hold for the move of their line, wherever they stand in it.
    Statement& put(Verb verb) {
        const bool modal = verb == Verb::feed || verb == Verb::move_time || verb == Verb::acceleration_time ||
                           verb == Verb::s_curve_time;
        if (!modal || move_ < 0) {
            move_ = -1;
            return add(verb);
        }
        Statement statement;
        statement.verb = verb;
        return *result_.insert(result_.begin() + move_++, std::move(statement));
    }

    bool words_of_axes(Statement& statement, std::string_view letters) {
        while (is_in(words_.now().text, letters) && words_.now().kind == Token::Kind::word) {
            const char letter = words_.now().text.front();
            words_.skip();
            auto data = take_data(words_);
            if (!data) {
                return false;
            }
            statement.words.push_back({letter, std::move(*data)});
        }
        return !statement.words.empty();
    }

    bool place() { return words_.take("PSET") && words_of_axes(add(Verb::place), axis_letters); }
    bool normal() { return words_.take("NORMAL") && words_of_axes(add(Verb::normal), "IJK"); }

    bool axis_word() {
        if (!is_in(words_.now().text, "XYZABCUVWIJKR") || words_.now().kind != Token::Kind::word) {
            return false;
        }
        if (move_ < 0) {
            add(Verb::move);
            move_ = static_cast<int>(result_.size()) - 1;
        }
        return words_of_axes(result_[static_cast<std::size_t>(move_)], "XYZABCUVWIJKR");
    }

    bool code() {
        if (!is_in(words_.now().text, "GMTDS") || words_.now().kind != Token::Kind::word) {
            return false;
        }
        const char letter = words_.now().text.front();
        words_.skip();
        auto data = take_data(words_);
        if (!data) {
            return false;
        }
        move_ = -1;
        Statement& code = add(Verb::code);
        code.letter = letter;
        code.data = std::move(*data);
        return true;
    }

    bool plain() {
        for (const Plain& one : plain_words) {
            const bool fits = !plc_ || one.verb == Verb::otherwise || one.verb == Verb::end_if ||
                              one.verb == Verb::end_while;
            if (!fits || !words_.at(one.word)) {
                continue;
            }
            words_.skip();
            move_ = -1;
            add(one.verb);
            open_ifs_ += one.verb == Verb::otherwise && open_ifs_ == 0 && !words_.ended() ? 1 : 0;
            open_ifs_ -= one.verb == Verb::end_if && open_ifs_ > 0 ? 1 : 0;
            open_whiles_ -= one.verb == Verb::end_while && open_whiles_ > 0 ? 1 : 0;
            return true;
        }
        return false;
    }
};

/// Gives IF, ELSE and WHILE the places where they go on.
class Joiner {
public:
    explicit Joiner(std::vector<Statement>& statements) : statements_(statements) {}

    bool run() {
        for (int n = 0; n < std::ssize(statements_); ++n) {
            if (!join(n)) {
                return false;
            }
            last_closed_ = statements_[static_cast<std::size_t>(n)].verb == Verb::end_if ? last_closed_ : -1;
        }
        return open_.empty();
    }

private:
    std::vector<Statement>& statements_;
    std::vector<int> open_;
    int last_closed_ = -1; ///< the IF of an implied ENDIF just before: an ELSE may follow it

    Statement& at(int n) { return statements_[static_cast<std::size_t>(n)]; }
    [[nodiscard]] bool top_is(Verb a, Verb b) {
        return !open_.empty() && (at(open_.back()).verb == a || at(open_.back()).verb == b);
    }

    bool join(int n) {
        switch (at(n).verb) {
        case Verb::if_true:
        case Verb::while_true:
            open_.push_back(n);
            return true;
        case Verb::otherwise:
            return otherwise(n);
        case Verb::end_if:
            return end_if(n);
        case Verb::end_while:
            return end_while(n);
        default:
            return true;
        }
    }
    bool otherwise(int n) {
        if (last_closed_ >= 0) {
            at(last_closed_).jump = n + 1;
        } else if (top_is(Verb::if_true, Verb::if_true)) {
            at(open_.back()).jump = n + 1;
            open_.pop_back();
        } else {
            return false;
        }
        open_.push_back(n);
        return true;
    }
    bool end_if(int n) {
        if (!top_is(Verb::if_true, Verb::otherwise)) {
            return false;
        }
        last_closed_ = at(n).implied && at(open_.back()).verb == Verb::if_true ? open_.back() : -1;
        at(open_.back()).jump = n + 1;
        open_.pop_back();
        return true;
    }
    bool end_while(int n) {
        if (!top_is(Verb::while_true, Verb::while_true)) {
            return false;
        }
        at(n).jump = open_.back();
        at(open_.back()).jump = n + 1;
        open_.pop_back();
        return true;
    }
};

} // namespace

std::optional<std::vector<Statement>> compile(const std::vector<Token>& line, bool plc) {
    return Compiler(line, plc).run();
}

bool StoredProgram::add(const std::vector<Token>& line) {
    auto statements = compile(line, plc_);
    if (!statements) {
        return false;
    }
    lines_.push_back(line);
    std::move(statements->begin(), statements->end(), std::back_inserter(statements_));
    sound_ = false; // until it is joined again
    return true;
}

void StoredProgram::clear() {
    statements_.clear();
    lines_.clear();
    sound_ = true;
}

bool StoredProgram::join() {
    sound_ = Joiner(statements_).run();
    return sound_;
}

int StoredProgram::place_of(int label) const {
    if (label == 0) {
        return 0;
    }
    for (int n = 0; n < std::ssize(statements_); ++n) {
        const Statement& one = statements_[static_cast<std::size_t>(n)];
        if (one.verb == Verb::label && one.numbers.front() == label) {
            return n;
        }
    }
    return -1;
}

} // namespace millwright::pmac::card
