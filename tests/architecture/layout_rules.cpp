#include "tests/architecture/layout_rules.h"

#include <algorithm>
#include <array>
#include <cctype>
#include <map>
#include <set>
#include <string>
#include <string_view>

namespace millwright::architecture {
namespace {

constexpr std::size_t most_lines = 600;

constexpr std::array<std::string_view, 9> empty_names = {
    "common", "helper", "helpers", "manager", "misc", "stuff", "util", "utilities", "utils"};

bool says_nothing(std::string_view name) {
    const std::string_view stem = name.substr(0, name.find('.'));
    return std::ranges::find(empty_names, stem) != empty_names.end();
}

constexpr std::string_view list_name = "CMakeLists.txt";

bool is_list(std::string_view path) {
    return path == list_name || path.ends_with("/" + std::string(list_name));
}

/// What stands in a CMakeLists.txt, without comments: words, cut at brackets too.
std::vector<std::string> cmake_words(std::string_view text) {
    std::string code;
    for (const auto& line : lines_of(text)) {
        code += line.text.substr(0, line.text.find('#'));
        code += '\n';
    }
    std::ranges::replace_if(
        code, [](char c) { return c == '(' || c == ')' || c == '"'; }, ' ');
    const auto words = words_of(code);
    return {words.begin(), words.end()};
}

using Lists = std::map<std::string, std::set<std::string>>; // folder -> the words of its CMakeLists.txt

Lists lists_of(const std::vector<TextFile>& files) {
    Lists lists;
    for (const auto& [path, text] : files) {
        if (is_list(path)) {
            const auto words = cmake_words(text);
            lists[folder_of(path)] = {words.begin(), words.end()};
        }
    }
    return lists;
}

bool must_be_listed(std::string_view path) {
    const bool ours = is_inside(path, "app") || is_inside(path, "bench") || is_inside(path, "core") ||
                      is_inside(path, "tests") || is_inside(path, "ui");
    if (!ours || !is_header(path)) {
        return ours && is_source(path);
    }
    const bool library = is_inside(path, "core") || is_inside(path, "ui") ||
                         (is_inside(path, "app") && folder_of(path) != "app");
    return library && path.find("/internal/") == std::string_view::npos;
}

bool is_listed(const std::string& path, const Lists& lists) {
    std::string folder = folder_of(path);
    while (!lists.contains(folder)) {
        if (folder.empty()) {
            return false;
        }
        folder = folder_of(folder);
    }
    return lists.at(folder).contains(folder.empty() ? path : path.substr(folder.size() + 1));
}

// Later modules that the tests of one may link: what it is tried with.
struct TriedWith {
    std::string_view module, later;
};
constexpr std::array tried_with = {
    TriedWith{"millwright::plot", "millwright::hpgl"}, // plots that are read
    TriedWith{"millwright::emulators", "millwright::hpgl"},
    TriedWith{"millwright::motion", "millwright::gcode_programs"}, // programs that are read
    TriedWith{"millwright::drivers", "millwright::jobs"},          // what they are sent
    TriedWith{"millwright::drivers", "millwright::emulators"},
    TriedWith{"millwright::jobs", "millwright::emulators"},
    TriedWith{"millwright::emulators", "millwright::posts"}, // programs that are written
    TriedWith{"millwright::cordic_machine", "millwright::jobs"},
    TriedWith{"millwright::pmac_service", "millwright::pmac"}, // a card to be set up
    TriedWith{"millwright::cordic_machine",
              "millwright::cordic_control"}, // the promises of the whole processor
    TriedWith{"millwright::cordic_machine", "millwright::cordic_study"},
};

bool is_tried_with(std::string_view module, std::string_view later) {
    return std::ranges::any_of(
        tried_with, [&](const TriedWith& pair) { return pair.module == module && pair.later == later; });
}

/// The module a folder of tests is about: tests/core/grid -> millwright::grid.
std::string room_of_tests(std::string_view list) {
    const std::string folder = folder_of(list);
    constexpr std::string_view core_tests = "tests/core/";
    return folder.starts_with(core_tests) ? "millwright::" + folder.substr(core_tests.size()) : std::string();
}

std::string too_much_linked(const std::string& target, const std::string& room) {
    return "links " + target + ", but tests " + room + " alone";
}

} // namespace

std::vector<Finding> check_length(const std::vector<TextFile>& files) {
    std::vector<Finding> findings;
    for (const auto& [path, text] : files) {
        const std::size_t lines = lines_of(text).size();
        if (is_source(path) && lines > most_lines) {
            findings.push_back(
                {path, 0, std::to_string(lines) + " lines, more than 600: more than one subject"});
        }
    }
    return findings;
}

std::vector<Finding> check_names(const std::vector<TextFile>& files) {
    std::vector<Finding> findings;
    for (const auto& file : files) {
        std::string_view rest = file.path;
        while (!rest.empty()) {
            const auto name = rest.substr(0, rest.find('/'));
            if (says_nothing(name)) {
                findings.push_back({file.path, 0, "'" + std::string(name) + "' does not say what is inside"});
            }
            rest.remove_prefix(std::min(name.size() + 1, rest.size()));
        }
    }
    return findings;
}

std::vector<Finding> check_lists(const std::vector<TextFile>& files) {
    const Lists lists = lists_of(files);
    std::vector<Finding> findings;
    for (const auto& [folder, words] : lists) {
        if (words.contains("GLOB") || words.contains("GLOB_RECURSE")) {
            findings.push_back({folder + "/" + std::string(list_name), 0, "files are listed, never globbed"});
        }
    }
    for (const auto& file : files) {
        if (must_be_listed(file.path) && !is_listed(file.path, lists)) {
            findings.push_back({file.path, 0, "not listed in the CMakeLists.txt of its folder"});
        }
    }
    return findings;
}

std::vector<Finding> check_test_links(const std::vector<TextFile>& files) {
    std::vector<Finding> findings;
    for (const auto& [path, text] : files) {
        const std::string room = is_list(path) ? room_of_tests(path) : std::string();
        if (room.empty()) {
            continue;
        }
        for (const auto& word : cmake_words(text)) {
            if (word.starts_with("millwright::") && word != room && !is_tried_with(room, word)) {
                findings.push_back({path, 0, too_much_linked(word, room)});
            }
        }
    }
    return findings;
}

} // namespace millwright::architecture
