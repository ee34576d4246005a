#include "ui/processor_panels/processor_texts_panel.h"

#include "ui/panels/fields.h"
#include "ui/workspaces/processor_workspace.h"

namespace millwright::panels {

using project::ProcessorInput;
using project::Project;
using widgets::Rank;

ProcessorTextsPanel::ProcessorTextsPanel(const actions::Catalogue& catalogue)
    : catalogue_(catalogue), assembler_(edited_text<&Project::processor, &ProcessorInput::assembler>(
                                 "Edit the assembly source", "assembly source")),
      microprogram_(edited_text<&Project::processor, &ProcessorInput::microprogram>("Edit the microprogram",
                                                                                    "microprogram")) {}

void ProcessorTextsPanel::draw_assembler(Ui& ui, const FrameState& now, ActionQueue& ask) {
    {
        const auto row = ui.row(6);
        const bool executed = now.processor.choice().source == actions::ProcessorSource::assembler;
        action_button(ui,
                      now,
                      ask,
                      catalogue_,
                      "processor.assembler",
                      executed ? Rank::primary : Rank::normal,
                      executed ? "Active" : "Use");
        action_button(ui, now, ask, catalogue_, "processor.take_over", Rank::normal, "Copy program");
        action_button(ui, now, ask, catalogue_, "processor.open_assembler", Rank::normal, "Open");
        action_button(ui, now, ask, catalogue_, "processor.save_assembler", Rank::normal, "Save");
        action_button(ui, now, ask, catalogue_, "processor.save_image", Rank::normal, "Image");
        assembler_.draw_find_button(ui);
    }
    const auto& remarks = now.processor.written().remarks();
    fault_line(ui, remarks, "MOV XI, 10 ; one instruction per line; .format q12.20 sets the number format");
    assembler_.draw(ui, now, ask, remarks);
}

void ProcessorTextsPanel::draw_microprogram(Ui& ui, const FrameState& now, ActionQueue& ask) {
    {
        const auto row = ui.row(5);
        const bool executed = now.processor.choice().own_microprogram;
        action_button(ui,
                      now,
                      ask,
                      catalogue_,
                      "processor.own_microprogram",
                      executed ? Rank::primary : Rank::normal,
                      executed ? "Active" : "Use");
        action_button(
            ui, now, ask, catalogue_, "processor.start_microprogram", Rank::normal, "Copy built-in");
        action_button(ui, now, ask, catalogue_, "processor.open_microprogram", Rank::normal, "Open");
        action_button(ui, now, ask, catalogue_, "processor.save_microprogram", Rank::normal, "Save");
        microprogram_.draw_find_button(ui);
    }
    const auto& faults = now.processor.written().micro_faults();
    fault_line(
        ui,
        faults,
        now.processor.choice().own_microprogram
            ? "Active instead of the built-in microprogram; click Active again to return to the built-in one"
            : "F1: CJP bus_busy F1 ; label, operation, condition, branch | signals");
    microprogram_.draw(ui, now, ask, faults);
}

} // namespace millwright::panels
