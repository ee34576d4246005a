// The picture that is cut as a map of its brightness: G(i,j) under the mouse, and a region marked by two
// clicks.
#pragma once

#include "core/plan/plot_work.h"
#include "ui/panels/panel.h"

#include <memory>
#include <optional>
#include <vector>

namespace millwright::panels {

class PicturePane final : public Panel {
public:
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask) override;

private:
    void draw_buttons(Ui& ui, const FrameState& now, ActionQueue& ask);
    struct Cell {
        int row = 0; ///< from the top
        int column = 0;
    };

    void follow(const std::shared_ptr<const plan::ShownPicture>& shown);
    [[nodiscard]] Cell cell_at(double x, double y) const;
    void mark(const Cell& corner, ActionQueue& ask);
    /// px
    [[nodiscard]] float map_height(const Ui& ui) const;

    std::shared_ptr<const plan::ShownPicture> shown_; ///< of which the rest is
    std::vector<double> x_, y_, gray_;                ///< as heat_map() takes them
    std::optional<Cell> first_;                       ///< corner of a region
    /// Readable: as high as the pane, or so high that cells can be clicked; then it scrolls.
    enum class MapSize { readable, pane, width };
    MapSize size_ = MapSize::readable;
};

} // namespace millwright::panels
