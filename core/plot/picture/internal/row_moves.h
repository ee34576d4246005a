// The moves of one row of a relief. mm.
#pragma once

#include <vector>

namespace millwright::plot::internal {

struct Node {
    double x = 0.0;
    double z = 0.0;
};

/// A node for each height, `pitch` apart from x = 0 on, higher by `allowance`.
[[nodiscard]] std::vector<Node> nodes_of(const std::vector<float>& heights, double pitch, double allowance);

/// Some of the nodes, with both ends, in the order given (which may run either way): straight moves between
/// them are nowhere below those between all, and nowhere above them by more than `tolerance`.
[[nodiscard]] std::vector<Node> merged(const std::vector<Node>& nodes, double tolerance);

/// The parts of the row where something below `ceiling` is to be cut, each with its neighbours on both sides;
/// parts nearer to each other than `nearest` are one.
[[nodiscard]] std::vector<std::vector<Node>>
runs_below(const std::vector<Node>& nodes, double ceiling, double nearest);

} // namespace millwright::plot::internal
