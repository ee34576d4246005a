// What the CORDIC processor executes: instructions, microprogram and G-code, where a click sets a breakpoint
// or runs to the line.
#pragma once

#include "ui/panels/panel.h"

namespace millwright::panels {

class ProcessorCode final : public Panel {
public:
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    enum class Tab { instructions, microprogram, program };
    enum class Click { breakpoint, run_to };

    void draw_instructions(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_microprogram(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_program(Ui& ui, const FrameState& now, ActionQueue& ask) const;

    Tab tab_ = Tab::instructions;
    Click click_ = Click::breakpoint;
};

} // namespace millwright::panels
