#include "tests/architecture/standard_header_rules.h"

#include "tests/architecture/include_rules.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace millwright::architecture {
namespace {

/// A name in namespace std and the headers of which one has to be there.
struct Declared {
    std::string_view name;
    std::array<std::string_view, 5> headers;
};
constexpr std::array declarations = {
    Declared{"abs", {"cmath", "cstdlib"}},
    Declared{"array", {"array"}},
    Declared{"atomic", {"atomic"}},
    Declared{"chrono", {"chrono"}},
    Declared{"clamp", {"algorithm"}},
    Declared{"condition_variable", {"condition_variable"}},
    Declared{"deque", {"deque"}},
    Declared{"error_code", {"system_error"}},
    Declared{"exchange", {"utility"}},
    Declared{"filesystem", {"filesystem"}},
    Declared{"from_chars", {"charconv"}},
    Declared{"function", {"functional"}},
    Declared{"hypot", {"cmath"}},
    Declared{"initializer_list", {"initializer_list"}},
    Declared{"int32_t", {"cstdint"}},
    Declared{"int64_t", {"cstdint"}},
    Declared{"isfinite", {"cmath"}},
    Declared{"jthread", {"thread"}},
    Declared{"lock_guard", {"mutex"}},
    Declared{"make_shared", {"memory"}},
    Declared{"make_unique", {"memory"}},
    Declared{"map", {"map"}},
    Declared{"max", {"algorithm"}},
    Declared{"min", {"algorithm"}},
    Declared{"move", {"utility"}},
    Declared{"mutex", {"mutex"}},
    Declared{"nullopt", {"optional"}},
    Declared{"numeric_limits", {"limits"}},
    Declared{"optional", {"optional"}},
    Declared{"pair", {"utility", "map"}},
    Declared{"ptrdiff_t", {"cstddef", "string", "string_view", "vector", "array"}},
    Declared{"ranges", {"algorithm", "ranges"}},
    Declared{"scoped_lock", {"mutex"}},
    Declared{"set", {"set"}},
    Declared{"shared_ptr", {"memory"}},
    Declared{"size_t", {"cstddef", "string", "string_view", "vector", "array"}},
    Declared{"sort", {"algorithm"}},
    Declared{"span", {"span"}},
    Declared{"sqrt", {"cmath"}},
    Declared{"stop_token", {"stop_token"}},
    Declared{"string", {"string"}},
    Declared{"string_view", {"string_view"}},
    Declared{"thread", {"thread"}},
    Declared{"tuple", {"tuple"}},
    Declared{"uint16_t", {"cstdint"}},
    Declared{"uint32_t", {"cstdint"}},
    Declared{"uint64_t", {"cstdint"}},
    Declared{"uint8_t", {"cstdint"}},
    Declared{"unique_lock", {"mutex"}},
    Declared{"unique_ptr", {"memory"}},
    Declared{"variant", {"variant"}},
    Declared{"vector", {"vector"}},
};

/// Every path that a header includes, itself and through our own headers.
class Closure {
public:
    explicit Closure(const std::vector<TextFile>& files) {
        for (const auto& [path, text] : files) {
            if (is_header(path)) {
                texts_[path] = text;
            }
        }
    }

    [[nodiscard]] std::set<std::string_view> of(std::string_view header) const {
        std::set<std::string_view> reached;
        add(header, reached);
        return reached;
    }

private:
    std::map<std::string_view, std::string_view> texts_;

    void add(std::string_view header, std::set<std::string_view>& reached) const {
        const auto found = texts_.find(header);
        if (found == texts_.end()) {
            return;
        }
        for (const auto& include : includes_of(found->second)) {
            if (reached.insert(include.path).second) {
                add(include.path, reached);
            }
        }
    }
};

bool is_word(char letter) {
    return std::isalnum(static_cast<unsigned char>(letter)) != 0 || letter == '_';
}

/// The names behind each `prefix` of a line, without its comment.
std::vector<std::string_view> names_behind(std::string_view prefix, std::string_view line) {
    line = line.substr(0, line.find("//"));
    std::vector<std::string_view> names;
    for (auto at = line.find(prefix); at != std::string_view::npos; at = line.find(prefix, at + 1)) {
        const auto rest = line.substr(at + prefix.size());
        const auto end = std::ranges::find_if_not(rest, is_word) - rest.begin();
        names.push_back(rest.substr(0, static_cast<std::size_t>(end)));
    }
    return names;
}

} // namespace

std::vector<Finding> check_standard_headers(const std::vector<TextFile>& files) {
    std::vector<Finding> findings;
    const Closure closure(files);
    for (const auto& [path, text] : files) {
        if (!is_header(path)) {
            continue;
        }
        const auto reached = closure.of(path);
        for (const auto& line : lines_of(text)) {
            for (const std::string_view library : {"fmt", "Eigen"}) {
                const auto is_of_it = [&](std::string_view header) {
                    return header.starts_with(std::string(library) + "/");
                };
                if (!names_behind(std::string(library) + "::", line.text).empty() &&
                    std::ranges::none_of(reached, is_of_it)) {
                    findings.push_back(
                        {path, line.number, "needs a header of <" + std::string(library) + "/...>"});
                }
            }
            for (const auto name : names_behind("std::", line.text)) {
                const auto* declared = std::ranges::find(declarations, name, &Declared::name);
                const auto has = [&](std::string_view header) { return reached.contains(header); };
                if (declared != declarations.end() && std::ranges::none_of(declared->headers, has)) {
                    findings.push_back({path,
                                        line.number,
                                        "std::" + std::string(name) + " needs <" +
                                            std::string(declared->headers.front()) + ">"});
                }
            }
        }
    }
    return findings;
}

} // namespace millwright::architecture
