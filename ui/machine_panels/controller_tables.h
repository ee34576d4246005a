// What the controller has stored: offsets, and settings that can be changed.
#pragma once

#include "ui/panels/panel.h"

#include <string>

namespace millwright::panels {

class OffsetTable final : public Panel {
public:
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;
};

class SettingTable final : public Panel {
public:
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    std::string chosen_; ///< name of the setting that can be changed
};

} // namespace millwright::panels
