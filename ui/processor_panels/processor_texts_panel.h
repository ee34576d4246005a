// The editors of the Processor workspace: assembler text and a microprogram of one's own.
#pragma once

#include "ui/panels/panel.h"
#include "ui/panels/text_editor.h"

namespace millwright::panels {

class ProcessorTextsPanel {
public:
    /// `catalogue` must outlive it.
    explicit ProcessorTextsPanel(const actions::Catalogue& catalogue);

    void draw_assembler(Ui& ui, const FrameState& now, ActionQueue& ask);
    void draw_microprogram(Ui& ui, const FrameState& now, ActionQueue& ask);

private:
    const actions::Catalogue& catalogue_;
    TextEditor assembler_;
    TextEditor microprogram_;
};

} // namespace millwright::panels
