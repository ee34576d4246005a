// The Processor workspace: stepping, registers, number format; its code and drawings are panels of their own.
#pragma once

#include "ui/panels/panel.h"
#include "ui/processor_panels/processor_code.h"
#include "ui/processor_panels/processor_pass.h"
#include "ui/processor_panels/processor_plots.h"
#include "ui/processor_panels/processor_texts_panel.h"

namespace millwright::panels {

class ProcessorPanel final : public Panel {
public:
    /// `catalogue` must outlive it.
    explicit ProcessorPanel(const actions::Catalogue& catalogue) : catalogue_(catalogue), texts_(catalogue) {}

    /// The inspector.
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;
    /// The pane at the left.
    void draw_code(Ui& ui, const FrameState& now, ActionQueue& ask) { code_.draw(ui, now, ask); }
    /// Below the diagram.
    void draw_steps(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    /// The lower pane: drawings, and the editors.
    void draw_lower(Ui& ui, const FrameState& now, ActionQueue& ask);

private:
    void draw_choice(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_source(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_errors(Ui& ui, const FrameState& now) const;
    void draw_registers(Ui& ui, const FrameState& now) const;
    void draw_times(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_clocks(Ui& ui, const FrameState& now) const;

    const actions::Catalogue& catalogue_;
    ProcessorCode code_;
    ProcessorPass pass_;
    ProcessorPlots plots_;
    ProcessorTextsPanel texts_;
};

} // namespace millwright::panels
