// One pass of CORDIC-R or CORDIC-V with numbers of one's own, in any of the three coordinate systems,
// computed with the format and the steps of the Processor workspace: the result beside the exact one.
#pragma once

#include "core/cordic_study/single_pass.h"
#include "ui/panels/panel.h"
#include "ui/workspaces/processor_workspace.h"

namespace millwright::panels {

class ProcessorPass {
public:
    /// A section of the inspector.
    void draw(Ui& ui, const actions::ProcessorChoice& choice);

private:
    void draw_input(Ui& ui);
    void draw_result(Ui& ui, const actions::ProcessorChoice& choice) const;

    cordic::CoordinateSystem m_ = cordic::CoordinateSystem::circular;
    cordic::Mode mode_ = cordic::Mode::rotation;
    bool folds_ = false;
    double x_ = 1.0;
    double y_ = 0.0;
    double z_ = 0.5;
};

} // namespace millwright::panels
