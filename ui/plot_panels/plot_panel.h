// The Plot & Picture workspace: levels of the pens, how strokes and pictures are cut, materials, and a table
// that points are played to.
#pragma once

#include "ui/panels/panel.h"
#include "ui/plot_panels/picture_pane.h"
#include "ui/plot_panels/table_pane.h"

#include <cstddef>
#include <filesystem>
#include <vector>

namespace millwright::panels {

class PlotPanel final : public Panel {
public:
    /// `catalogue` must outlive it.
    explicit PlotPanel(const actions::Catalogue& catalogue) : catalogue_(catalogue), table_(catalogue) {}

    /// The inspector.
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;
    /// The pane at the left.
    void draw_layers(Ui& ui, const FrameState& now, ActionQueue& ask);
    /// The lower pane.
    void draw_bench(Ui& ui, const FrameState& now, ActionQueue& ask);
    /// Which of its tabs is shown.
    [[nodiscard]] int bench_tab() const { return static_cast<int>(tab_); }

private:
    enum class Tab { materials, table, notices, picture };

    void draw_source(Ui& ui, const FrameState& now, ActionQueue& ask);
    void draw_figures(Ui& ui, const FrameState& now) const;
    void draw_progress(Ui& ui, const FrameState& now) const;
    void draw_table_place(Ui& ui, const FrameState& now, const Vec3& tip) const;
    void draw_materials(Ui& ui, const FrameState& now, ActionQueue& ask) const;
    void draw_notices(Ui& ui, const FrameState& now) const;

    const actions::Catalogue& catalogue_;
    TablePane table_;
    PicturePane picture_;
    std::size_t level_ = 0; ///< chosen
    Tab tab_ = Tab::materials;
    std::vector<std::filesystem::path> samples_;
    bool looked_for_samples_ = false;
};

} // namespace millwright::panels
