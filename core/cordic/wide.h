// 128-bit integers, which g++ and clang have and the standard has not.
#pragma once

namespace millwright::cordic {

__extension__ using Int128 = __int128;

} // namespace millwright::cordic
