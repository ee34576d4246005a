// Very many rows of one height in a box: only those in sight are drawn, with a scroll bar of our own, since
// ImGui's float coordinates lose whole pixels beyond some hundred thousand rows.
#pragma once

#include "ui/widgets/internal/draw.h"

#include <cstddef>
#include <string>

namespace millwright::widgets {

class Rows {
public:
    /// Takes wheel and scroll bar into account; clips drawing to the box until the end of life.
    Rows(Ui& ui, const std::string& path, const Rect& box, std::ptrdiff_t count, float row_height);
    Rows(const Rows&) = delete;
    Rows& operator=(const Rows&) = delete;
    ~Rows();

    [[nodiscard]] std::ptrdiff_t first() const { return first_; }
    [[nodiscard]] std::ptrdiff_t end() const { return end_; } ///< one past the last row in sight
    [[nodiscard]] bool scrolls() const { return scrolls_; }
    [[nodiscard]] Rect row(std::ptrdiff_t index) const;
    /// The part of the row that is inside the box.
    [[nodiscard]] Rect row_in_sight(std::ptrdiff_t index) const;

private:
    Rect inside_;
    double top_ = 0.0; ///< in rows
    float row_height_;
    bool scrolls_ = false;
    std::ptrdiff_t first_ = 0;
    std::ptrdiff_t end_ = 0;
};

/// Scrolls the rows of `path` so that `index` is in sight, in the middle if it was not.
void bring_into_sight(Ui& ui, const std::string& path, std::ptrdiff_t index, float rows_in_sight);

} // namespace millwright::widgets
