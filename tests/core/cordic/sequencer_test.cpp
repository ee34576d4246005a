#include "core/cordic/sequencer.h"

#include <gtest/gtest.h>

#include <array>
#include <cstdint>
#include <string>

namespace millwright::cordic {
namespace {

// Where the next address can come from, and what becomes of stack and counter.
enum class From : std::uint8_t { zero, next, branch, map, vector, counter, top };
enum class Stack : std::uint8_t { keep, push, pop, clear };
enum class Counter : std::uint8_t { hold, load, down };

struct Row {
    MicroOp op;
    bool counter_is_zero;
    From fail;
    Stack fail_stack;
    Counter fail_counter;
    From pass;
    Stack pass_stack;
    Counter pass_counter;
};

using enum From;
constexpr auto keep = Stack::keep, push = Stack::push, pop = Stack::pop, clear = Stack::clear;
constexpr auto hold = Counter::hold, load = Counter::load, down = Counter::down;

// The public data sheet of the Am2910, each operation with the counter at 0 and not at 0.
constexpr std::array table = {
    Row{MicroOp::JZ, false, zero, clear, hold, zero, clear, hold},
    Row{MicroOp::JZ, true, zero, clear, hold, zero, clear, hold},
    Row{MicroOp::CJS, false, next, keep, hold, branch, push, hold},
    Row{MicroOp::CJS, true, next, keep, hold, branch, push, hold},
    Row{MicroOp::JMAP, false, map, keep, hold, map, keep, hold},
    Row{MicroOp::JMAP, true, map, keep, hold, map, keep, hold},
    Row{MicroOp::CJP, false, next, keep, hold, branch, keep, hold},
    Row{MicroOp::CJP, true, next, keep, hold, branch, keep, hold},
    Row{MicroOp::PUSH, false, next, push, hold, next, push, load},
    Row{MicroOp::PUSH, true, next, push, hold, next, push, load},
    Row{MicroOp::JSRP, false, counter, push, hold, branch, push, hold},
    Row{MicroOp::JSRP, true, counter, push, hold, branch, push, hold},
    Row{MicroOp::CJV, false, next, keep, hold, vector, keep, hold},
    Row{MicroOp::CJV, true, next, keep, hold, vector, keep, hold},
    Row{MicroOp::JRP, false, counter, keep, hold, branch, keep, hold},
    Row{MicroOp::JRP, true, counter, keep, hold, branch, keep, hold},
    Row{MicroOp::RFCT, false, top, keep, down, top, keep, down},
    Row{MicroOp::RFCT, true, next, pop, hold, next, pop, hold},
    Row{MicroOp::RPCT, false, branch, keep, down, branch, keep, down},
    Row{MicroOp::RPCT, true, next, keep, hold, next, keep, hold},
    Row{MicroOp::CRTN, false, next, keep, hold, top, pop, hold},
    Row{MicroOp::CRTN, true, next, keep, hold, top, pop, hold},
    Row{MicroOp::CJPP, false, next, keep, hold, branch, pop, hold},
    Row{MicroOp::CJPP, true, next, keep, hold, branch, pop, hold},
    Row{MicroOp::LDCT, false, next, keep, load, next, keep, load},
    Row{MicroOp::LDCT, true, next, keep, load, next, keep, load},
    Row{MicroOp::LOOP, false, top, keep, hold, next, pop, hold},
    Row{MicroOp::LOOP, true, top, keep, hold, next, pop, hold},
    Row{MicroOp::CONT, false, next, keep, hold, next, keep, hold},
    Row{MicroOp::CONT, true, next, keep, hold, next, keep, hold},
    Row{MicroOp::TWB, false, top, keep, down, next, pop, down},
    Row{MicroOp::TWB, true, branch, pop, hold, next, pop, hold},
};

constexpr SequencerInputs sequencer_inputs{.pass = false, .branch = 0x80, .map = 0x90, .vector = 0xa0};

SequencerState busy_state(bool counter_is_zero) {
    return {.address = 0x10,
            .counter = static_cast<std::uint8_t>(counter_is_zero ? 0 : 7),
            .stack = {0x21, 0x32},
            .depth = 2};
}

std::uint8_t address_of(From from, const SequencerState& before) {
    switch (from) {
    case zero:
        return 0;
    case next:
        return 0x11;
    case branch:
        return 0x80;
    case map:
        return 0x90;
    case vector:
        return 0xa0;
    case counter:
        return before.counter;
    case top:
        return 0x32;
    }
    return 0xff;
}

void expect_row(const Row& row, bool pass) {
    SequencerState state = busy_state(row.counter_is_zero);
    const SequencerState before = state;
    SequencerInputs in = sequencer_inputs;
    in.pass = pass;
    step(state, row.op, in);
    const auto where = std::string(to_text(row.op)) + (pass ? " pass" : " fail") +
                       (row.counter_is_zero ? ", counter 0" : "");
    EXPECT_EQ(state.fault, SequencerFault::none) << where;
    EXPECT_EQ(state.address, address_of(pass ? row.pass : row.fail, before)) << where;
    switch (pass ? row.pass_stack : row.fail_stack) {
    case Stack::keep:
        EXPECT_EQ(state.depth, 2) << where;
        break;
    case Stack::push:
        ASSERT_EQ(state.depth, 3) << where;
        EXPECT_EQ(state.stack[2], 0x11) << where;
        break;
    case Stack::pop:
        EXPECT_EQ(state.depth, 1) << where;
        break;
    case Stack::clear:
        EXPECT_EQ(state.depth, 0) << where;
        break;
    }
    const Counter change = pass ? row.pass_counter : row.fail_counter;
    const int expected = change == Counter::load ? 0x80 : before.counter - (change == Counter::down ? 1 : 0);
    EXPECT_EQ(state.counter, expected) << where;
}

TEST(Sequencer, FollowsItsTruthTable) {
    ASSERT_EQ(table.size(), 2U * micro_op_count);
    for (const Row& row : table) {
        expect_row(row, false);
        expect_row(row, true);
    }
}

TEST(Sequencer, BeginsAtZero) {
    EXPECT_EQ(SequencerState().address, 0);
}

TEST(Sequencer, LoopsWithACountOfThreeRunFourTimes) {
    SequencerState state;
    step(state, MicroOp::LDCT, {.branch = 3});
    int turns = 0;
    while (state.address == 1) {
        step(state, MicroOp::RPCT, {.branch = 1});
        ++turns;
    }
    EXPECT_EQ(turns, 4);
}

TEST(Sequencer, ReportsACallBeyondFourAndStaysAsItWas) {
    SequencerState state;
    for (int n = 0; n < stack_depth; ++n) {
        step(state, MicroOp::CJS, {.pass = true, .branch = 9});
        EXPECT_EQ(state.fault, SequencerFault::none);
    }
    for (const MicroOp op : {MicroOp::CJS, MicroOp::PUSH, MicroOp::JSRP}) {
        SequencerState full = state;
        step(full, op, {.pass = true, .branch = 9});
        EXPECT_EQ(full.fault, SequencerFault::overflow) << to_text(op);
        full.fault = SequencerFault::none;
        EXPECT_EQ(full, state) << to_text(op);
    }
}

TEST(Sequencer, ReportsAReturnFromNothing) {
    for (const MicroOp op : {MicroOp::CRTN, MicroOp::CJPP, MicroOp::RFCT, MicroOp::LOOP, MicroOp::TWB}) {
        SequencerState state;
        step(state, op, {.pass = true, .branch = 9});
        EXPECT_EQ(state.fault, SequencerFault::underflow) << to_text(op);
        EXPECT_EQ(state.address, 0) << to_text(op);
    }
}

TEST(Sequencer, DoesNotGoOnFromTheLastAddressToTheFirst) {
    const SequencerState last{.address = 255};
    for (const MicroOp op : {MicroOp::CONT, MicroOp::LDCT, MicroOp::PUSH, MicroOp::CJS, MicroOp::JSRP}) {
        SequencerState state = last;
        step(state, op, {.pass = true, .branch = 9});
        EXPECT_EQ(state.fault, SequencerFault::no_next) << to_text(op); // a call would come back there
        state.fault = SequencerFault::none;
        EXPECT_EQ(state, last) << to_text(op);
    }
    SequencerState failed = last;
    step(failed, MicroOp::CJP, {.pass = false, .branch = 9});
    EXPECT_EQ(failed.fault, SequencerFault::no_next);
    SequencerState away = last;
    step(away, MicroOp::CJP, {.pass = true, .branch = 9});
    EXPECT_EQ(away.fault, SequencerFault::none);
    EXPECT_EQ(away.address, 9);
    SequencerState again = last;
    step(again, MicroOp::JZ, {});
    EXPECT_EQ(again.address, 0);
}

TEST(MicroOps, HaveNamesThatReadBack) {
    for (int n = 0; n < micro_op_count; ++n) {
        const auto op = static_cast<MicroOp>(n);
        EXPECT_EQ(micro_op_of(to_text(op)), op);
    }
    EXPECT_FALSE(micro_op_of("CRTX"));
}

} // namespace
} // namespace millwright::cordic
