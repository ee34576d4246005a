#include "ui/design_panels/norm_plot.h"

#include "ui/widgets/plot.h"

#include <array>

namespace millwright::panels {

namespace {

constexpr float norm_plot_height = 150.0F; // px at scale 1

} // namespace

void norm_plot(widgets::Ui& ui, const std::vector<grid::IterationNorm>& norms) {
    if (norms.empty()) {
        return;
    }
    std::vector<double> iterations, values;
    iterations.reserve(norms.size());
    values.reserve(norms.size());
    for (const grid::IterationNorm& at : norms) {
        iterations.push_back(static_cast<double>(iterations.size() + 1));
        values.push_back(at.norm);
    }
    const std::array series{widgets::Series{.label = "Norm", .x = iterations, .y = values}};
    ui.note("Residual norm after each iteration. A jump marks the start of a round.");
    (void)widgets::line_plot(ui,
                             "norms",
                             {.x_label = "Iteration",
                              .y_label = "Norm",
                              .series = series,
                              .y_is_log = true,
                              .has_key = false,
                              .height = norm_plot_height});
}

} // namespace millwright::panels
