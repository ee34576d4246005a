// An XYZ table that points are played to, one per period: port, speed, live read-out of three axes, jitter.
#pragma once

#include "ui/panels/panel.h"

#include <optional>
#include <string>

namespace millwright::panels {

/// "table at /dev/ttyUSB0: moving" while one is played to; else empty.
[[nodiscard]] std::string table_text(const FrameState& now);

class TablePane final : public Panel {
public:
    /// `catalogue` must outlive it.
    explicit TablePane(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}

    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    void draw_choice(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    [[nodiscard]] static std::optional<Vec3> place_of_begin(const FrameState& now);

    const actions::Catalogue& catalogue_;
};

} // namespace millwright::panels
