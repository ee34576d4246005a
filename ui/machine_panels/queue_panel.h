// Jobs that wait one behind the other: added, put in order, and begun one by one by a person.
#pragma once

#include "core/jobs/job_queue.h"
#include "ui/panels/panel.h"

#include <optional>

namespace millwright::panels {

class QueuePanel final : public Panel {
public:
    explicit QueuePanel(const actions::Catalogue& catalogue) : catalogue_(catalogue) {}
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    void draw_buttons(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_table(Ui& ui, const FrameState& now);
    [[nodiscard]] const jobs::QueuedJob* chosen(const FrameState& now) const;

    const actions::Catalogue& catalogue_;
    std::optional<jobs::QueuedJobId> chosen_;
};

} // namespace millwright::panels
