// 128-bit integers, which g++ and clang have and the standard has not, and the product of two of them.
#pragma once

#include <compare>

namespace millwright::cordic {

__extension__ using Int128 = __int128;
__extension__ using UInt128 = unsigned __int128;

struct UInt256 {
    UInt128 high = 0, low = 0;

    friend constexpr auto operator<=>(const UInt256&, const UInt256&) = default;
};

[[nodiscard]] constexpr UInt256 product(UInt128 a, UInt128 b) {
    constexpr int half = 64;
    constexpr UInt128 mask = (UInt128{1} << half) - 1;
    const UInt128 low = (a & mask) * (b & mask);
    const UInt128 first = (a >> half) * (b & mask) + (low >> half); // no carry: (2^64 - 1)^2 + 2^64 - 1
    const UInt128 second = (a & mask) * (b >> half) + (first & mask);
    return {(a >> half) * (b >> half) + (first >> half) + (second >> half), second << half | (low & mask)};
}

} // namespace millwright::cordic
