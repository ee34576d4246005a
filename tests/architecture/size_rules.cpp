#include "tests/architecture/size_rules.h"

#include <algorithm>
#include <cctype>
#include <functional>
#include <map>
#include <set>
#include <utility>

namespace millwright::architecture {
namespace {

constexpr int most_lines_of_function = 60;
constexpr int most_flags = 5;
constexpr int most_lines_of_module = 12'000;

bool is_word_letter(char c) {
    return std::isalnum(static_cast<unsigned char>(c)) != 0 || c == '_';
}

/// Blanks all but the ends of lines.
void blank(std::string& text, std::size_t from, std::size_t to) {
    for (std::size_t n = from; n < std::min(to, text.size()); ++n) {
        text[n] = text[n] == '\n' ? '\n' : ' ';
    }
}

/// Behind the literal that begins at `from` with `quote`.
std::size_t behind_literal(std::string_view text, std::size_t from, char quote) {
    std::size_t n = from + 1;
    while (n < text.size() && text[n] != quote && text[n] != '\n') {
        n += text[n] == '\\' ? 2 : 1;
    }
    return n + 1;
}

std::size_t behind_raw_string(std::string_view text, std::size_t quote) {
    const std::size_t open = text.find('(', quote);
    const std::string end =
        ")" + std::string(text.substr(quote + 1, open - quote - 1)) + "\""; // R"mark( ... )mark"
    const std::size_t at = text.find(end, open);
    return at == std::string_view::npos ? text.size() : at + end.size();
}

/// Behind a comment or a literal that begins at `n`; `n` itself where none does.
std::size_t behind_what_is_no_code(std::string_view text, std::size_t n) {
    const bool after_word = n > 0 && is_word_letter(text[n - 1]);
    if (text.substr(n, 2) == "//") {
        return std::min(text.find('\n', n), text.size());
    }
    if (text.substr(n, 2) == "/*") {
        const std::size_t end = text.find("*/", n + 2);
        return end == std::string_view::npos ? text.size() : end + 2;
    }
    if (text[n] == '"') {
        return after_word && text[n - 1] == 'R' ? behind_raw_string(text, n) : behind_literal(text, n, '"');
    }
    return text[n] == '\'' && !after_word ? behind_literal(text, n, '\'') : n; // 1'000 is a number
}

/// Without comments, literals and lines of the preprocessor, with its lines.
std::string code_of(std::string_view text) {
    std::string code(text);
    for (std::size_t n = 0; n < text.size();) {
        const std::size_t end = behind_what_is_no_code(text, n);
        blank(code, n, end);
        n = std::max(end, n + 1);
    }
    for (std::size_t begin = 0; begin < code.size();) {
        const std::size_t end = std::min(code.find('\n', begin), code.size());
        const std::size_t first = code.find_first_not_of(" \t", begin);
        if (first < end && code[first] == '#') {
            blank(code, begin, end);
        }
        begin = end + 1;
    }
    return code;
}

bool begins_with_word(std::string_view text, std::string_view word) {
    return text.starts_with(word) && (text.size() == word.size() || !is_word_letter(text[word.size()]));
}

bool has_word(std::string_view text, std::string_view word) {
    for (std::size_t at = text.find(word); at != std::string_view::npos; at = text.find(word, at + 1)) {
        if ((at == 0 || !is_word_letter(text[at - 1])) && begins_with_word(text.substr(at), word)) {
            return true;
        }
    }
    return false;
}

/// The words of a head in one line.
std::string joined(std::string_view head) {
    std::string text;
    for (const std::string_view word : words_of(head)) {
        text += (text.empty() ? "" : " ") + std::string(word);
    }
    return text;
}

/// What stands before the parameters: `Dispatcher::run`, `operator==`.
std::string function_name(std::string_view head) {
    std::size_t open = head.find('(');
    if (const std::size_t call = head.find("operator()"); call != std::string_view::npos && call < open) {
        open = call + std::string_view("operator()").size();
    }
    const std::size_t begin = head.substr(0, open).find_last_of(" \t\n*&");
    return joined(head.substr(begin == std::string_view::npos ? 0 : begin + 1,
                              open - (begin == std::string_view::npos ? 0 : begin + 1)));
}

std::string class_name(std::string_view head) {
    const std::string text = joined(head);
    for (const std::string_view key : {"class ", "struct "}) {
        if (const std::size_t at = text.rfind(key); at != std::string::npos) {
            const std::size_t from = at + key.size();
            return text.substr(from, text.find_first_of(" :", from) - from);
        }
    }
    return {};
}

enum class Scope { space, type, function, other };

/// Of what begins with a brace behind `head`, which lies in `around`.
Scope scope_of(std::string_view head, Scope around) {
    if (around == Scope::function || around == Scope::other) {
        return Scope::other;
    }
    if (has_word(head, "namespace") || (words_of(head).size() == 1 && has_word(head, "extern"))) {
        return Scope::space;
    }
    const std::size_t parameters = head.find('(');
    const bool initialised = head.substr(0, parameters).find('=') != std::string_view::npos &&
                             !has_word(head.substr(0, parameters), "operator");
    if (parameters != std::string_view::npos && !initialised && !has_word(head, "requires")) {
        const bool type =
            (has_word(head, "class") || has_word(head, "struct")) && !has_word(head, "template");
        return type ? Scope::type : Scope::function;
    }
    if (has_word(head, "enum") || initialised) {
        return Scope::other;
    }
    return has_word(head, "class") || has_word(head, "struct") ? Scope::type : Scope::other;
}

/// One opened brace.
struct Open {
    Scope scope = Scope::space;
    int line = 0;
    std::string name;
    int flags = 0;
    std::size_t statement = 0; ///< where the statement began that goes on behind it
};

bool is_flag(std::string_view statement) {
    std::string text = joined(statement);
    for (const std::string_view access : {"public:", "private:", "protected:"}) {
        if (const std::size_t at = text.rfind(access); at != std::string::npos) {
            text = text.substr(at + access.size());
            text = joined(text);
        }
    }
    if (text.find('(') != std::string::npos) {
        return false;
    }
    text = text.starts_with("mutable ") ? text.substr(8) : text;
    return text.starts_with("bool ") || text.starts_with("std::atomic<bool> ");
}

/// How many it declares: bool a, b;
int flags_in(std::string_view statement) {
    return is_flag(statement) ? 1 + static_cast<int>(std::ranges::count(statement, ',')) : 0;
}

/// Reads the braces of a text and reports what was closed.
class Braces {
public:
    explicit Braces(std::string_view text) : code_(code_of(text)) { open_.push_back({}); }

    void read(const std::function<void(const Open&, int line)>& closed) {
        for (std::size_t n = 0; n < code_.size(); ++n) {
            const char c = code_[n];
            line_ += c == '\n' ? 1 : 0;
            depth_ += c == '(' ? 1 : c == ')' ? -1 : 0;
            if (c == '{') {
                begin(n);
            } else if (c == '}' && open_.size() > 1) {
                end(n, closed);
            } else if (c == ';' && depth_ == 0) {
                open_.back().flags += flags_in(statement(n));
                statement_ = n + 1;
            }
        }
    }

private:
    [[nodiscard]] std::string_view statement(std::size_t end) const {
        return std::string_view(code_).substr(statement_, end - statement_);
    }

    void begin(std::size_t n) {
        const std::string_view head = statement(n);
        const Scope scope =
            depth_ > 0 || initialises_member(head, n) ? Scope::other : scope_of(head, open_.back().scope);
        const std::string name = scope == Scope::function ? function_name(head) : class_name(head);
        open_.push_back({scope, line_, name, 0, statement_});
        depths_.push_back(std::exchange(depth_, 0));
        statement_ = n + 1;
    }

    /// A brace of a constructor's list: `: a_{1}, b_(2) {`.
    [[nodiscard]] bool initialises_member(std::string_view head, std::size_t n) const {
        const std::size_t list = head.rfind(')');
        if (list == std::string_view::npos || head.find(':', list) == std::string_view::npos || n == 0 ||
            !is_word_letter(code_[n - 1])) {
            return false;
        }
        return true;
    }

    void end(std::size_t n, const std::function<void(const Open&, int line)>& closed) {
        const Open was = open_.back();
        open_.pop_back();
        depth_ = depths_.back();
        depths_.pop_back();
        closed(was, line_);
        statement_ = was.scope == Scope::other ? was.statement : n + 1;
        if (was.scope == Scope::other && depth_ == 0 &&
            (open_.back().scope == Scope::function || open_.back().scope == Scope::other)) {
            statement_ = n + 1;
        }
    }

    std::string code_;
    std::vector<Open> open_;
    std::vector<int> depths_; ///< of round brackets, around each brace
    int depth_ = 0;
    int line_ = 1;
    std::size_t statement_ = 0; ///< where it began
};

bool is_product(std::string_view path) {
    return is_source(path) && (is_inside(path, "app") || is_inside(path, "bench") ||
                               is_inside(path, "core") || is_inside(path, "ui"));
}

/// `what` is measured, in `unit`.
std::vector<Finding> check_sizes(const std::vector<TextFile>& files,
                                 std::span<const Larger> larger,
                                 int most,
                                 const std::function<std::vector<Sized>(std::string_view)>& measure,
                                 const std::string& unit) {
    std::vector<Finding> findings;
    std::set<const Larger*> needed;
    for (const auto& [path, text] : files) {
        for (const Sized& found : is_product(path) ? measure(text) : std::vector<Sized>()) {
            if (found.size <= most) {
                continue;
            }
            const auto listed = std::ranges::find_if(larger, [&, &file = path](const Larger& entry) {
                return entry.path == file && entry.name == found.name;
            });
            const int allowed = listed == larger.end() ? most : listed->most;
            if (listed != larger.end()) {
                needed.insert(&*listed);
            }
            if (found.size > allowed) {
                findings.push_back({path,
                                    found.line,
                                    found.name + " has " + std::to_string(found.size) + " " + unit +
                                        ", more than " + std::to_string(allowed)});
            }
        }
    }
    for (const Larger& entry : larger) {
        if (!needed.contains(&entry)) {
            findings.push_back({std::string(entry.path),
                                0,
                                std::string(entry.name) + " is within the limit: take it off the list"});
        }
    }
    return findings;
}

} // namespace

std::vector<Sized> functions_of(std::string_view text) {
    std::vector<Sized> functions;
    Braces(text).read([&](const Open& closed, int line) {
        if (closed.scope == Scope::function) {
            functions.push_back({closed.name, closed.line, line - closed.line + 1});
        }
    });
    return functions;
}

std::vector<Sized> flags_of(std::string_view text) {
    std::vector<Sized> classes;
    Braces(text).read([&](const Open& closed, int) {
        if (closed.scope == Scope::type) {
            classes.push_back({closed.name, closed.line, closed.flags});
        }
    });
    return classes;
}

std::vector<Finding> check_functions(const std::vector<TextFile>& files, std::span<const Larger> larger) {
    return check_sizes(files, larger, most_lines_of_function, functions_of, "lines");
}

std::vector<Finding> check_modules(const std::vector<TextFile>& files, std::span<const Larger> larger) {
    std::map<std::string, int> modules;
    for (const auto& [path, text] : files) {
        if (is_product(path) && !is_inside(path, "bench")) {
            const std::size_t part = path.find('/');
            const std::size_t folder = path.find('/', part + 1); // none: a file of app itself
            modules[path.substr(0, folder == std::string::npos ? part : folder)] +=
                static_cast<int>(lines_of(text).size());
        }
    }
    std::vector<Finding> findings;
    for (const auto& [module, lines] : modules) {
        const auto listed = std::ranges::find(larger, module, &Larger::path);
        const int allowed = listed == larger.end() ? most_lines_of_module : listed->most;
        if (lines > allowed) {
            findings.push_back(
                {module, 0, std::to_string(lines) + " lines, more than " + std::to_string(allowed)});
        } else if (listed != larger.end() && lines <= most_lines_of_module) {
            findings.push_back({module, 0, "is within the limit: take it off the list"});
        }
    }
    return findings;
}

std::vector<Finding> check_flags(const std::vector<TextFile>& files, std::span<const Larger> larger) {
    return check_sizes(files, larger, most_flags, flags_of, "flags");
}

} // namespace millwright::architecture
