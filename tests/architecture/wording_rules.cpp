#include "tests/architecture/wording_rules.h"

#include <array>
#include <regex>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::architecture {
namespace {

/// A phrase that is not written, and the remedy.
struct Phrase {
    std::string_view pattern; ///< regular expression, without regard to case
    std::string_view remedy;
};
constexpr std::array phrases = {
    Phrase{
        R"(\b(mm|inch|inches|degrees|iterations|nodes|points|bytes|lines|moves|turns|records|samples|times|rows|)"
        R"(places|kilobytes|megabytes) an? (minute|second|iteration|step|track|round|move|block|line|pixel|mm|)"
        R"(inch|turn|revolution|record|point|node|hour)\b)",
        "'per', as in mm per minute"},
    Phrase{R"(\b(depth|iterations|mean|cost|time) a (pass|round|move|step|point|line)\b)",
           "'per', as in depth per pass"},
    Phrase{R"(\bnobody\b)", "name who or what"},
    Phrase{R"(\bothers than\b)", "'other than'"},
    Phrase{R"(\b(is|are|was|were|be) told\b)", "'reported' or 'shown'"},
    Phrase{R"(\bto (its|their) end\b)", "'completely', or say what ends"},
    Phrase{R"(\b(in|by) so many\b)", "'number of ...'"},
    Phrase{R"(\bnothing speaks against\b)", "say what is certain"},
    Phrase{R"(\bby itself\b)", "'automatically', or leave it out"},
};

struct Rule {
    std::regex pattern;
    std::string_view remedy;
};

/// Of a blank in a pattern there may be several in a text.
const std::vector<Rule>& phrase_rules() {
    static const std::vector<Rule> all = [] {
        std::vector<Rule> made;
        for (const Phrase& phrase : phrases) {
            std::string pattern;
            for (const char letter : phrase.pattern) {
                pattern += letter == ' ' ? std::string(" +") : std::string(1, letter);
            }
            made.push_back(
                {std::regex(pattern, std::regex::ECMAScript | std::regex::icase | std::regex::optimize),
                 phrase.remedy});
        }
        return made;
    }();
    return all;
}

/// The text between the quotes of every literal of a line, joined by blanks; comments are left out.
std::string literals_of(std::string_view line) {
    std::string text;
    bool inside = false;
    for (std::size_t n = 0; n < line.size(); ++n) {
        const char letter = line[n];
        if (!inside && line.substr(n).starts_with("//")) {
            break;
        }
        if (!inside && line.substr(n).starts_with("'\"'")) {
            n += 2;
        } else if (inside && letter == '\\') {
            ++n;
            text += ' ';
        } else if (letter == '"') {
            inside = !inside;
            text += inside ? "" : " ";
        } else if (inside) {
            text += letter;
        }
    }
    return text;
}

std::string prose_of(std::string_view line) {
    std::string text;
    bool code = false;
    for (const char letter : line) {
        if (letter == '`') {
            code = !code;
        } else if (!code) {
            text += letter;
        }
    }
    return text;
}

/// A literal that is cut in two by a line's end is looked at with the line before.
class Reader {
public:
    Reader(const TextFile& file, std::vector<Finding>& findings) : file_(file), findings_(findings) {}

    void read(int line, const std::string& text) {
        const std::string both = last_ + text;
        if (text.empty()) {
            last_.clear();
            return;
        }
        for (const Rule& rule : phrase_rules()) {
            for (std::sregex_iterator found(both.begin(), both.end(), rule.pattern), end; found != end;
                 ++found) {
                const auto stops = static_cast<std::size_t>(found->position() + found->length());
                if (stops > last_.size()) { // else it was found a line before
                    findings_.push_back(
                        {file_.path, line, "'" + found->str() + "': write " + std::string(rule.remedy)});
                }
            }
        }
        last_ = text;
    }

private:
    const TextFile& file_;
    std::vector<Finding>& findings_;
    std::string last_;
};

bool has_literals(std::string_view path) {
    return is_source(path) && (is_inside(path, "core") || is_inside(path, "ui") || is_inside(path, "app"));
}

bool is_page(std::string_view path) {
    return path.ends_with(".md") &&
           (path == "README.md" || is_inside(path, "docs/user") || is_inside(path, "docs/reference"));
}

} // namespace

std::vector<Finding> check_wording(const std::vector<TextFile>& files) {
    std::vector<Finding> findings;
    for (const TextFile& file : files) {
        if (!has_literals(file.path) && !is_page(file.path)) {
            continue;
        }
        Reader reader(file, findings);
        bool fenced = false;
        for (const Line& line : lines_of(file.text)) {
            if (has_literals(file.path)) {
                reader.read(line.number, literals_of(line.text));
            } else if (line.text.starts_with("```")) {
                fenced = !fenced;
            } else if (!fenced) {
                reader.read(line.number, prose_of(line.text) + " ");
            }
        }
    }
    return findings;
}

} // namespace millwright::architecture
