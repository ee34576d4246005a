#include "core/cordic/sequencer.h"

#include <algorithm>

namespace millwright::cordic {
namespace {

constexpr std::array<std::string_view, micro_op_count> micro_op_names = {"JZ",
                                                                         "CJS",
                                                                         "JMAP",
                                                                         "CJP",
                                                                         "PUSH",
                                                                         "JSRP",
                                                                         "CJV",
                                                                         "JRP",
                                                                         "RFCT",
                                                                         "RPCT",
                                                                         "CRTN",
                                                                         "CJPP",
                                                                         "LDCT",
                                                                         "LOOP",
                                                                         "CONT",
                                                                         "TWB"};

constexpr int behind_last = 256;

/// What an operation does besides choosing the address.
enum class Stack : std::uint8_t { keep, push, pop, peek, clear };
enum class Counter : std::uint8_t { keep, load, count };

struct Plan {
    int next = 0; ///< behind_last: there is none
    Stack stack = Stack::keep;
    Counter counter = Counter::keep;
};

/// The rows that ask the counter.
Plan counted_plan_of(
    const SequencerState& state, MicroOp op, const SequencerInputs& in, int next, std::uint8_t top) {
    if (state.counter != 0) {
        const bool passes = op == MicroOp::TWB && in.pass;
        return op == MicroOp::RPCT ? Plan{in.branch, Stack::keep, Counter::count}
               : passes            ? Plan{next, Stack::pop, Counter::count}
                                   : Plan{top, Stack::peek, Counter::count};
    }
    if (op == MicroOp::RPCT) {
        return {next};
    }
    return {op == MicroOp::TWB && !in.pass ? in.branch : next, Stack::pop};
}

/// The rows of the truth table. `top` is what the stack shows; `next` is the address behind this one.
Plan plan_of(const SequencerState& state, MicroOp op, const SequencerInputs& in, int next, std::uint8_t top) {
    switch (op) {
    case MicroOp::JZ:
        return {0, Stack::clear};
    case MicroOp::CJS:
        return in.pass ? Plan{in.branch, Stack::push} : Plan{next};
    case MicroOp::JMAP:
        return {in.map};
    case MicroOp::CJP:
        return {in.pass ? in.branch : next};
    case MicroOp::PUSH:
        return {next, Stack::push, in.pass ? Counter::load : Counter::keep};
    case MicroOp::JSRP:
        return {in.pass ? in.branch : state.counter, Stack::push};
    case MicroOp::CJV:
        return {in.pass ? in.vector : next};
    case MicroOp::JRP:
        return {in.pass ? in.branch : state.counter};
    case MicroOp::RFCT:
    case MicroOp::RPCT:
    case MicroOp::TWB:
        return counted_plan_of(state, op, in, next, top);
    case MicroOp::CRTN:
        return in.pass ? Plan{top, Stack::pop} : Plan{next};
    case MicroOp::CJPP:
        return in.pass ? Plan{in.branch, Stack::pop} : Plan{next};
    case MicroOp::LDCT:
        return {next, Stack::keep, Counter::load};
    case MicroOp::LOOP:
        return in.pass ? Plan{next, Stack::pop} : Plan{top, Stack::peek};
    case MicroOp::CONT:
        return {next};
    }
    return {next};
}

} // namespace

std::string_view to_text(MicroOp op) {
    return micro_op_names[static_cast<std::size_t>(op)];
}

std::optional<MicroOp> micro_op_of(std::string_view name) {
    const auto* const found = std::ranges::find(micro_op_names, name);
    return found == micro_op_names.end()
               ? std::nullopt
               : std::optional(static_cast<MicroOp>(found - micro_op_names.begin()));
}

void step(SequencerState& state, MicroOp op, const SequencerInputs& inputs) {
    const int next = state.address + 1;
    const std::uint8_t top = state.depth > 0 ? state.stack[state.depth - 1U] : std::uint8_t{0};
    const Plan plan = plan_of(state, op, inputs, next, top);
    const bool needs_next = plan.next == behind_last || (plan.stack == Stack::push && next == behind_last);
    state.fault = needs_next ? SequencerFault::no_next : SequencerFault::none;
    if (needs_next) {
        return;
    }
    if (plan.stack != Stack::keep) {
        const bool takes = plan.stack == Stack::pop || plan.stack == Stack::peek;
        if (takes && state.depth == 0) {
            state.fault = SequencerFault::underflow;
            return;
        }
        if (plan.stack == Stack::push) {
            if (state.depth == stack_depth) {
                state.fault = SequencerFault::overflow;
                return;
            }
            state.stack[state.depth++] = static_cast<std::uint8_t>(next);
        } else if (plan.stack == Stack::pop) {
            --state.depth;
        } else if (plan.stack == Stack::clear) {
            state.depth = 0;
        }
    }
    if (plan.counter == Counter::load) {
        state.counter = inputs.branch;
    } else if (plan.counter == Counter::count) {
        --state.counter;
    }
    state.address = static_cast<std::uint8_t>(plan.next);
}

} // namespace millwright::cordic
