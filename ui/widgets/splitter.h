// The bar between two panes, dragged to give one of them more room. The caller keeps the size.
#pragma once

#include "ui/widgets/ui.h"

#include <optional>
#include <string_view>

namespace millwright::widgets {

/// Which of its neighbours the size belongs to.
enum class SizeOf { left, right, above, below };

struct SplitterView {
    Rect bar; ///< between the panes; a few pixels more on each side can be taken too
    SizeOf side = SizeOf::left;
    float size = 0.0F;
    float min = 0.0F;
    float max = 0.0F; ///< below min: min
};

/// The new size while the bar is dragged.
std::optional<float> splitter(Ui& ui, std::string_view id, const SplitterView& view);

} // namespace millwright::widgets
