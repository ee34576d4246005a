// One window with every widget in it, to be looked at and to be measured.
#pragma once

#include "ui/widgets/widgets.h"

#include <string>
#include <vector>

namespace millwright::test {

/// Widgets of the size and order they have in the workbench, with values of a real project.
class Gallery {
public:
    Gallery();
    /// Fills 1280 x 800 at scale 1 (more at larger scales).
    void draw(widgets::Ui& ui);

    widgets::Search search;
    widgets::Toasts toasts;

private:
    void draw_menu_bar(widgets::Ui& ui);
    void draw_outline(widgets::Ui& ui);
    void draw_view(widgets::Ui& ui);
    void draw_inspector(widgets::Ui& ui);
    void draw_bottom(widgets::Ui& ui);
    void draw_status(widgets::Ui& ui);

    std::vector<double> path_mm_;
    std::vector<double> error_mm_;
    std::vector<double> feed_;
    std::vector<double> iteration_;
    std::vector<double> norm_;
};

} // namespace millwright::test
