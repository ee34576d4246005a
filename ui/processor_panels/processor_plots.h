// What the processor computes, drawn: the vector of the CORDIC pass that is under way, its angle error a
// step, the tool path in step with it, and how far that is from the exact path.
#pragma once

#include "ui/panels/panel.h"
#include "ui/processor_panels/processor_path.h"

namespace millwright::panels {

class ProcessorPlots final : public Panel {
public:
    /// Side by side, as high as the pane.
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    void draw_vector(Ui& ui, const FrameState& now, const widgets::Rect& place) const;
    void draw_errors(Ui& ui, const FrameState& now, const widgets::Rect& place) const;

    ProcessorPath path_;
};

} // namespace millwright::panels
