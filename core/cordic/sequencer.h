// The microprogram sequencer: which micro-instruction comes next. Sixteen operations with a counter and a
// stack of four, as in table 2.2 of the thesis; what the table leaves open (polarity, counter tests) is that
// of the Am2910, whose operations these are (AMD, Am2900 family data book), but for the depth of the stack.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string_view>

namespace millwright::cordic {

enum class MicroOp : std::uint8_t {
    JZ,   ///< to 0, empties the stack
    CJS,  ///< pass: call the branch address
    JMAP, ///< to the mapping ROM's address
    CJP,  ///< pass: to the branch address
    PUSH, ///< push the next address; pass: load the counter from the branch field
    JSRP, ///< call: pass the branch address, fail the counter's
    CJV,  ///< pass: to the vector's address
    JRP,  ///< pass: to the branch address, fail to the counter's
    RFCT, ///< counter not 0: count down and to the top of the stack; 0: pop, next
    RPCT, ///< counter not 0: count down and to the branch address; 0: next
    CRTN, ///< pass: return
    CJPP, ///< pass: pop and to the branch address
    LDCT, ///< load the counter from the branch field
    LOOP, ///< fail: to the top of the stack; pass: pop, next
    CONT, ///< next
    TWB,  ///< pass: pop, next; fail: as RFCT, but to the branch address at 0
};

inline constexpr int micro_op_count = 16;
inline constexpr int stack_depth = 4;

[[nodiscard]] std::string_view to_text(MicroOp op);
[[nodiscard]] std::optional<MicroOp> micro_op_of(std::string_view name);

enum class SequencerFault : std::uint8_t {
    none,
    overflow, ///< of the stack
    underflow,
    no_next ///< the operation goes on, or is to come back, behind the last address
};

struct SequencerState {
    std::uint8_t address = 0; ///< of the micro-instruction that is executed next
    std::uint8_t counter = 0;
    std::array<std::uint8_t, stack_depth> stack{}; ///< the first `depth` are in use
    std::uint8_t depth = 0;
    SequencerFault fault = SequencerFault::none; ///< of the last step; the state is then as before it

    friend bool operator==(const SequencerState&, const SequencerState&) = default;
};

/// Where a step can get an address from.
struct SequencerInputs {
    bool pass = false; ///< the condition
    std::uint8_t branch = 0;
    std::uint8_t map = 0;
    std::uint8_t vector = 0;
};

/// One clock. A call or PUSH with four on the stack, a return or loop with none, and what needs the address
/// behind the last one do nothing but report.
void step(SequencerState& state, MicroOp op, const SequencerInputs& inputs);

} // namespace millwright::cordic
