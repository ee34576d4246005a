// Which machine is connected, how that stands in words, and what to do about an alarm or a lost link.
#pragma once

#include "ui/panels/panel.h"

#include <string>
#include <vector>

namespace millwright::panels {

class ConnectionPanel final : public Panel {
public:
    explicit ConnectionPanel(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;
    /// Warnings, doubts and advice, in a section of their own: they come and go, and must not move a button
    /// that moves or stops a machine. The alarm stands above the drawing, see alarm_text().
    void draw_messages(Ui& ui, const FrameState& now, ActionQueue& ask) const;

private:
    [[nodiscard]] static bool warns(const actions::ConnectionView& machine);
    [[nodiscard]] static bool has_messages(const actions::ConnectionView& machine);
    void draw_choice(Ui& ui, const FrameState& now, ActionQueue& ask);
    void draw_address(Ui& ui, const FrameState& now, ActionQueue& ask);
    void draw_ports(Ui& ui, const FrameState& now, ActionQueue& ask);
    void draw_state(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void look_for_ports();

    const actions::Catalogue& catalogue_;
    struct Port {
        std::string path, label;
    };
    std::vector<Port> ports_;
    bool looked_ = false;
};

/// What the alarm is and what to do about it, in sentences; empty where there is none.
[[nodiscard]] std::string alarm_text(const FrameState& now);

/// "Grbl at /dev/ttyUSB0: idle", "virtual machine: running (program)"; "no machine connected".
[[nodiscard]] std::string controller_text(const FrameState& now);

} // namespace millwright::panels
