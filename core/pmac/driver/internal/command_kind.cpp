#include "core/pmac/driver/internal/command_kind.h"

#include "core/pmac/driver/card_words.h"

#include <algorithm>
#include <cctype>
#include <cstdlib>
#include <regex>
#include <string>

namespace millwright::pmac::internal {

namespace {

bool is(std::string_view line, const std::regex& whole) {
    return std::regex_match(line.begin(), line.end(), whole);
}

} // namespace

bool only_asks(std::string_view line) {
    static const std::regex questions(
        " *(([#&][0-9]+ *)?(P[0-9]+[.][.][0-9]+|P[0-9]*|[IMQ][0-9]+([.][.][0-9]+)?|[VF?]) *)+",
        std::regex::icase);
    return is(line, questions);
}

bool only_stops(std::string_view line) {
    static const std::regex stops(R"( *(([#&][0-9]+ *)?(J */|[AHQS\\/]) *)+)", std::regex::icase);
    return is(line, stops);
}

bool only_aborts(std::string_view line) {
    static const std::regex aborts(R"( *(([#&][0-9]+ *)?[AHQS\\/] *)+)", std::regex::icase);
    return is(line, aborts);
}

bool only_kills(std::string_view line) {
    static const std::regex kills(" *(([#&][0-9]+ *)?K *)+", std::regex::icase);
    return is(line, kills);
}

bool only_disables_plcs(std::string_view line) {
    static const std::regex disables("(D *I *S *(A *B *L *E *)?P *L *C *[0-9]+ *([.] *[.] *[0-9]+ *)?(, "
                                     "*[0-9]+ *([.] *[.] *[0-9]+ *)?)*)+",
                                     std::regex::icase);
    line.remove_prefix(std::min(line.find_first_not_of(' '), line.size()));
    return is(line, disables);
}

bool enables_plc(std::string_view line) {
    const std::vector<PlacedWord> words = placed_words(line);
    for (std::size_t n = 0; n + 1 < words.size(); ++n) {
        const bool enables = words[n].text == "ENABLE" && words[n + 1].text == "PLC";
        const std::string more = n + 3 < words.size() ? words[n + 3].text : "";
        if (enables && (n + 2 >= words.size() || words[n + 2].text != "31" || more == "," || more == ".")) {
            return true;
        }
    }
    return false;
}

bool runs_program(std::string_view line) {
    const std::vector<PlacedWord> words = placed_words(line);
    // The card refuses a line whole that no command begins: text as NONSENSE.
    constexpr std::string_view begin_nothing = "CDEGLNTUXY";
    if (!words.empty() && words.front().text.size() == 1 &&
        begin_nothing.find(words.front().text.front()) != std::string_view::npos) {
        return false;
    }
    for (std::size_t n = 0; n < words.size(); ++n) {
        // Behind a comma or a parenthesis they are an axis, or how an M-variable is read.
        const bool argument = n > 0 && (words[n - 1].text == "," || words[n - 1].text == "(");
        if ((words[n].text == "R" || words[n].text == "S") && !argument) {
            return true;
        }
    }
    return false;
}

bool jogs(std::string_view line) {
    static const std::regex jog("J *[:=^]", std::regex::icase);
    return line.find('"') == std::string_view::npos && std::regex_search(line.begin(), line.end(), jog);
}

bool jogs_without_end(std::string_view line) {
    static const std::regex jog("J *[-+]", std::regex::icase);
    return line.find('"') == std::string_view::npos && std::regex_search(line.begin(), line.end(), jog);
}

bool sets_p0(std::string_view line) {
    static const std::regex number(R"( *[-+]?([0-9]+\.?[0-9]*|\.[0-9]+) *)");
    return is(line, number);
}

bool only_sets(std::string_view line) {
    static const std::regex settings(
        " *([IPQM][0-9]+ *= *[-+]?[$0-9.][0-9A-F.]* *)+| *M[0-9]+ *-> *[*A-Z0-9:$,]+ *", std::regex::icase);
    return is(line, settings);
}

std::optional<MotorStep> step_of(std::string_view line) {
    static const std::regex step(" *#([1-8]) *J *: *([-+]?[0-9]{1,6})( +M[0-9]+)? *", std::regex::icase);
    std::cmatch found;
    if (!std::regex_match(line.data(), line.data() + line.size(), found, step)) {
        return std::nullopt;
    }
    return MotorStep{std::stoi(found[1]), std::stod(found[2])};
}

std::vector<MotorGoal> goals_of(std::string_view line, int& motor) {
    static const std::regex piece("# *([1-8])|J *([:=^]) *([-+]?[0-9]+[.]?[0-9]*|[-+]?[.][0-9]+)",
                                  std::regex::icase);
    std::vector<MotorGoal> goals;
    if (line.find('"') != std::string_view::npos) {
        return goals;
    }
    for (std::cregex_iterator at(line.data(), line.data() + line.size(), piece), end; at != end; ++at) {
        if ((*at)[1].matched) {
            motor = std::stoi((*at)[1]);
        } else {
            goals.push_back({motor, std::strtod((*at)[3].str().c_str(), nullptr), *(*at)[2].first != '='});
        }
    }
    return goals;
}

std::vector<PowerChange> power_changes_of(std::string_view line, int& motor) {
    static const std::regex piece("# *([1-8])|(J *[-+/=:^]|HM(?!Z)|HOME(?!Z)|^ *[$] *$)|"
                                  "(K)(?![A-Z])|(A)(?![-+A-Z0-9.(=])",
                                  std::regex::icase);
    std::vector<PowerChange> changes;
    if (line.find('"') != std::string_view::npos || line.find("->") != std::string_view::npos) {
        return changes; // of a buffer, or the definition of an axis A
    }
    for (std::cregex_iterator at(line.data(), line.data() + line.size(), piece), end; at != end; ++at) {
        const char before = (*at).position() > 0 ? line[static_cast<std::size_t>((*at).position()) - 1] : ' ';
        if ((*at)[1].matched) {
            motor = std::stoi((*at)[1]);
        } else if (std::isalpha(static_cast<unsigned char>(before)) != 0) {
            continue; // the end of another word
        } else if ((*at)[4].matched) {
            changes.push_back({std::nullopt, true});
        } else {
            changes.push_back({motor, !(*at)[3].matched});
        }
    }
    return changes;
}

bool opens_buffer(std::string_view line) {
    static const std::regex open(" *OPEN.*", std::regex::icase);
    return is(line, open);
}

bool closes_buffer(std::string_view line) {
    static const std::regex close(" *CLOSE.*", std::regex::icase);
    return is(line, close);
}

bool acts_at_once(std::string_view line) {
    if (line.find("->") != std::string_view::npos || only_asks(line)) {
        return false;
    }
    static const std::regex whole(R"( *([#&].*|H|HM|HOME|K|A|R|S|Q|[\\/]|[$]+[*]*|B *[0-9.]+ *[RS]?) *)",
                                  std::regex::icase);
    static const std::regex jog("(^|[^A-Z])J *[-+/=:^]", std::regex::icase);
    const std::string_view before_text = line.substr(0, line.find('"'));
    return is(line, whole) || std::regex_search(before_text.begin(), before_text.end(), jog);
}

bool begins_nothing(std::string_view line) {
    static const std::regex quiet(
        " *(CLOSE|CLS|CLEAR|CLR|DEL(ETE)? .*|UNDEF(INE)?.*|(& *[0-9]+ *)?#[0-9]+ *->.*|"
        "([#&][0-9]+ *)+) *",
        std::regex::icase);
    return only_asks(line) || only_sets(line) || is(line, quiet);
}

bool may_move_later(std::string_view line, int system) {
    static const std::regex address("& *([0-9]+)");
    if (enables_plc(line)) {
        return true;
    }
    for (std::cregex_iterator at(line.data(), line.data() + line.size(), address), end; at != end; ++at) {
        if ((*at)[1].str() != std::to_string(system)) {
            return true;
        }
    }
    return false;
}

bool opens_loop(std::string_view line) {
    static const std::regex output("(^|[^A-Z])O *[-+]?[0.]*([1-9(]|[IPQM][0-9])", std::regex::icase);
    return line.find('"') == std::string_view::npos && std::regex_search(line.begin(), line.end(), output);
}

} // namespace millwright::pmac::internal
