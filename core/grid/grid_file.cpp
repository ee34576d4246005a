#include "core/grid/grid_file.h"

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/text.h"

#include <algorithm>
#include <array>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace millwright::grid {

namespace {

constexpr int decimals = 8;
constexpr std::size_t width = 18;
constexpr double farthest = 1e9; // what 18 places hold
constexpr std::string_view folded_cell = "is folded";

/// A number of the file and its position.
struct Number {
    double value = 0.0;
    int line = 0;
    int column = 0;
};

[[noreturn]] void fail_in_file(
    const std::filesystem::path& file, int line, int column, std::string message, std::string hint = {}) {
    Diagnostic found;
    found.place = {.file = file, .line = line, .column = column};
    found.message = std::move(message);
    found.hint = std::move(hint);
    throw Error(std::move(found));
}

bool is_blank(char c) {
    return c == ' ' || c == '\t' || c == '\r' || c == '\v' || c == '\f';
}

/// At most the first 40 bytes, with everything that does not print as a dot.
std::string quoted(std::string_view word) {
    constexpr std::size_t most = 40;
    std::string text(word.substr(0, most));
    std::ranges::replace_if(
        text, [](char c) { return c < ' ' || c > '~'; }, '.');
    return "\"" + text + (word.size() > most ? "..." : "") + "\"";
}

double number(std::string_view word, const std::filesystem::path& file, int line, int column) {
    const std::string_view digits = word.front() == '+' ? word.substr(1) : word;
    double value = 0.0;
    const auto [end, fault] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
    if (fault == std::errc::result_out_of_range) {
        fail_in_file(file, line, column, quoted(word) + " is too large or too small");
    }
    if (fault != std::errc{} || end != digits.data() + digits.size()) {
        fail_in_file(file, line, column, quoted(word) + " is not a number");
    }
    if (!std::isfinite(value)) {
        fail_in_file(file, line, column, quoted(word) + " is not finite");
    }
    return value;
}

/// The numbers of one line; `text` has no newline.
std::vector<Number> numbers_of_line(std::string_view text, const std::filesystem::path& file, int line) {
    std::vector<Number> found;
    std::size_t at = 0;
    while (at < text.size()) {
        if (is_blank(text[at])) {
            ++at;
            continue;
        }
        std::size_t end = at;
        while (end < text.size() && !is_blank(text[end])) {
            ++end;
        }
        const int column = static_cast<int>(at) + 1;
        found.push_back({number(text.substr(at, end - at), file, line, column), line, column});
        at = end;
    }
    return found;
}

/// The lines that have numbers.
std::vector<std::vector<Number>> numbers_of(std::string_view text, const std::filesystem::path& file) {
    std::vector<std::vector<Number>> lines;
    int line = 0;
    refuse_wide_text(text, file);
    text = without_byte_order_mark(text);
    while (!text.empty()) {
        const std::size_t end = std::min(text.find('\n'), text.size());
        std::vector<Number> found = numbers_of_line(text.substr(0, end), file, ++line);
        if (!found.empty()) {
            lines.push_back(std::move(found));
        }
        text.remove_prefix(std::min(end + 1, text.size()));
    }
    return lines;
}

using Lines = std::vector<std::vector<Number>>;

/// The nodes, and where x and y of each stand, row-major.
struct Placed {
    NodeArray nodes;
    std::vector<std::array<Number, 2>> places;
};

[[noreturn]] void
fail_at(const std::filesystem::path& file, const Number& at, std::string message, std::string hint = {}) {
    fail_in_file(file, at.line, at.column, std::move(message), std::move(hint));
}

std::string node_name(int i, int j) {
    return "(" + std::to_string(i) + ", " + std::to_string(j) + ")";
}

/// The corners of cell (i, j) one after another around it.
using Corner = std::array<int, 2>;
std::array<Corner, 4> corners_of(int i, int j) {
    return {Corner{i, j}, Corner{i + 1, j}, Corner{i + 1, j + 1}, Corner{i, j + 1}};
}

/// Two corners in one place, as the rest of a sentence; empty if there are none.
std::string same_corners(const NodeArray& nodes, int i, int j) {
    const std::array<Corner, 4> corners = corners_of(i, j);
    for (std::size_t a = 0; a < 4; ++a) {
        for (std::size_t b = a + 1; b < 4; ++b) {
            if (nodes.at(corners[a][0], corners[a][1]) == nodes.at(corners[b][0], corners[b][1])) {
                return "nodes " + node_name(corners[a][0], corners[a][1]) + " and " +
                       node_name(corners[b][0], corners[b][1]) + " are at the same position";
            }
        }
    }
    return {};
}

/// The sines of the angles at the corners of cell (i, j): the least and the largest.
std::array<double, 2> sines(const NodeArray& nodes, int i, int j) {
    const std::array<Corner, 4> corners = corners_of(i, j);
    const auto at = [&](std::size_t k) { return nodes.at(corners[k % 4][0], corners[k % 4][1]); };
    std::array<double, 2> found{2.0, -2.0};
    for (std::size_t k = 0; k < 4; ++k) {
        const Vec2 ahead = (at(k + 1) - at(k)).normalized();
        const Vec2 back = (at(k + 3) - at(k)).normalized();
        const double sine = ahead.x() * back.y() - ahead.y() * back.x();
        found = {std::min(found[0], sine), std::max(found[1], sine)};
    }
    return found;
}

/// What is wrong with cell (i, j), as the rest of a sentence; empty if nothing is.
std::string fault_of_cell(const NodeArray& nodes, int i, int j) {
    constexpr double rounding = 1e-12; // of a sine: a line that is not parallel to an axis is none to the bit
    if (const std::string same = same_corners(nodes, i, j); !same.empty()) {
        return "has no area: " + same;
    }
    const auto [least, largest] = sines(nodes, i, j);
    if (std::max(std::abs(least), std::abs(largest)) <= rounding) {
        return "has no area: its nodes lie on one line";
    }
    return least > rounding ? std::string() : std::string(folded_cell);
}

void require_near(const Placed& found, const std::filesystem::path& file) {
    for (const std::array<Number, 2>& place : found.places) {
        for (const Number& coordinate : place) {
            if (std::abs(coordinate.value) > farthest) {
                fail_at(file, coordinate, "A coordinate of this node exceeds 1e9");
            }
        }
    }
}

void require_inside(const Placed& found, const std::filesystem::path& file, const WantedNodes& wanted) {
    for (std::size_t n = 0; n < found.places.size(); ++n) {
        const int i = static_cast<int>(n) / found.nodes.columns,
                  j = static_cast<int>(n) % found.nodes.columns;
        for (const std::size_t k : {0U, 1U}) {
            const Number& coordinate = found.places[n][k];
            const double high = wanted.most[static_cast<Eigen::Index>(k)];
            if (coordinate.value < 0.0 || coordinate.value > high) {
                fail_at(file,
                        coordinate,
                        std::string(1, "xy"[k]) + " of node " + node_name(i, j) + " is " +
                            shortest(coordinate.value) + ", outside the surface, which goes from 0 to " +
                            shortest(high),
                        wanted.hint);
            }
        }
    }
}

bool has_cell(const NodeArray& nodes, int i, int j) {
    return i >= 0 && j >= 0 && i + 1 < nodes.rows && j + 1 < nodes.columns;
}

int faulty_cells_at(const NodeArray& nodes, const Corner& node) {
    int count = 0;
    for (const int i : {node[0] - 1, node[0]}) {
        for (const int j : {node[1] - 1, node[1]}) {
            count += has_cell(nodes, i, j) && !fault_of_cell(nodes, i, j).empty() ? 1 : 0;
        }
    }
    return count;
}

/// Of a cell's corners the one that spoils the most cells, the first of several.
Corner suspect_of_cell(const NodeArray& nodes, int i, int j) {
    const std::array<Corner, 4> corners = corners_of(i, j);
    return *std::ranges::max_element(
        corners, {}, [&](const Corner& node) { return faulty_cells_at(nodes, node); });
}

/// The coordinate that is farther from the mean of the neighbours' in both directions: 0 or 1.
std::size_t suspect_coordinate(const NodeArray& nodes, const Corner& node) {
    Vec2 off = Vec2::Zero();
    const auto [i, j] = node;
    if (i > 0 && i + 1 < nodes.rows) {
        off += (nodes.at(i, j) - 0.5 * (nodes.at(i - 1, j) + nodes.at(i + 1, j))).cwiseAbs();
    }
    if (j > 0 && j + 1 < nodes.columns) {
        off += (nodes.at(i, j) - 0.5 * (nodes.at(i, j - 1) + nodes.at(i, j + 1))).cwiseAbs();
    }
    return off.y() > off.x() ? 1 : 0;
}

/// Where the first fault is, and what; nothing where no cell is folded.
std::optional<std::pair<Number, std::string>> first_fold(const Placed& found) {
    const NodeArray& nodes = found.nodes;
    for (int i = 0; i + 1 < nodes.rows; ++i) {
        for (int j = 0; j + 1 < nodes.columns; ++j) {
            const std::string fault = fault_of_cell(nodes, i, j);
            if (fault.empty()) {
                continue;
            }
            const bool folded = fault == folded_cell;
            const Corner node = folded ? suspect_of_cell(nodes, i, j) : Corner{i, j};
            return std::pair(
                found.places[nodes.index(node[0], node[1])][folded ? suspect_coordinate(nodes, node) : 0],
                "The cell from node " + node_name(i, j) + " " + fault);
        }
    }
    return std::nullopt;
}

/// The same nodes with rows and columns exchanged, or with x and y exchanged.
NodeArray with_exchanged_indices(const NodeArray& nodes) {
    NodeArray other(nodes.columns, nodes.rows);
    for (int i = 0; i < nodes.rows; ++i) {
        for (int j = 0; j < nodes.columns; ++j) {
            other.at(j, i) = nodes.at(i, j);
        }
    }
    return other;
}

NodeArray with_exchanged_coordinates(NodeArray nodes) {
    for (Vec2& node : nodes.nodes) {
        std::swap(node.x(), node.y());
    }
    return nodes;
}

bool is_sound(const NodeArray& nodes) {
    for (int i = 0; i + 1 < nodes.rows; ++i) {
        for (int j = 0; j + 1 < nodes.columns; ++j) {
            if (!fault_of_cell(nodes, i, j).empty()) {
                return false;
            }
        }
    }
    return true;
}

/// What is exchanged in a grid that is folded, or has rows for columns; empty where nothing is.
std::string exchange_hint(const NodeArray& nodes, const WantedNodes& wanted) {
    const bool has_sizes = nodes.rows == wanted.columns && nodes.columns == wanted.rows;
    const bool by_indices = has_sizes && is_sound(with_exchanged_indices(nodes));
    const bool by_coordinates = is_sound(with_exchanged_coordinates(nodes));
    constexpr const char* right = ": x grows from row to row, y along a row";
    if (by_indices && by_coordinates) {
        return std::string("rows and columns, or x and y, are exchanged") + right;
    }
    if (by_indices || by_coordinates) {
        return (by_indices ? "rows and columns are exchanged" : "x and y are exchanged") + std::string(right);
    }
    return has_sizes && is_sound(nodes) ? "rows and columns are exchanged, and x and y, too" : "";
}

/// `hint` tells what else the file may be.
void require_unfolded(const Placed& found, const std::filesystem::path& file, const std::string& hint = {}) {
    if (const auto fold = first_fold(found)) {
        fail_at(file, fold->first, fold->second, hint);
    }
}

/// Throws Error for a wrong count.
Placed placed_pairs(const Lines& lines, const std::filesystem::path& file, int rows, int columns) {
    std::vector<Number> all;
    for (const std::vector<Number>& line : lines) {
        all.insert(all.end(), line.begin(), line.end());
    }
    const std::size_t wanted = 2 * static_cast<std::size_t>(rows) * static_cast<std::size_t>(columns);
    const std::string sentence = std::to_string(rows) + " x " + std::to_string(columns) + " nodes need " +
                                 std::to_string(wanted) + " numbers, but there are " +
                                 std::to_string(all.size());
    if (all.size() > wanted) {
        fail_at(file, all[wanted], sentence);
    }
    if (all.size() < wanted) {
        fail_in_file(file, all.empty() ? 1 : all.back().line, all.empty() ? 1 : all.back().column, sentence);
    }
    Placed found{NodeArray(rows, columns), {}};
    for (std::size_t k = 0; k < found.nodes.nodes.size(); ++k) {
        found.nodes.nodes[k] = Vec2(all[2 * k].value, all[2 * k + 1].value);
        found.places.push_back({all[2 * k], all[2 * k + 1]});
    }
    return found;
}

/// Throws Error for lines that are no two blocks.
Placed placed_blocks(const Lines& lines, const std::filesystem::path& file) {
    if (lines.size() < 4 || lines.size() % 2 != 0) {
        fail_in_file(file,
                     lines.empty() ? 1 : lines.back().front().line,
                     1,
                     "Two blocks need an even number of lines, at least 4; there are " +
                         std::to_string(lines.size()));
    }
    const std::size_t columns = lines.front().size();
    for (const std::vector<Number>& line : lines) {
        if (line.size() != columns || columns < 2) {
            fail_at(file,
                    line[std::min(columns, line.size() - 1)],
                    counted(std::ssize(line), "number") + " in this line, but " +
                        std::to_string(std::max<std::size_t>(columns, 2)) + " are needed");
        }
    }
    const std::size_t rows = lines.size() / 2;
    Placed found{NodeArray(static_cast<int>(rows), static_cast<int>(columns)), {}};
    for (std::size_t i = 0; i < rows; ++i) {
        for (std::size_t j = 0; j < columns; ++j) {
            found.nodes.nodes[i * columns + j] = Vec2(lines[i][j].value, lines[rows + i][j].value);
            found.places.push_back({lines[i][j], lines[rows + i][j]});
        }
    }
    return found;
}

/// In the form of its lines. Throws Error where they are a sound grid in both forms.
Placed placed_in_either(const Lines& lines, const std::filesystem::path& file, int rows, int columns) {
    const bool like_blocks =
        lines.size() == 2 * static_cast<std::size_t>(rows) &&
        std::ranges::all_of(lines, [&](const auto& line) { return std::ssize(line) == columns; });
    if (!like_blocks) {
        return placed_pairs(lines, file, rows, columns);
    }
    Placed blocks = placed_blocks(lines, file), pairs = placed_pairs(lines, file, rows, columns);
    const bool sound_pairs = !first_fold(pairs);
    if (sound_pairs && !first_fold(blocks)) {
        throw Error("this file can be read as pairs and as blocks", file, "specify the form");
    }
    return sound_pairs ? pairs : blocks;
}

std::string padded(double value) {
    std::string text = fixed(value, decimals);
    return text.size() < width ? std::string(width - text.size(), ' ') + text : text;
}

} // namespace

std::string pairs_text(const NodeArray& nodes) {
    std::string text;
    for (const Vec2& p : nodes.nodes) {
        text += fixed(p.x(), decimals) + " " + fixed(p.y(), decimals) + "\n";
    }
    return text;
}

std::string blocks_text(const NodeArray& nodes) {
    std::string text;
    for (const Eigen::Index coordinate : {0, 1}) {
        for (int i = 0; i < nodes.rows; ++i) {
            for (int j = 0; j < nodes.columns; ++j) {
                text += padded(nodes.at(i, j)[coordinate]) + " ";
            }
            text += "\n";
        }
    }
    return text;
}

NodeArray parse_pairs(std::string_view text, const std::filesystem::path& file, int rows, int columns) {
    expects(rows >= 2 && columns >= 2, "a grid file has at least 2 x 2 nodes");
    const Placed found = placed_pairs(numbers_of(text, file), file, rows, columns);
    require_near(found, file);
    require_unfolded(found, file);
    return found.nodes;
}

NodeArray parse_blocks(std::string_view text, const std::filesystem::path& file, FileContents contents) {
    const Placed found = placed_blocks(numbers_of(text, file), file);
    if (contents == FileContents::nodes) {
        require_near(found, file);
        require_unfolded(found,
                         file,
                         found.nodes.columns == 2
                             ? "specify rows and columns if this is a file of pairs (two numbers per line)"
                             : "");
    }
    return found.nodes;
}

NodeArray parse_nodes(std::string_view text, const std::filesystem::path& file, const WantedNodes& wanted) {
    expects(wanted.rows >= 2 && wanted.columns >= 2, "a grid file has at least 2 x 2 nodes");
    const Lines lines = numbers_of(text, file);
    const Placed found = !wanted.form ? placed_in_either(lines, file, wanted.rows, wanted.columns)
                         : *wanted.form == FileForm::pairs
                             ? placed_pairs(lines, file, wanted.rows, wanted.columns)
                             : placed_blocks(lines, file);
    if (found.nodes.rows != wanted.rows || found.nodes.columns != wanted.columns) {
        throw Error(std::to_string(found.nodes.rows) + " x " + std::to_string(found.nodes.columns) +
                        " nodes, but " + std::to_string(wanted.rows) + " x " +
                        std::to_string(wanted.columns) + " are needed",
                    file,
                    exchange_hint(found.nodes, wanted));
    }
    require_inside(found, file, wanted);
    require_unfolded(found, file, exchange_hint(found.nodes, wanted));
    return found.nodes;
}

} // namespace millwright::grid
