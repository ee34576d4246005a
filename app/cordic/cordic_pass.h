// The raw passes of millwright cordic rotate and vector: CORDIC-R and CORDIC-V as the thesis's functions.
#pragma once

#include "core/cordic/number_format.h"
#include "core/cordic/sequence.h"
#include "core/cordic_study/single_pass.h"

#include <CLI/App.hpp>

#include <array>
#include <string>
#include <vector>

namespace millwright::app {

struct CordicPassOptions {
    std::string system = "circular";
    bool raw = false;
    bool folds = false;
    bool matlab_zero = false;
    std::string z; ///< that vectoring begins with; empty: 0

    /// A pass of the iteration, without reducing the angle and shifting the vector.
    [[nodiscard]] bool is_raw() const { return raw || system != "circular"; }
};

/// Adds --system.
void add_cordic_system(CLI::App& command, std::string& system);
/// Adds --system, --raw, --fold and --matlab-zero.
void add_cordic_pass(CLI::App& command, CordicPassOptions& options);

/// Registers as hexadecimal numbers.
[[nodiscard]] std::vector<std::string> hexadecimal_words(const std::array<cordic::Word, 3>& words);

/// Throws Error for options that only a raw pass has, if it is not a raw pass.
void refuse_pass_options(const CordicPassOptions& options);

/// Prints the pass. Throws Error as single_pass().
int print_cordic_pass(const cordic::NumberFormat& format,
                      const cordic::Sequence& sequence,
                      const cordic::PassInput& input,
                      bool as_json);

} // namespace millwright::app
