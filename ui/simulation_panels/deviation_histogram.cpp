#include "ui/simulation_panels/deviation_histogram.h"

#include "core/base/text.h"
#include "ui/viewport/stock_sight.h"
#include "ui/widgets/sketch.h"

#include <imgui.h>

#include <algorithm>
#include <cstddef>

namespace millwright::panels {

namespace {

constexpr float bars_height = 64.0F, scale_height = 18.0F; // px at scale 1
constexpr float gap_share = 0.12F;                         // of a bar's width

widgets::Colour solid(const glm::vec3& color) {
    return ImGui::ColorConvertFloat4ToU32({color.r, color.g, color.b, 1.0F});
}

} // namespace

void deviation_histogram(widgets::Ui& ui, const simulation::DeviationHistogram& histogram, double tolerance) {
    if (histogram.shares.empty()) {
        return;
    }
    widgets::Rect all = ui.rest();
    all.h = ui.px(bars_height + scale_height);
    ui.record("histogram", all);
    const double most = *std::ranges::max_element(histogram.shares);
    const float width = all.w / static_cast<float>(histogram.shares.size());
    const float bars = ui.px(bars_height);
    {
        widgets::Sketch sketch(ui, all);
        for (std::size_t n = 0; n < histogram.shares.size(); ++n) {
            const float height = most > 0.0 ? bars * static_cast<float>(histogram.shares[n] / most) : 0.0F;
            const widgets::Colour color = solid(viewport::stock_color(histogram.height(n), tolerance));
            const widgets::Rect bar{all.x + width * (static_cast<float>(n) + 0.5F * gap_share),
                                    all.y + bars - height,
                                    width * (1.0F - gap_share),
                                    height};
            sketch.box(bar, color, color);
        }
        sketch.line({all.x, all.y + bars}, {all.x + all.w, all.y + bars}, ui.colours().muted);
        const widgets::Rect scale{all.x, all.y + bars, all.w, ui.px(scale_height)};
        const std::string range = shortest(histogram.range);
        sketch.text(
            scale, "-" + range, ui.colours().muted, widgets::TextAlign::left, widgets::TextFont::small);
        sketch.text(scale, "0", ui.colours().muted, widgets::TextAlign::centre, widgets::TextFont::small);
        sketch.text(
            scale, range + " mm", ui.colours().muted, widgets::TextAlign::right, widgets::TextFont::small);
    }
    ui.move_by(0.0F, all.h);
}

} // namespace millwright::panels
