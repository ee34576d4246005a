// The blocks that the processor is drawn as: what is in each, and whether the last clock used it.
#pragma once

#include "core/cordic/processor.h"

#include <cstdint>
#include <initializer_list>
#include <string>
#include <vector>

namespace millwright::panels {

enum class ProcessorBlock : std::uint8_t {
    bus,
    rom,
    ram,
    port,
    ir,
    map,
    sequencer,
    counter,
    stack,
    pipeline,
    registers,
    fold,
    first,
    second
};

/// All of them together.
[[nodiscard]] constexpr cordic::ControlSignals signals(std::initializer_list<cordic::Control> controls) {
    cordic::ControlSignals all = 0;
    for (const cordic::Control control : controls) {
        all |= cordic::bit_of(control);
    }
    return all;
}

/// Those that fold a vector on its way into the rotator.
inline constexpr cordic::ControlSignals fold_signals =
    signals({cordic::Control::fold_radius, cordic::Control::fold_move, cordic::Control::fold_space});
/// Those that unfold what the rotator has computed.
inline constexpr cordic::ControlSignals unfold_signals =
    signals({cordic::Control::unfold_radius, cordic::Control::unfold_speed, cordic::Control::unfold_rise});

/// Whether the last clock used it.
[[nodiscard]] bool lights(ProcessorBlock block, const cordic::ProcessorState& state);

/// What is in it, the most important first.
[[nodiscard]] std::vector<std::string> lines_of(ProcessorBlock block, const cordic::Processor& processor);

/// A word of the processor's format as people read it.
[[nodiscard]] std::string word_text(const cordic::Processor& processor, cordic::Word word);

} // namespace millwright::panels
