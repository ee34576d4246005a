// The processor under a person's hand: stepped by clock, micro-instruction, instruction or block, run to
// breakpoints, with what the last step changed and the CORDIC pass that is under way.
#pragma once

#include "core/cordic/processor.h"

#include <cstdint>
#include <set>
#include <span>
#include <vector>

namespace millwright::cordic {

/// Why a step or a run came to its end.
enum class Halt : std::uint8_t {
    done,       ///< it came to where it was to go
    breakpoint, ///< before a micro-instruction or instruction that has one
    stopped,    ///< the processor stands: ProcessorState::stop says why
    limit       ///< of clocks
};

/// What stands in the arithmetic unit behind a step of a pass. The first point is the pass's start.
struct IterationPoint {
    bool corrects = false; ///< a step of the gain correction, not of the iteration
    double x = 0.0, y = 0.0, z = 0.0;
    double angle_error =
        0.0; ///< what is left to turn, rad: |z| of a rotation, |angle of (x, y)| of vectoring
};

struct IterationTrace {
    Mode mode = Mode::rotation;
    std::vector<IterationPoint> points; ///< empty before the first pass
};

class Debugger {
public:
    /// `lines` by ascending address.
    Debugger(Processor processor, std::vector<CodeLine> lines);

    [[nodiscard]] const Processor& processor() const { return processor_; }
    [[nodiscard]] const ProcessorState& state() const { return processor_.state(); }
    /// As it was before the last step or run.
    [[nodiscard]] const ProcessorState& before() const { return before_; }
    /// The pass that is under way, or the last one.
    [[nodiscard]] IterationTrace iterations() const;

    /// Of the instruction that is executed, or fetched next; 0: none.
    [[nodiscard]] int line() const;
    [[nodiscard]] CodeAddress instruction() const;

    [[nodiscard]] const std::set<CodeAddress>& breakpoints() const { return breakpoints_; }
    [[nodiscard]] const std::set<std::uint8_t>& micro_breakpoints() const { return micro_breakpoints_; }
    void toggle_breakpoint(CodeAddress address);
    void toggle_micro_breakpoint(std::uint8_t address);

    /// Steps execute at least one clock, whatever breakpoint they stand at, and `limit` at most.
    Halt step_clock();
    /// To another micro-instruction: a loop of one is one step.
    Halt step_micro_instruction(std::int64_t limit);
    Halt step_instruction(std::int64_t limit);
    /// To an instruction of another line.
    Halt step_block(std::int64_t limit);
    /// To the next set-point that is published.
    Halt run_to_set_point(std::int64_t limit);
    /// Until the instruction at `address` is about to be fetched.
    Halt run_to(CodeAddress address, std::int64_t limit);
    /// Until an instruction of the program's `line` is about to be fetched, or fetched again.
    Halt run_to_line(int line, std::int64_t limit);
    /// Until the micro-instruction at `address` is executed next.
    Halt run_to_micro(std::uint8_t address, std::int64_t limit);
    Halt run(std::int64_t limit);
    /// Breakpoints stay.
    void reset();

private:
    /// Clocks until `done()` says so behind one of them.
    template <class Done> Halt go(std::int64_t limit, const Done& done);
    [[nodiscard]] bool came_to_breakpoint(std::uint8_t from) const;
    [[nodiscard]] bool fetches() const { return state().sequencer.address == 0; }
    void clock();

    Processor processor_;
    std::vector<CodeLine> lines_;
    ProcessorState before_;
    std::set<CodeAddress> breakpoints_;
    std::set<std::uint8_t> micro_breakpoints_;
    bool in_pass_ = false; ///< there was one
    Mode mode_ = Mode::rotation;
    DataPath start_; ///< of the pass
};

} // namespace millwright::cordic
