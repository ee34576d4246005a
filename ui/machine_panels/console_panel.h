// What went over the link, and lines that a person sends: MDI and console in one.
#pragma once

#include "core/drivers/console.h"
#include "ui/panels/panel.h"

#include <memory>
#include <string>
#include <vector>

namespace millwright::panels {

class ConsolePanel final : public Panel {
public:
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    void follow(const FrameState& now);
    void draw_command(Ui& ui, const FrameState& now, ActionQueue& ask);

    std::weak_ptr<drivers::Console> source_; ///< that `lines_` came from
    std::vector<drivers::ConsoleLine> lines_;
    std::int64_t next_ = 0;
    double start_ = 0.0; ///< time of the first line, s
    bool start_known_ = false;
    std::string wanted_; ///< shown are the lines with this in them
    std::vector<std::size_t> shown_;
};

} // namespace millwright::panels
