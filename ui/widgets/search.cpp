#include "ui/widgets/search.h"

#include "ui/widgets/icons.h"
#include "ui/widgets/internal/draw.h"
#include "ui/widgets/internal/edit.h"
#include "ui/widgets/internal/imgui_inside.h"
#include "ui/widgets/matching.h"

#include <fmt/format.h>
#include <imgui_stdlib.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
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

/// What is drawn in a row, and how.
struct SearchRow {
    const SearchItem& item;
    std::string detail;
    bool chosen = false;
    bool enabled = true;
};

void draw_search_row(Ui& ui, const Rect& row, const SearchRow& what) {
    const SearchItem& item = what.item;
    const Palette& colours = ui.colours();
    const Fonts& fonts = ui.look().fonts;
    const double opacity = what.enabled ? 1.0 : disabled_opacity;
    if (what.chosen) {
        fill(row, colours.selection, ui.px(gaps::rounding));
    }
    const float pad = ui.px(12.0F);
    const float shortcut = text_width(fonts.small, item.shortcut);
    const float detail = text_width(fonts.small, what.detail);
    const Rect right{row.right() - pad - shortcut, row.y, shortcut, row.h};
    const Rect middle{right.x - ui.px(16.0F) - detail, row.y, detail, row.h};
    draw_text(ui, fonts.small, right, faded(colours.text, 0.85 * opacity), item.shortcut);
    draw_text(ui, fonts.small, middle, faded(colours.muted, opacity), what.detail);
    draw_text(ui,
              fonts.text,
              {row.x + pad, row.y, middle.x - row.x - 2.0F * pad, row.h},
              faded(colours.text, opacity),
              item.title);
}

/// How a typed word fits a text, best first.
enum class WordFit : std::uint8_t { whole, start, part, none };

bool is_in_word(char c) {
    const char low = lower_case(c);
    constexpr unsigned char last_of_ascii = 127;
    return (low >= 'a' && low <= 'z') || (low >= '0' && low <= '9') ||
           static_cast<unsigned char>(c) > last_of_ascii;
}

WordFit fit_of(std::string_view word, std::string_view text) {
    WordFit best = WordFit::none;
    for (std::size_t at = 0; at + word.size() <= text.size(); ++at) {
        const std::size_t end = at + word.size();
        if (std::ranges::equal(text.substr(at, word.size()), word, same_letter)) {
            const bool starts = at == 0 || !is_in_word(text[at - 1]);
            const bool ends = end == text.size() || !is_in_word(text[end]);
            best = std::min(best, !starts ? WordFit::part : ends ? WordFit::whole : WordFit::start);
        }
    }
    return best;
}

std::vector<std::string_view> words_of(std::string_view letters) {
    std::vector<std::string_view> words;
    while (!letters.empty()) {
        const std::size_t end = std::min(letters.find(' '), letters.size());
        if (end > 0) {
            words.push_back(letters.substr(0, end));
        }
        letters.remove_prefix(std::min(end + 1, letters.size()));
    }
    return words;
}

/// Smaller is better; nothing if the word is nowhere. The title counts before all else.
std::optional<int> rank_of(std::string_view word, const SearchItem& item) {
    const WordFit title = fit_of(word, item.title);
    const WordFit other = std::min(fit_of(word, item.detail), fit_of(word, item.synonyms));
    const bool in_tip = fit_of(word, item.tip) == WordFit::whole;
    std::optional<int> best;
    const auto take = [&best](int rank) { best = std::min(best.value_or(rank), rank); };
    if (title != WordFit::none) {
        take(2 * static_cast<int>(title));
    }
    if (other != WordFit::none) {
        take(2 * static_cast<int>(other) + 1);
    }
    if (in_tip) {
        take(2 * static_cast<int>(WordFit::none));
    }
    return best;
}

/// That of the word that fits least. A title that begins with what was typed is before all others.
std::optional<int> rank_of(const std::vector<std::string_view>& words, const SearchItem& item) {
    int worst = 0;
    for (const std::string_view word : words) {
        const auto rank = rank_of(word, item);
        if (!rank) {
            return std::nullopt;
        }
        worst = std::max(worst, *rank);
    }
    const bool first =
        worst == 0 && !words.empty() && item.title.size() >= words.front().size() &&
        std::ranges::equal(item.title.substr(0, words.front().size()), words.front(), same_letter);
    return first ? -1 : worst;
}

/// The other name by which an item was found; empty if it was found by its title.
std::string_view synonym_found(std::string_view letters, const SearchItem& item) {
    for (const std::string_view word : words_of(letters)) {
        if (fit_of(word, item.title) != WordFit::none || fit_of(word, item.detail) != WordFit::none) {
            continue;
        }
        std::string_view left = item.synonyms;
        while (!left.empty()) {
            const std::size_t end = std::min(left.find(','), left.size());
            const std::string_view name = left.substr(0, end);
            if (fit_of(word, name) != WordFit::none) {
                return name.substr(std::min(name.find_first_not_of(' '), name.size()));
            }
            left.remove_prefix(std::min(end + 1, left.size()));
        }
    }
    return {};
}

} // namespace

std::vector<std::ptrdiff_t> find_items(std::string_view letters, std::span<const SearchItem> items) {
    const std::vector<std::string_view> words = words_of(letters);
    std::vector<std::tuple<bool, int, std::ptrdiff_t>> ranked, scattered;
    for (std::ptrdiff_t i = 0; i < std::ssize(items); ++i) {
        const SearchItem& item = items[static_cast<std::size_t>(i)];
        const bool refused = !item.permission.allowed;
        if (const auto rank = rank_of(words, item)) {
            ranked.emplace_back(refused, *rank, i);
        } else if (const auto score =
                       fuzzy_score(letters, std::string(item.title) + " " + std::string(item.detail))) {
            scattered.emplace_back(refused, -*score, i);
        }
    }
    auto& best = ranked.empty() ? scattered : ranked;
    std::sort(best.begin(), best.end());
    std::vector<std::ptrdiff_t> found;
    std::ranges::transform(best, std::back_inserter(found), [](const auto& s) { return std::get<2>(s); });
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
        draw_text(
            ui, ui.look().fonts.text, slot.rect(), ui.colours().muted, "No matching command.", Align::centre);
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
    // A click on a row takes the keyboard from the field, and so does Enter on what is refused.
    constexpr int soon = 3; // frames until the field has it
    const bool lost = !text_field_active() && !ImGui::IsAnyMouseDown() &&
                      ImGui::GetFrameCount() > keyboard_asked_at_ + soon;
    if (std::exchange(takes_keyboard_, false) || lost) {
        await_keyboard(ui.state(), soon);
        focus_next_item();
        keyboard_asked_at_ = ImGui::GetFrameCount();
    }
    const std::string before = letters_;
    entered_ = ImGui::InputTextWithHint(
        "##letters", "Search commands and settings", &letters_, ImGuiInputTextFlags_EnterReturnsTrue);
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
        const std::string_view name = synonym_found(letters_, item);
        const std::string detail =
            name.empty() ? std::string(item.detail) : fmt::format("{} - {}", name, item.detail);
        draw_search_row(ui, slot.rect(), {item, detail, n == row_, now.enabled});
        chosen = now.clicked ? std::optional(index) : chosen;
    }
    return chosen;
}

} // namespace millwright::widgets
