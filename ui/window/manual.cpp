#include "ui/window/manual.h"

#include "core/base/error.h"
#include "ui/window/internal/embedded_manual.h"

#include <array>
#include <filesystem>
#include <string>

namespace millwright::panels {

namespace {

using widgets::ReadingBlock;
using widgets::ReadingKind;

/// In the order of actions::Workspace.
constexpr std::array<std::string_view, actions::workspace_count> pages{"user/design.md",
                                                                       "user/grid.md",
                                                                       "user/toolpath.md",
                                                                       "user/program.md",
                                                                       "user/machine.md",
                                                                       "user/processor.md",
                                                                       "user/plots.md",
                                                                       "user/arm.md"};

std::string_view trimmed(std::string_view text) {
    const auto first = text.find_first_not_of(' ');
    return first == std::string_view::npos ? std::string_view()
                                           : text.substr(first, text.find_last_not_of(' ') - first + 1);
}

/// Takes the next line off `text`.
std::string_view next_line(std::string_view& text) {
    const auto end = text.find('\n');
    const std::string_view line = text.substr(0, end);
    text.remove_prefix(end == std::string_view::npos ? text.size() : end + 1);
    return line;
}

/// The number of # before a heading; 0: it is none.
std::size_t heading_level(std::string_view line) {
    const auto rank = line.find_first_not_of('#');
    return rank != std::string_view::npos && rank > 0 && line[rank] == ' ' ? rank : 0;
}

/// The address of a link behind its words, `at` being on the bracket that ends them: its last character.
std::size_t end_of_address(std::string_view text, std::size_t at) {
    const bool has_one = at + 1 < text.size() && text[at + 1] == '(';
    const auto end = has_one ? text.find(')', at) : std::string_view::npos;
    return end == std::string_view::npos ? at : end;
}

/// The page that `address` leads to from one in `folder`: "docs/reference/pmac.md". Empty for a place of the
/// same page, and where no folder is given.
std::string linked_page(std::string_view address, std::string_view folder) {
    const std::string_view file = address.substr(0, address.find('#'));
    if (folder.empty() || file.empty()) {
        return {};
    }
    return file.find("://") != std::string_view::npos
               ? std::string(file)
               : (std::filesystem::path(folder) / file).lexically_normal().generic_string();
}

/// Without the marks for code, stress and links; inside of code everything stays as it is. Behind the words
/// of a link stands the page that it leads to, since nothing here can be followed.
std::string plain(std::string_view text, std::string_view folder) {
    std::string result;
    bool code = false;
    std::size_t words = 0; // of a link, where they begin
    for (std::size_t n = 0; n < text.size(); ++n) {
        const char c = text[n];
        if (c == '`') {
            code = !code;
        } else if (code || (c != '*' && c != '[' && c != ']')) {
            result += c;
        } else if (c == '[') {
            words = result.size();
        } else if (c == ']') {
            const std::size_t end = end_of_address(text, n);
            const std::string place = end > n ? linked_page(text.substr(n + 2, end - n - 2), folder) : "";
            if (!place.empty() && place.ends_with(result.substr(words))) {
                result.replace(words, std::string::npos, place); // the words are its name
            } else if (!place.empty()) {
                result += " (" + place + ")";
            }
            n = end;
        }
    }
    return result;
}

std::vector<std::string> cells_of(std::string_view row, std::string_view folder) {
    std::vector<std::string> cells;
    bool code = false;
    std::size_t begin = 1;
    for (std::size_t n = 1; n < row.size(); ++n) {
        code = row[n] == '`' ? !code : code;
        if (row[n] == '|' && !code) {
            cells.push_back(plain(trimmed(row.substr(begin, n - begin)), folder));
            begin = n + 1;
        }
    }
    return cells;
}

/// |---|---|
bool is_rule(std::string_view line) {
    return line.find_first_not_of("|-: ") == std::string_view::npos;
}

/// Goes through the lines of a page, joining those that belong together.
class Reader {
public:
    explicit Reader(std::string_view folder) : folder_(folder) {}

    void line(std::string_view line) {
        const std::string_view words = trimmed(line);
        if (words.starts_with("```")) {
            fenced_ = !fenced_;
            return end();
        }
        if (fenced_) {
            blocks_.push_back({ReadingKind::code, {std::string(line)}});
            return;
        }
        if (words.empty() || words.starts_with("![")) {
            return end();
        }
        if (words.starts_with('|')) {
            return row(words);
        }
        if (const std::size_t rank = heading_level(words); rank > 0) {
            end();
            blocks_.push_back({ReadingKind::heading, {plain(words.substr(rank + 1), folder_)}});
        } else if (words.starts_with("- ")) {
            begin(ReadingKind::item, words.substr(2));
        } else if (open_) {
            text_ += " ";
            text_ += words;
        } else if (line.starts_with("    ")) {
            blocks_.push_back({ReadingKind::code, {std::string(words)}});
        } else {
            begin(ReadingKind::paragraph, words);
        }
    }
    [[nodiscard]] std::vector<ReadingBlock> blocks() {
        end();
        return std::move(blocks_);
    }

private:
    void begin(ReadingKind kind, std::string_view words) {
        end();
        kind_ = kind;
        text_ = words;
        open_ = true;
    }
    void end() {
        if (open_) {
            blocks_.push_back({kind_, {plain(text_, folder_)}});
        }
        open_ = false;
    }
    void row(std::string_view words) {
        end();
        if (is_rule(words)) {
            if (!blocks_.empty()) {
                blocks_.back().kind = ReadingKind::head_row;
            }
        } else {
            blocks_.push_back({ReadingKind::row, cells_of(words, folder_)});
        }
    }

    std::string_view folder_;
    std::vector<ReadingBlock> blocks_;
    ReadingKind kind_ = ReadingKind::paragraph;
    std::string text_; ///< with its marks: those may stand on two lines
    bool open_ = false;
    bool fenced_ = false; ///< between two lines of three backticks
};

} // namespace

std::vector<ReadingBlock> reading_of(std::string_view markdown, std::string_view folder) {
    Reader reader(folder);
    while (!markdown.empty()) {
        reader.line(next_line(markdown));
    }
    return reader.blocks();
}

std::string_view section_of(std::string_view markdown, std::string_view heading) {
    const std::size_t rank = heading_level(heading);
    std::string_view rest = markdown;
    while (!rest.empty() && next_line(rest) != heading) {
    }
    const std::string_view section = rest;
    while (!rest.empty()) {
        const std::size_t before = section.size() - rest.size();
        if (const std::size_t other = heading_level(next_line(rest)); other > 0 && other <= rank) {
            return section.substr(0, before);
        }
    }
    return section;
}

std::vector<ReadingBlock> manual_of(actions::Workspace workspace) {
    auto blocks = reading_of(embedded_page(pages.at(static_cast<std::size_t>(workspace))), "docs/user");
    expects(!blocks.empty(), "the manual has a page for every workspace");
    blocks.push_back({ReadingKind::paragraph,
                      {"Pages named docs/\u2026 are files in the docs folder of the source code."}});
    return blocks;
}

std::vector<ReadingBlock> manual_of_commands() {
    return reading_of(section_of(embedded_page("reference/pmac.md"), "## On-line commands"),
                      "docs/reference");
}

} // namespace millwright::panels
