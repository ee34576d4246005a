// Rows and columns: results side by side, control points, jobs. Numbers stand right-aligned under their
// header.
#pragma once

#include "ui/widgets/ui.h"

#include <cstddef>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace millwright::widgets {

struct Column {
    std::string_view label;
    std::string_view unit = {};
    float share = 1.0F; ///< of the width, against the other columns, where each has what it needs
    bool is_number = false;
};

struct TableView {
    std::span<const Column> columns = {};
    std::ptrdiff_t rows = 0;
    std::function<std::string(std::ptrdiff_t row, int column)> cell =
        {};                                                     ///< asked for the rows in sight only
    std::function<std::string(std::ptrdiff_t row)> row_id = {}; ///< of the domain; makes the path
    std::ptrdiff_t chosen = -1;
    std::function<bool(std::ptrdiff_t row)> is_chosen = {}; ///< where several may be; empty: `chosen` alone
    std::ptrdiff_t wanted = -1;                             ///< brought into sight in this frame; -1: none
    std::function<bool(std::ptrdiff_t row, int column)> is_muted = {}; ///< greyed; empty: none is
    float height = 0.0F; ///< of the whole table; 0: as its rows need
    std::string_view when_empty = "No entries yet.";
};

/// The row just clicked. Where the box is too narrow for its columns it scrolls sideways; numbers are never
/// cut.
std::optional<std::ptrdiff_t> table(Ui& ui, std::string_view id, const TableView& view);

} // namespace millwright::widgets
