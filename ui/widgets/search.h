// Everything a user can do, found by a few letters (Ctrl+K): type, choose with the arrow keys, Enter.
#pragma once

#include "ui/widgets/ui.h"

#include <cstddef>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::widgets {

struct SearchItem {
    std::string_view id; ///< last part of the row's path
    std::string_view title;
    std::string_view detail = {};   ///< where it belongs, such as "Grid"
    std::string_view shortcut = {}; ///< as people read it: Ctrl+S
    Permission permission = {};
    std::string_view synonyms = {}; ///< other names for it, separated by commas: "zoom, whole view"
    std::string_view tip = {};      ///< what it does; its whole words find it, too
};

/// View state of the palette; kept by the panel.
class Search {
public:
    void open();
    void close() { is_open_ = false; }
    [[nodiscard]] bool is_open() const { return is_open_; }

    /// Draws the palette over the window while it is open. The index of the item just chosen; it is closed
    /// then. Paths: `id`/letters and `id`/<item id>. Esc and a click elsewhere close it.
    std::optional<std::ptrdiff_t> draw(Ui& ui, std::string_view id, std::span<const SearchItem> items);

private:
    std::optional<std::ptrdiff_t> draw_inside(Ui& ui, std::span<const SearchItem> items);
    void type_letters(Ui& ui);
    std::optional<std::ptrdiff_t>
    draw_found(Ui& ui, std::span<const SearchItem> items, const std::vector<std::ptrdiff_t>& found);

    bool is_open_ = false;
    bool takes_keyboard_ = false;
    int keyboard_asked_at_ = 0; ///< frame
    bool entered_ = false;
    std::string letters_;
    std::ptrdiff_t row_ = 0;
    std::ptrdiff_t top_ = 0;
};

/// The items that fit, best first: those that are allowed before those that are not, then by how each typed
/// word fits (a whole word, the start of one, a part of one), then in the order given. Letters scattered over
/// a title fit only where nothing else does.
[[nodiscard]] std::vector<std::ptrdiff_t> find_items(std::string_view letters,
                                                     std::span<const SearchItem> items);

} // namespace millwright::widgets
