// What all generated Verilog has in common: constants of the format, arithmetic as functions, the wires of a
// step.
#pragma once

#include "core/cordic/arithmetic.h"
#include "core/cordic/number_format.h"
#include "core/cordic/sequence.h"

#include <cstdint>
#include <string>
#include <string_view>

namespace millwright::cordic::internal {

/// Names of the wires and registers that a step or correction works with.
struct VerilogStep {
    std::string x, y, z;
    std::string shifted_x, shifted_y;
    std::string plus;                   ///< true where it turns counter-clockwise
    std::string angle;                  ///< a constant, or what holds it
    std::string next_x, next_y, next_z; ///< wires to declare: {overflow, result}
};

class Verilog {
public:
    Verilog(const NumberFormat& format, const Sequence& sequence)
        : format_(format), sequence_(sequence), arithmetic_(format) {}

    [[nodiscard]] const Sequence& sequence() const { return sequence_; }
    [[nodiscard]] const FixedArithmetic& arithmetic() const { return arithmetic_; }
    [[nodiscard]] int word() const { return format_.word(); }
    [[nodiscard]] int digits() const { return (word() + 3) / 4; } ///< of a word in hexadecimal
    [[nodiscard]] int shift(int i) const { return sequence_.shifts[static_cast<std::size_t>(i)]; }
    /// 0 where a correction does nothing, and in a sequence that multiplies.
    [[nodiscard]] int correction(int j) const;
    [[nodiscard]] std::string hex(Word value) const;
    [[nodiscard]] std::string angle(int i) const;

    /// The first lines of a file.
    [[nodiscard]] std::string head(std::string_view what) const;
    /// Ports x_in, y_in, z_in and x, y, z; the latter as `kind`, "wire" or "reg".
    [[nodiscard]] std::string inputs() const;
    [[nodiscard]] std::string outputs(std::string_view kind) const;
    /// Word, its ends, sum, difference, shift and, where it is needed, the product with 1/k.
    [[nodiscard]] std::string functions() const;
    /// What each step and correction shifts by, as cases of a counter: s, angle, corrects, subtracts.
    [[nodiscard]] std::string step_cases() const;
    /// `text` with ports and wires of a word for its WORD, constants of the sequence for STEPS and CLOCKS.
    [[nodiscard]] std::string filled(std::string_view text) const;
    /// The three wires of an iteration's step.
    [[nodiscard]] std::string turned(const VerilogStep& step) const;

private:
    NumberFormat format_;
    Sequence sequence_;
    FixedArithmetic arithmetic_;
};

/// The modules of a file each. Where `count` vectors are asked for, some overflow; `seed` chooses them.
[[nodiscard]] std::string core_module(const Verilog& verilog);
[[nodiscard]] std::string pipeline_module(const Verilog& verilog);
/// How a bench ends that has counted `wrong` among COUNT of `what`.
[[nodiscard]] std::string bench_verdict(std::string_view what);
[[nodiscard]] std::string core_bench(const Verilog& verilog, std::int64_t count);
[[nodiscard]] std::string pipeline_bench(const Verilog& verilog, std::int64_t count);
[[nodiscard]] std::string test_vectors(const Verilog& verilog, std::int64_t count, std::uint64_t seed);

} // namespace millwright::cordic::internal
