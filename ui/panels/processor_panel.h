// The Processor workspace: stepping, registers, number format; its code and drawings are panels of their own.
#pragma once

#include "ui/panels/panel.h"
#include "ui/panels/processor_code.h"
#include "ui/panels/processor_pass.h"
#include "ui/panels/processor_plots.h"

namespace millwright::panels {

class ProcessorPanel final : public Panel {
public:
    /// `catalogue` must outlive it.
    explicit ProcessorPanel(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}

    /// The inspector.
    void draw(Ui& ui, const Workbench& now, ActionQueue& ask) override;
    /// The pane at the left.
    void draw_code(Ui& ui, const Workbench& now, ActionQueue& ask) { code_.draw(ui, now, ask); }
    /// Below the diagram.
    void draw_steps(Ui& ui, const Workbench& now, ActionQueue& ask) const;
    /// The lower pane.
    void draw_plots(Ui& ui, const Workbench& now, ActionQueue& ask) { plots_.draw(ui, now, ask); }

private:
    void draw_choice(Ui& ui, const Workbench& now, ActionQueue& ask) const;
    void draw_source(Ui& ui, const Workbench& now, ActionQueue& ask) const;
    void draw_errors(Ui& ui, const Workbench& now) const;
    void draw_registers(Ui& ui, const Workbench& now) const;
    void draw_times(Ui& ui, const Workbench& now, ActionQueue& ask) const;
    void draw_clocks(Ui& ui, const Workbench& now) const;

    const actions::Catalogue& catalogue_;
    ProcessorCode code_;
    ProcessorPass pass_;
    ProcessorPlots plots_;
};

} // namespace millwright::panels
