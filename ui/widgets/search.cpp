#include "ui/widgets/search.h"

#include "ui/widgets/fuzzy.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/internal/draw.h"
#include "ui/widgets/internal/imgui_inside.h"
#include "ui/widgets/internal/letters.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace millwright::widgets {

namespace {

constexpr std::ptrdiff_t most_rows = 9;
constexpr float palette_width = 560.0F;
constexpr float row_height = 32.0F;
constexpr float field_height = 40.0F;

Rect palette_box(const Ui& ui, std::ptrdiff_t rows) {
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const float width = std::min(ui.px(palette_width), display.x - ui.px(16.0F));
    const float lines = static_cast<float>(std::max<std::ptrdiff_t>(1, std::min(rows, most_rows)));
    const float height = ui.px(field_height) + lines * ui.px(row_height) + ui.px(12.0F);
    return {std::round(0.5F * (display.x - width)), std::round(0.12F * display.y), width, height};
}

void draw_search_item(Ui& ui, const Rect& row, const SearchItem& item, bool chosen, bool enabled) {
    const Palette& colours = ui.colours();
    const Fonts& fonts = ui.look().fonts;
    const double opacity = enabled ? 1.0 : disabled_opacity;
    if (chosen) {
        fill(row, colours.selection, ui.px(gaps::rounding));
    }
    const float pad = ui.px(12.0F);
    const float shortcut = text_width(fonts.small, item.shortcut);
    const float detail = text_width(fonts.small, item.detail);
    const Rect right{row.right() - pad - shortcut, row.y, shortcut, row.h};
    const Rect middle{right.x - ui.px(16.0F) - detail, row.y, detail, row.h};
    draw_text(ui, fonts.small, right, faded(colours.text, 0.85 * opacity), item.shortcut);
    draw_text(ui, fonts.small, middle, faded(colours.muted, opacity), item.detail);
    draw_text(ui,
              fonts.text,
              {row.x + pad, row.y, middle.x - row.x - 2.0F * pad, row.h},
              faded(colours.text, opacity),
              item.title);
}

/// Whether the first words of `title` are exactly what was typed.
bool begins_with_words(std::string_view title, std::string_view letters) {
    const auto last = letters.find_last_not_of(' ');
    letters = letters.substr(0, last == std::string_view::npos ? 0 : last + 1);
    return !letters.empty() && title.size() >= letters.size() &&
           std::ranges::equal(title.substr(0, letters.size()), letters, same_letter) &&
           (title.size() == letters.size() || title[letters.size()] == ' ');
}

} // namespace

std::vector<std::ptrdiff_t> find_items(std::string_view letters, std::span<const SearchItem> items) {
    std::vector<std::tuple<bool, int, std::ptrdiff_t>> scored;
    for (std::ptrdiff_t i = 0; i < std::ssize(items); ++i) {
        const SearchItem& item = items[static_cast<std::size_t>(i)];
        const std::string whole = std::string(item.title) + " " + std::string(item.detail);
        if (const auto score = fuzzy_score(letters, whole)) {
            scored.emplace_back(!begins_with_words(item.title, letters), -*score, i);
        }
    }
    std::sort(scored.begin(), scored.end());
    std::vector<std::ptrdiff_t> found;
    std::ranges::transform(scored, std::back_inserter(found), [](const auto& s) { return std::get<2>(s); });
    return found;
}

void Search::open() {
    is_open_ = true;
    takes_keyboard_ = true;
    letters_.clear();
    row_ = 0;
    top_ = 0;
}

std::optional<std::ptrdiff_t> Search::draw(Ui& ui, std::string_view id, std::span<const SearchItem> items) {
    if (!is_open_) {
        return std::nullopt;
    }
    const std::string own = ui.path(id);
    const Rect box = palette_box(ui, std::ssize(find_items(letters_, items)));
    ImGui::SetNextWindowPos(upper_left(box));
    ImGui::SetNextWindowSize({box.w, box.h});
    if (takes_keyboard_) {
        ImGui::SetNextWindowFocus();
    }
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {ui.px(6.0F), ui.px(6.0F)});
    ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0F, 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowRounding, ui.px(6.0F));
    ImGui::PushStyleVar(ImGuiStyleVar_WindowBorderSize, 1.0F);
    ImGui::PushStyleColor(ImGuiCol_WindowBg, mixed(ui.colours().pane, ui.colours().raised, 0.5));
    constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                       ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoNav;
    ImGui::Begin(own.c_str(), nullptr, flags);
    std::optional<std::ptrdiff_t> chosen;
    {
        record_at(ui, own, box);
        const auto scope = ui.scope(id);
        chosen = draw_inside(ui, items);
    }
    ImGui::End();
    ImGui::PopStyleColor();
    ImGui::PopStyleVar(4);
    const bool clicked_elsewhere = ImGui::IsMouseClicked(ImGuiMouseButton_Left) &&
                                   !ImGui::IsMouseHoveringRect(upper_left(box), lower_right(box), false);
    if (chosen || clicked_elsewhere || key_pressed(ImGuiKey_Escape)) {
        is_open_ = false;
    }
    return chosen;
}

std::optional<std::ptrdiff_t> Search::draw_inside(Ui& ui, std::span<const SearchItem> items) {
    type_letters(ui);
    const std::vector<std::ptrdiff_t> found = find_items(letters_, items);
    if (found.empty()) {
        const Slot slot(ui, 0.0F, ui.px(row_height));
        draw_text(ui,
                  ui.look().fonts.text,
                  slot.rect(),
                  ui.colours().muted,
                  "Nothing of that name.",
                  Align::centre);
        return std::nullopt;
    }
    row_ += key_pressed(ImGuiKey_DownArrow) ? 1 : 0;
    row_ -= key_pressed(ImGuiKey_UpArrow) ? 1 : 0;
    row_ = std::clamp<std::ptrdiff_t>(row_, 0, std::ssize(found) - 1);
    top_ = std::clamp(top_, std::max<std::ptrdiff_t>(0, row_ - most_rows + 1), row_);
    std::optional<std::ptrdiff_t> chosen = draw_found(ui, items, found);
    const std::ptrdiff_t at_row = found[static_cast<std::size_t>(row_)];
    if (entered_ && items[static_cast<std::size_t>(at_row)].permission.allowed) {
        chosen = at_row;
    }
    return chosen;
}

void Search::type_letters(Ui& ui) {
    const Slot slot(ui, 0.0F, ui.px(field_height));
    const Rect& all = slot.rect();
    const float icon = ui.px(34.0F);
    draw_text(ui,
              ui.look().fonts.text,
              {all.x, all.y, icon, all.h},
              ui.colours().muted,
              icons::search,
              Align::centre);
    const float line = ui.look().fonts.text->FontSize;
    ImGui::SetCursorScreenPos({all.x + icon, std::round(all.y + 0.5F * (all.h - line))});
    ImGui::SetNextItemWidth(all.w - icon - ui.px(8.0F));
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.0F, 0.0F});
    ImGui::PushStyleColor(ImGuiCol_FrameBg, 0U);
    if (std::exchange(takes_keyboard_, false)) {
        focus_next_item();
    }
    const std::string before = letters_;
    entered_ = ImGui::InputTextWithHint(
        "##letters", "What do you want to do?", &letters_, ImGuiInputTextFlags_EnterReturnsTrue);
    ImGui::PopStyleColor();
    ImGui::PopStyleVar();
    record_at(ui, ui.path("letters"), all);
    fill({all.x, all.bottom() - 1.0F, all.w, 1.0F}, ui.colours().line);
    if (letters_ != before) {
        row_ = 0;
        top_ = 0;
    }
}

std::optional<std::ptrdiff_t>
Search::draw_found(Ui& ui, std::span<const SearchItem> items, const std::vector<std::ptrdiff_t>& found) {
    std::optional<std::ptrdiff_t> chosen;
    const bool mouse_moves =
        std::abs(ImGui::GetIO().MouseDelta.x) + std::abs(ImGui::GetIO().MouseDelta.y) > 0.0F;
    for (std::ptrdiff_t n = top_; n < std::min(std::ssize(found), top_ + most_rows); ++n) {
        const std::ptrdiff_t index = found[static_cast<std::size_t>(n)];
        const SearchItem& item = items[static_cast<std::size_t>(index)];
        const Slot slot(ui, 0.0F, ui.px(row_height));
        const Press now = press(ui, ui.path(item.id), slot.rect(), item.permission);
        const ImVec2 mouse = ImGui::GetIO().MousePos;
        if (mouse_moves && slot.rect().contains({mouse.x, mouse.y})) {
            row_ = n;
        }
        draw_search_item(ui, slot.rect(), item, n == row_, now.enabled);
        chosen = now.clicked ? std::optional(index) : chosen;
    }
    return chosen;
}

} // namespace millwright::widgets
