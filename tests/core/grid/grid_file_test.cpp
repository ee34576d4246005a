#include "core/grid/grid_file.h"

#include "core/base/error.h"
#include "tests/support/grid_arrays.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <limits>
#include <random>
#include <string>
#include <utility>

namespace millwright::grid {
namespace {

/// A grid with numbers of all lengths, spacing `step`.
NodeArray uneven_grid(int rows, int columns, double step) {
    std::mt19937 random(1997);
    std::uniform_real_distribution<double> away(-0.2, 0.2);
    NodeArray nodes = unit_spaced(rows, columns);
    for (Vec2& p : nodes.nodes) {
        const Vec2 shift(away(random) - 3.0, away(random) + 1.0);
        p = step * (p + shift);
    }
    return nodes;
}

std::string diagnostic_of(const std::string& text, FileContents contents = FileContents::nodes) {
    try {
        (void)parse_blocks(text, "grid.dat", contents);
    } catch (const Error& error) {
        return to_text(error.diagnostic());
    }
    return "read";
}

std::string pairs_diagnostic_of(const std::string& text, int rows, int columns) {
    try {
        (void)parse_pairs(text, "start.dat", rows, columns);
    } catch (const Error& error) {
        return to_text(error.diagnostic());
    }
    return "read";
}

// T11, T19.
TEST(GridFile, WritesBlocksEighteenWideWithEightDecimalsAndABlank) {
    NodeArray nodes(2, 2);
    nodes.at(0, 0) = Vec2(0.0, -1.5);
    nodes.at(0, 1) = Vec2(0.125, 2.0);
    nodes.at(1, 0) = Vec2(1234567.0, -1.0);
    nodes.at(1, 1) = Vec2(-0.000000004, 1e8);
    EXPECT_EQ(blocks_text(nodes),
              "        0.00000000         0.12500000 \n"
              "  1234567.00000000         0.00000000 \n"
              "       -1.50000000         2.00000000 \n"
              "       -1.00000000 100000000.00000000 \n");
}

TEST(GridFile, WritesOnePairALine) {
    EXPECT_EQ(pairs_text(unit_spaced(2, 2)),
              "0.00000000 0.00000000\n0.00000000 1.00000000\n1.00000000 0.00000000\n1.00000000 1.00000000\n");
}

TEST(GridFile, BlocksComeBackExactToEightDecimals) {
    for (const double step : {1e-3, 1.0, 1e6}) {
        const NodeArray nodes = uneven_grid(7, 12, step);
        const NodeArray found = parse_blocks(blocks_text(nodes), "grid.dat");
        ASSERT_EQ(found.rows, 7);
        ASSERT_EQ(found.columns, 12);
        for (std::size_t k = 0; k < nodes.nodes.size(); ++k) {
            EXPECT_LE((found.nodes[k] - nodes.nodes[k]).cwiseAbs().maxCoeff(),
                      0.6e-8); // half a unit and the rounding of the number itself
        }
        EXPECT_EQ(blocks_text(found), blocks_text(nodes));
    }
}

TEST(GridFile, PairsComeBackExactToEightDecimals) {
    const NodeArray nodes = uneven_grid(5, 3, 0.1);
    const NodeArray found = parse_pairs(pairs_text(nodes), "start.dat", 5, 3);
    EXPECT_EQ(pairs_text(found), pairs_text(nodes));
}

TEST(GridFile, AByteOrderMarkIsSkipped) {
    const NodeArray nodes = uneven_grid(5, 3, 0.1);
    const std::string mark = "\xEF\xBB\xBF";
    EXPECT_EQ(pairs_text(parse_pairs(mark + pairs_text(nodes), "a.dat", 5, 3)), pairs_text(nodes));
    EXPECT_EQ(parse_blocks(mark + blocks_text(nodes), "a.dat").rows, 5);
}

TEST(GridFile, ResidualsMayBeWhatNoGridIs) {
    NodeArray residuals(2, 2);
    residuals.at(0, 1) = Vec2(-3e10, 4.0);
    EXPECT_EQ(parse_blocks(blocks_text(residuals), "orx.dat", FileContents::residuals), residuals);
    EXPECT_NE(diagnostic_of(blocks_text(residuals)), "read");
}

TEST(GridFile, ReadsPairsInAnyLayoutAndOtherEndsOfLines) {
    EXPECT_EQ(parse_pairs("0 0 0 1\r\n\r\n\t1 0\r\n+1.0e0\n1", "start.dat", 2, 2), unit_spaced(2, 2));
}

TEST(GridFile, BadBlocksAreNamedWithTheirPlace) {
    EXPECT_EQ(diagnostic_of(""),
              "grid.dat:1:1: Two blocks need an even number of lines, at least 4; there are 0");
    EXPECT_EQ(diagnostic_of("0 0\n1 1\n0 1\n"),
              "grid.dat:3:1: Two blocks need an even number of lines, at least 4; there are 3");
    EXPECT_EQ(diagnostic_of("0 0\n1 1\n0 1 2\n0 1\n"),
              "grid.dat:3:5: 3 numbers in this line, but 2 are needed");
    EXPECT_EQ(diagnostic_of("0 0\n1\n0 1\n0 1\n"), "grid.dat:2:1: 1 number in this line, but 2 are needed");
    EXPECT_EQ(diagnostic_of("0\n1\n0\n1\n"), "grid.dat:1:1: 1 number in this line, but 2 are needed");
    EXPECT_EQ(diagnostic_of("0 0\n1  one\n0 1\n0 1\n"), "grid.dat:2:4: \"one\" is not a number");
    EXPECT_EQ(diagnostic_of("0 0\n1 1,5\n0 1\n0 1\n"), "grid.dat:2:3: \"1,5\" is not a number");
    EXPECT_EQ(diagnostic_of("0 0\n1 nan\n0 1\n0 1\n"), "grid.dat:2:3: \"nan\" is not finite");
    EXPECT_EQ(diagnostic_of("0 0\n1 -inf\n0 1\n0 1\n"), "grid.dat:2:3: \"-inf\" is not finite");
    EXPECT_EQ(diagnostic_of("0 0\n1 1e999\n0 1\n0 1\n"), "grid.dat:2:3: \"1e999\" is too large or too small");
    EXPECT_EQ(diagnostic_of("0 0\n1 2e9\n0 1\n0 1\n"), "grid.dat:2:3: A coordinate of this node exceeds 1e9");
}

TEST(GridFile, AFoldedGridIsNamedByItsFirstCell) {
    NodeArray nodes = unit_spaced(4, 4);
    nodes.at(2, 2) = Vec2(0.5, 0.5);
    EXPECT_EQ(diagnostic_of(blocks_text(nodes)), "grid.dat:3:47: The cell from node (1, 1) is folded");
    EXPECT_EQ(pairs_diagnostic_of(pairs_text(nodes), 4, 4),
              "start.dat:11:1: The cell from node (1, 1) is folded");
}

std::string either_diagnostic_of(const std::string& text, const WantedNodes& wanted) {
    try {
        (void)parse_nodes(text, "start.dat", wanted);
    } catch (const Error& error) {
        return to_text(error.diagnostic());
    }
    return "read";
}

// What is written in either form is read without saying which.
TEST(GridFile, TheFormIsFoundFromTheLines) {
    for (const auto& [rows, columns] : {std::pair(12, 8), {8, 12}, {5, 2}, {2, 5}, {2, 2}, {4, 4}, {3, 2}}) {
        NodeArray nodes = unit_spaced(rows, columns);
        nodes.at(0, 1).x() = 0.125;
        nodes.at(1, 0).y() = 0.25;
        const WantedNodes wanted{.rows = rows, .columns = columns, .most = Vec2(rows - 1, columns - 1)};
        EXPECT_EQ(parse_nodes(pairs_text(nodes), "start.dat", wanted), nodes) << rows << " " << columns;
        EXPECT_EQ(parse_nodes(blocks_text(nodes), "start.dat", wanted), nodes) << rows << " " << columns;
    }
    EXPECT_EQ(either_diagnostic_of("0 0.25\n0 0.5\n0.5 0.75\n0.25 0.75\n", {.rows = 2, .columns = 2}),
              "start.dat: this file can be read as pairs and as blocks (specify the form)");
    EXPECT_EQ(either_diagnostic_of("0 0.25\n0 0.5\n0.5 0.75\n0.25 0.75\n",
                                   {.rows = 2, .columns = 2, .form = FileForm::pairs}),
              "read");
    EXPECT_EQ(either_diagnostic_of(blocks_text(unit_spaced(3, 4)),
                                   {.rows = 4, .columns = 3, .most = Vec2(3.0, 3.0)}),
              "start.dat:1:9: The cell from node (0, 0) has no area: nodes (0, 0) and (0, 1) are at the same "
              "position");
    EXPECT_EQ(
        either_diagnostic_of(blocks_text(unit_spaced(3, 4)),
                             {.rows = 4, .columns = 3, .form = FileForm::blocks}),
        "start.dat: 3 x 4 nodes, but 4 x 3 are needed (rows and columns are exchanged, and x and y, too)");
}

TEST(GridFile, ACoordinateOutsideOfTheSurfaceIsNamedWithItsOwnPlace) {
    NodeArray nodes = unit_spaced(4, 4);
    nodes.at(2, 1).y() = -0.5;
    const WantedNodes wanted{.rows = 4, .columns = 4, .most = Vec2(3.0, 3.0)};
    EXPECT_EQ(either_diagnostic_of(blocks_text(nodes), wanted),
              "start.dat:7:27: y of node (2, 1) is -0.5, outside the surface, which goes from 0 to 3");
    EXPECT_EQ(either_diagnostic_of(pairs_text(nodes), wanted),
              "start.dat:10:12: y of node (2, 1) is -0.5, outside the surface, which goes from 0 to 3");
}

TEST(GridFile, ACellWithoutAreaIsNamedWithWhatItsNodesDo) {
    NodeArray twice = unit_spaced(4, 4);
    twice.at(2, 1) = twice.at(1, 1);
    EXPECT_THAT(
        diagnostic_of(blocks_text(twice)),
        testing::EndsWith(
            "The cell from node (1, 0) has no area: nodes (2, 1) and (1, 1) are at the same position"));
    NodeArray row_on_row = unit_spaced(4, 4);
    for (int j = 0; j < 4; ++j) {
        row_on_row.at(2, j) = row_on_row.at(1, j) + Vec2(0.0, 0.25);
    }
    EXPECT_THAT(diagnostic_of(blocks_text(row_on_row)),
                testing::EndsWith("The cell from node (1, 0) has no area: its nodes lie on one line"));
    NodeArray slanted = unit_spaced(3, 5);
    for (Vec2& node : slanted.nodes) {
        node = (node.x() + 0.1 * node.y()) * Vec2(0.3, 0.7);
    }
    EXPECT_THAT(diagnostic_of(blocks_text(slanted)),
                testing::EndsWith("The cell from node (0, 0) has no area: its nodes lie on one line"));
    EXPECT_THAT(pairs_diagnostic_of("0.5 0.5\n0.5 0.5\n0.5 0.5\n0.5 0.5\n", 2, 2),
                testing::HasSubstr("nodes (0, 0) and (1, 0) are at the same position"));
}

TEST(GridFile, AWrongCountOfPairsIsNamedWithItsPlace) {
    EXPECT_EQ(pairs_diagnostic_of("0 0\n0 1\n1 0\n", 2, 2),
              "start.dat:3:3: 2 x 2 nodes need 8 numbers, but there are 6");
    EXPECT_EQ(pairs_diagnostic_of("0 0\n0 1\n1 0\n1 1 7\n", 2, 2),
              "start.dat:4:5: 2 x 2 nodes need 8 numbers, but there are 9");
    EXPECT_EQ(pairs_diagnostic_of("", 2, 2), "start.dat:1:1: 2 x 2 nodes need 8 numbers, but there are 0");
}

TEST(GridFile, AskingForNoCellsOrWritingNoNumbersIsADefect) {
    EXPECT_THROW((void)parse_pairs("0 0", "start.dat", 1, 1), Defect);
    NodeArray nodes = unit_spaced(2, 2);
    nodes.at(0, 0).x() = std::numeric_limits<double>::infinity();
    EXPECT_THROW((void)blocks_text(nodes), Defect);
}

} // namespace
} // namespace millwright::grid
