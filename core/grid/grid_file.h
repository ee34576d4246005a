// The text files of the thesis's solver. Pairs: "x y" of every node, row by row, no header, so the reader
// needs the size. Blocks: all x as one line per row, then all y; numbers 18 wide with 8 decimals, each
// followed by a blank; residuals are written the same way, R_X then R_Y. Source: (Parasilmongkol 1997, KMITL)
// appendix B.
#pragma once

#include "core/grid/node_array.h"

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

namespace millwright::grid {

/// How the numbers of a grid lie in a file.
enum class FileForm { pairs, blocks };

/// What the numbers of a file are.
enum class FileContents {
    nodes,     ///< of a grid: it must not be folded, coordinates lie within 1e9
    residuals, ///< any finite numbers
};

/// One pair a line. Throws Defect if a number is not finite.
[[nodiscard]] std::string pairs_text(const NodeArray& nodes);
[[nodiscard]] std::string blocks_text(const NodeArray& nodes);

/// Reading `text`, the bytes of `file`. Each throws Error with file, line and column at the first thing that
/// is no finite number, at a wrong count, at a folded cell. At least 2 x 2 nodes; otherwise Error (Defect for
/// rows and columns below 2). What blocks_text wrote comes back exact to 8 decimals.
[[nodiscard]] NodeArray
parse_pairs(std::string_view text, const std::filesystem::path& file, int rows, int columns);
[[nodiscard]] NodeArray parse_blocks(std::string_view text,
                                     const std::filesystem::path& file,
                                     FileContents contents = FileContents::nodes);

/// The nodes that a file is required to have.
struct WantedNodes {
    int rows = 0, columns = 0;
    std::optional<FileForm> form{}; ///< nothing: that in which the file has these nodes, unfolded
    Vec2 most = Vec2::Ones();       ///< x lies from 0 to most.x(), y from 0 to most.y()
    std::string hint{};             ///< for a coordinate that does not
};

/// As the two above. Also throws Error where a coordinate is out of its range, with its place, and where
/// without a form the file is a sound grid in both.
[[nodiscard]] NodeArray
parse_nodes(std::string_view text, const std::filesystem::path& file, const WantedNodes& wanted);

} // namespace millwright::grid
