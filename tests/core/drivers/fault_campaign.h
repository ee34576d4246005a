// What the fault campaigns of all drivers draw their runs with.
#pragma once

#include <cstdint>
#include <random>

namespace millwright::test {

using Random = std::mt19937_64;

/// One of 0 .. count - 1.
inline int pick(Random& random, int count) {
    return static_cast<int>(random() % static_cast<std::uint64_t>(count));
}

} // namespace millwright::test
