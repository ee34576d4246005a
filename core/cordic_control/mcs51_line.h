// The thesis's comparison on an MCS-51, executed: a program that computes a line, from its file, with lines
// of one's own and the clocks that each takes. assets/samples/line-8051.c is such a program.
#pragma once

#include <array>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::cordic {

/// Reads Intel HEX, records 00 and 01. Throws Error with the line for an invalid record, a wrong checksum
/// included, and for a file without its end. `file` is for messages.
[[nodiscard]] std::vector<std::uint8_t> read_intel_hex(std::string_view text, const std::string& file);

/// From (x0, y0) to (x1, y1), in thousandths of a unit of length.
struct Mcs51Line {
    std::int32_t x0 = 0, x1 = 0, y0 = 0, y1 = 0;
};

struct Mcs51LineRun {
    std::int64_t clocks = 0; ///< while P1.0 was high
    /// Amounts, for a speed and an acceleration of 1 along the line.
    double vx = 0.0, vy = 0.0, ax = 0.0, ay = 0.0;
    int sign_x = 0, sign_y = 0;
};

/// Executes `code` from reset, with the line in external memory from 0: x0, x1, y0, y1 as 32-bit integers,
/// speed and acceleration as binary32, lowest byte first. Behind them are the results, four binary32 and two
/// signs as bytes, read when P1.0 goes high again, or 3000 clocks after it went low. Throws Error, which
/// names `file`, if the processor stops or P1.0 does not go high and low again within 100,000,000 clocks.
[[nodiscard]] Mcs51LineRun
run_mcs51_line(const std::vector<std::uint8_t>& code, const Mcs51Line& line, const std::string& file);

} // namespace millwright::cordic
