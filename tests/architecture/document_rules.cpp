#include "tests/architecture/document_rules.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <filesystem>
#include <iterator>
#include <map>
#include <regex>
#include <set>
#include <string>
#include <string_view>

namespace millwright::architecture {
namespace {

bool is_markdown(std::string_view path) {
    return path.ends_with(".md");
}

/// The lines of a Markdown text, each with the language of the fenced block it stands in.
struct MarkdownLine {
    Line line;
    bool fenced = false;
    std::string_view language; ///< what follows the opening fence: sh, cpp, nothing
};

std::vector<MarkdownLine> markdown_lines(std::string_view text) {
    std::vector<MarkdownLine> lines;
    bool fenced = false;
    std::string_view language;
    for (const auto& line : lines_of(text)) {
        if (line.text.starts_with("```")) {
            fenced = !fenced;
            language = fenced ? line.text.substr(3) : std::string_view{};
            continue;
        }
        lines.push_back({line, fenced, language});
    }
    return lines;
}

/// The text of each `code` span of a line, or the line without them.
struct Spans {
    std::vector<std::string_view> code;
    std::string prose;
};

Spans spans_of(std::string_view line) {
    Spans spans;
    while (true) {
        const auto begin = line.find('`');
        const auto end = begin == std::string_view::npos ? begin : line.find('`', begin + 1);
        if (end == std::string_view::npos) {
            spans.prose += line;
            return spans;
        }
        spans.prose += line.substr(0, begin);
        spans.code.push_back(line.substr(begin + 1, end - begin - 1));
        line = line.substr(end + 1);
    }
}

struct Link {
    int line = 0;
    std::string target;
};

/// The targets of [text](target) and ![text](target) outside of code.
std::vector<Link> links_in(std::string_view markdown) {
    std::vector<Link> links;
    for (const auto& [line, fenced, language] : markdown_lines(markdown)) {
        const std::string prose = fenced ? std::string() : spans_of(line.text).prose;
        for (auto at = prose.find("]("); at != std::string::npos; at = prose.find("](", at + 1)) {
            const auto end = std::min(prose.find(')', at), prose.size());
            links.push_back({line.number, prose.substr(at + 2, end - at - 2)});
        }
    }
    return links;
}

bool leads_outside(std::string_view target) {
    return target.starts_with("http://") || target.starts_with("https://") || target.starts_with("mailto:");
}

/// The anchor that a heading gets on the web: lower case, spaces to hyphens, only letters, digits, - and _
/// left.
std::string anchor_of(std::string_view heading) {
    std::string anchor;
    for (const char c : heading) {
        const auto byte = static_cast<unsigned char>(c);
        if (std::isalnum(byte) != 0 || c == '-' || c == '_' || byte >= 0x80) {
            anchor += static_cast<char>(byte < 0x80 ? std::tolower(byte) : byte);
        } else if (c == ' ') {
            anchor += '-';
        }
    }
    return anchor;
}

std::set<std::string> anchors_of(std::string_view text) {
    std::set<std::string> anchors;
    for (const auto& [line, fenced, language] : markdown_lines(text)) {
        const auto hashes = std::min(line.text.find_first_not_of('#'), line.text.size());
        if (!fenced && hashes > 0 && line.text.substr(hashes).starts_with(' ')) {
            anchors.insert(anchor_of(line.text.substr(hashes + 1)));
        }
    }
    return anchors;
}

using Anchors = std::map<std::string, std::set<std::string>>; // page -> anchors

std::string resolved(std::string_view page, const std::string& target) {
    const auto path = std::filesystem::path(folder_of(page)) / target;
    return path.lexically_normal().generic_string();
}

std::string fault_of_link(std::string_view page,
                          const std::string& target,
                          const Anchors& anchors,
                          const Exists& exists) {
    if (leads_outside(target)) {
        return {};
    }
    const auto hash = target.find('#');
    const std::string file = target.substr(0, hash);
    const std::string path = file.empty() ? std::string(page) : resolved(page, file);
    if (!exists(path)) {
        return "link to nothing: " + target;
    }
    if (hash == std::string::npos || !anchors.contains(path)) {
        return {};
    }
    return anchors.at(path).contains(target.substr(hash + 1)) ? "" : "no such heading: " + target;
}

/// The word as a path of the repository, or nothing if it does not look like one.
std::string path_in(std::string_view word) {
    constexpr std::array<std::string_view, 11> roots = {".ci/",
                                                        "app/",
                                                        "assets/",
                                                        "bench/",
                                                        "core/",
                                                        "docs/",
                                                        "scripts/",
                                                        "shaders/",
                                                        "tests/",
                                                        "third_party/",
                                                        "ui/"};
    const auto begins = [&](std::string_view root) { return word.starts_with(root); };
    if (std::ranges::none_of(roots, begins) || word.find_first_of("*<>{}$|~") != std::string_view::npos ||
        word.find("...") != std::string_view::npos) {
        return {};
    }
    word = word.substr(0, word.find_first_of("#:(),;")); // file.md#heading, file.cpp:12, file.cpp,
    while (word.ends_with('.') || word.ends_with('/')) {
        word.remove_suffix(1);
    }
    const auto upper = [](char c) { return c >= 'A' && c <= 'Z'; };
    const std::string_view name = word.substr(word.rfind('/') + 1);
    const std::string_view stem = name.substr(0, name.find('.'));
    const bool stand_in = std::ranges::all_of(stem, upper) && stem != "README";
    return stand_in ? std::string() : std::string(word);
}

std::vector<std::string> paths_in(std::string_view text) {
    std::vector<std::string> paths;
    for (const auto word : words_of(text)) {
        if (auto path = path_in(word); !path.empty()) {
            paths.push_back(std::move(path));
        }
    }
    return paths;
}

std::vector<std::string> paths_in(const MarkdownLine& line) {
    if (line.fenced) {
        return line.language == "sh" ? paths_in(line.line.text) : std::vector<std::string>();
    }
    std::vector<std::string> paths;
    for (const auto span : spans_of(line.line.text).code) {
        std::ranges::move(paths_in(span), std::back_inserter(paths));
    }
    return paths;
}

/// Pages of docs/ that a comment refers to.
std::vector<std::string> pages_in(std::string_view line) {
    const auto comment = line.find("//");
    if (comment == std::string_view::npos) {
        return {};
    }
    auto paths = paths_in(line.substr(comment));
    std::erase_if(paths,
                  [](const std::string& path) { return !is_inside(path, "docs") || !is_markdown(path); });
    return paths;
}

} // namespace

std::vector<Finding> check_links(const std::vector<TextFile>& files, const Exists& exists) {
    Anchors anchors;
    for (const auto& [path, text] : files) {
        if (is_markdown(path)) {
            anchors[path] = anchors_of(text);
        }
    }
    std::vector<Finding> findings;
    for (const auto& [page, text] : files) {
        for (const auto& [line, target] : is_markdown(page) ? links_in(text) : std::vector<Link>()) {
            if (auto fault = fault_of_link(page, target, anchors, exists); !fault.empty()) {
                findings.push_back({page, line, fault});
            }
        }
    }
    return findings;
}

std::vector<Finding> check_paths(const std::vector<TextFile>& files, const Exists& exists) {
    std::vector<Finding> findings;
    const auto check = [&](const std::string& file, int line, const std::vector<std::string>& paths) {
        for (const auto& path : paths) {
            if (!exists(path)) {
                findings.push_back({file, line, "names what is not there: " + path});
            }
        }
    };
    for (const auto& [path, text] : files) {
        if (is_markdown(path)) {
            for (const auto& line : markdown_lines(text)) {
                check(path, line.line.number, paths_in(line));
            }
        } else if (is_source(path)) {
            for (const auto& line : lines_of(text)) {
                check(path, line.number, pages_in(line.text));
            }
        }
    }
    return findings;
}

std::vector<Finding> check_tests(const std::vector<TextFile>& files) {
    const std::regex of_source(R"(TEST(?:_F|_P)?\((\w+),\s*(\w+)\))");
    const std::regex of_table(R"(`([A-Z]\w*\.(?:[A-Z]\w*|\*))`)");
    std::set<std::string> there;
    for (const TextFile& file : files) {
        for (std::sregex_iterator found(file.text.begin(), file.text.end(), of_source), end; found != end;
             ++found) {
            there.insert({found->str(1) + "." + found->str(2), found->str(1) + ".*"});
        }
    }
    std::vector<Finding> findings;
    for (const TextFile& file : files) {
        for (const Line& line : lines_of(file.path.ends_with(".md") ? file.text : std::string_view())) {
            const std::string text(line.text.starts_with('|') ? line.text : std::string_view());
            for (std::sregex_iterator found(text.begin(), text.end(), of_table), end; found != end; ++found) {
                if (!there.contains(found->str(1))) {
                    findings.push_back(
                        {file.path, line.number, "names a test that is not there: " + found->str(1)});
                }
            }
        }
    }
    return findings;
}

std::vector<Finding> check_items(const std::vector<TextFile>& files, std::string_view page) {
    const std::regex item(R"(\b[A-Z]\d+\b)");
    const std::regex of_row(R"(\| ([A-Z]\d+) .*)");
    std::set<std::string> named;
    for (const TextFile& file : files) {
        for (const Line& line : lines_of(file.path.starts_with("tests/") ? file.text : std::string_view())) {
            const std::string text(line.text.starts_with("//") ? line.text : std::string_view());
            for (std::sregex_iterator found(text.begin(), text.end(), item), end; found != end; ++found) {
                named.insert(found->str());
            }
        }
    }
    std::vector<Finding> findings;
    for (const TextFile& file : files) {
        for (const Line& line : lines_of(file.path == page ? file.text : std::string_view())) {
            const std::string text(line.text);
            std::smatch row;
            if (std::regex_match(text, row, of_row) && !named.contains(row.str(1))) {
                findings.push_back({file.path, line.number, "no test names it: " + row.str(1)});
            }
        }
    }
    return findings;
}

} // namespace millwright::architecture
