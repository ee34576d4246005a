#include "core/cordic/debugger.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::cordic {
namespace {

constexpr ControlSignals begins_pass = bit_of(Control::fold_radius) | bit_of(Control::fold_move) |
                                       bit_of(Control::fold_space) | bit_of(Control::fold_rise) |
                                       bit_of(Control::load_speed) | bit_of(Control::unfold_rise);

template <class Arithmetic>
IterationPoint
point_of(const Arithmetic& arithmetic, const Vector3<typename Arithmetic::Number>& v, Mode mode) {
    IterationPoint point;
    point.x = arithmetic.to_double(v.x);
    point.y = arithmetic.to_double(v.y);
    point.z = arithmetic.to_double(v.z);
    point.angle_error = mode == Mode::rotation ? std::abs(point.z) : std::abs(std::atan2(point.y, point.x));
    return point;
}

/// The pass once more from its start, as far as the processor is in it.
template <class Arithmetic>
std::vector<IterationPoint> replayed(const Arithmetic& arithmetic,
                                     const ProcessorSettings& settings,
                                     const DataPath& start,
                                     const DataPath& now,
                                     Mode mode) {
    const Kernel<Arithmetic> kernel(arithmetic, settings.sequence, settings.zero);
    Vector3<typename Arithmetic::Number> v{
        arithmetic.from_word(start.x), arithmetic.from_word(start.y), arithmetic.from_word(start.z)};
    std::vector<IterationPoint> points{point_of(arithmetic, v, mode)};
    bool overflow = false;
    for (int i = 0; i < std::min<int>(now.step, settings.sequence.step_count); ++i) {
        kernel.step(v, i, kernel.direction(mode, v), overflow);
        points.push_back(point_of(arithmetic, v, mode));
    }
    for (int j = 0; j < now.correction; ++j) {
        const auto correct = [&](auto value) {
            return settings.sequence.multiplies ? kernel.multiplied(value, overflow)
                                                : kernel.corrected(value, j, overflow);
        };
        v.x = correct(v.x);
        v.y = correct(v.y);
        points.push_back(point_of(arithmetic, v, mode));
        points.back().corrects = true;
    }
    return points;
}

} // namespace

Debugger::Debugger(Processor processor, std::vector<CodeLine> lines)
    : processor_(std::move(processor)), lines_(std::move(lines)), before_(processor_.state()) {}

CodeAddress Debugger::instruction() const {
    return fetches() ? code_address(state().bus.page, register_of(state(), Register::PC))
                     : state().instruction_at;
}

int Debugger::line() const {
    return line_at(lines_, instruction()).line;
}

IterationTrace Debugger::iterations() const {
    IterationTrace trace;
    trace.mode = mode_;
    if (in_pass_) {
        trace.points = with_arithmetic(processor_.format(), [&](const auto& arithmetic) {
            return replayed(arithmetic, processor_.settings(), start_, state().path, mode_);
        });
    }
    return trace;
}

void Debugger::toggle_breakpoint(CodeAddress address) {
    if (breakpoints_.erase(address) == 0) {
        breakpoints_.insert(address);
    }
}

void Debugger::toggle_micro_breakpoint(std::uint8_t address) {
    if (micro_breakpoints_.erase(address) == 0) {
        micro_breakpoints_.insert(address);
    }
}

/// A loop of one micro-instruction is come to once.
bool Debugger::came_to_breakpoint(std::uint8_t from) const {
    const std::uint8_t address = state().sequencer.address;
    return address != from &&
           (micro_breakpoints_.contains(address) || (fetches() && breakpoints_.contains(instruction())));
}

void Debugger::clock() {
    processor_.clock();
    if ((state().pipeline.controls & begins_pass) != 0) {
        in_pass_ = true;
        start_ = state().path;
        const MicroWord& next = processor_.microprogram().words[state().sequencer.address];
        mode_ = (next.controls & bit_of(Control::vector)) != 0 ? Mode::vectoring : Mode::rotation;
    }
}

template <class Done> Halt Debugger::go(std::int64_t limit, const Done& done) {
    before_ = state();
    for (std::int64_t n = 0; n < limit; ++n) {
        const std::uint8_t from = state().sequencer.address;
        clock();
        if (state().stop != Stop::none) {
            return Halt::stopped;
        }
        if (done()) {
            return Halt::done;
        }
        if (came_to_breakpoint(from)) {
            return Halt::breakpoint;
        }
    }
    return Halt::limit;
}

Halt Debugger::step_clock() {
    return go(1, [] { return true; });
}

Halt Debugger::step_micro_instruction(std::int64_t limit) {
    return go(limit, [&, from = state().sequencer.address] { return state().sequencer.address != from; });
}

Halt Debugger::step_instruction(std::int64_t limit) {
    return go(limit, [&, from = state().instructions] { return state().instructions != from && fetches(); });
}

Halt Debugger::step_block(std::int64_t limit) {
    return go(limit, [&, from = line()] { return fetches() && line() != from; });
}

Halt Debugger::run_to_set_point(std::int64_t limit) {
    return go(limit,
              [&, from = processor_.published().size()] { return processor_.published().size() != from; });
}

Halt Debugger::run_to(CodeAddress address, std::int64_t limit) {
    return go(limit, [&] { return fetches() && instruction() == address; });
}

Halt Debugger::run_to_line(int wanted, std::int64_t limit) {
    bool left = line() != wanted;
    return go(limit, [&] {
        left = left || line() != wanted;
        return left && fetches() && line() == wanted;
    });
}

Halt Debugger::run_to_micro(std::uint8_t address, std::int64_t limit) {
    return go(limit, [&] { return state().sequencer.address == address; });
}

Halt Debugger::run(std::int64_t limit) {
    return go(limit, [] { return false; });
}

void Debugger::reset() {
    processor_.reset();
    before_ = state();
    in_pass_ = false;
}

} // namespace millwright::cordic
