// The window of help (F1): the manual of the workspace, the keys, the commands of the card, and which program
// this is. Nothing is asked; Esc closes it.
#pragma once

#include "ui/panels/panel.h"
#include "ui/widgets/reading.h"

#include <vector>

namespace millwright::panels {

class HelpPanel final : public Panel {
public:
    explicit HelpPanel(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    void refresh(const FrameState& now);

    const actions::Catalogue& catalogue_;
    actions::HelpPage shown_ = actions::HelpPage::none;
    actions::Workspace workspace_ = actions::Workspace::design; ///< that it is about
    std::vector<widgets::ReadingBlock> blocks_;
};

} // namespace millwright::panels
