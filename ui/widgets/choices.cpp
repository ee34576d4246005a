#include "core/base/error.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/internal/draw.h"
#include "ui/widgets/ui.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace millwright::widgets {

namespace {

constexpr float between_rows = 2.0F;

std::string with_icon(const Option& option) {
    return option.icon.empty() ? std::string(option.label)
                               : std::string(option.icon) + "  " + std::string(option.label);
}

std::string option_path(const std::string& own, const Option& option) {
    return own + "/" + std::string(option.id);
}

void expect_index(const std::string& own, int now, std::span<const Option> options) {
    expects(now >= 0 && now < std::ssize(options), "the selected index is one of the options: " + own);
}

/// The rows of an open popup.
std::optional<int> popup_rows(Ui& ui, const std::string& own, int now, std::span<const Option> options) {
    std::optional<int> chosen;
    int index = 0;
    for (const Option& option : options) {
        const Slot slot(ui, 0.0F, ui.px(gaps::row));
        const Press pressed = press(ui, option_path(own, option), slot.rect(), option.permission, option.tip);
        if (index == now) {
            ImGui::SetItemDefaultFocus(); // the arrows begin there
        }
        const bool entered = pressed.focused && pressed.enabled && ui.enter_pressed();
        const Palette& colours = ui.colours();
        const Colour ground = index == now ? colours.selection : pressed.hovered ? colours.hover : Colour{0};
        fill(slot.rect(), ground, ui.px(gaps::rounding));
        const Rect words{
            slot.rect().x + ui.px(8.0F), slot.rect().y, slot.rect().w - ui.px(16.0F), slot.rect().h};
        draw_text(ui,
                  ui.look().fonts.text,
                  words,
                  faded(colours.text, pressed.enabled ? 1.0 : disabled_opacity),
                  with_icon(option));
        if (pressed.clicked || entered) {
            chosen = index;
            ImGui::CloseCurrentPopup();
        }
        ++index;
    }
    return chosen;
}

/// The list below its field, above it where there is more room; it scrolls if it is too long for both.
Rect popup_place(const Ui& ui, const Rect& field, std::span<const Option> options) {
    float width = field.w;
    for (const Option& option : options) {
        width = std::max(width, text_width(ui.look().fonts.text, with_icon(option)) + ui.px(40.0F));
    }
    const float away = ui.px(2.0F);
    const auto rows = static_cast<float>(options.size());
    const float wanted = rows * ui.px(gaps::row) + (rows - 1.0F) * between_rows + 2.0F * ui.px(gaps::tiny);
    const ImVec2 window = ImGui::GetIO().DisplaySize;
    const float below = window.y - field.bottom() - 2.0F * away;
    const float above = field.y - 2.0F * away;
    const bool opens_up = wanted > below && above > below;
    const float height = std::ceil(std::min(wanted, std::max(opens_up ? above : below, ui.px(gaps::row))));
    const float x = std::clamp(field.x, 0.0F, std::max(0.0F, window.x - width));
    return {x, opens_up ? field.y - away - height : field.bottom() + away, width, height};
}

struct PopupFrame {
    PopupFrame(const Ui& ui, const Rect& place) {
        const float pad = ui.px(gaps::tiny);
        ImGui::SetNextWindowPos(upper_left(place));
        ImGui::SetNextWindowSize({place.w, place.h});
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {pad, pad});
        ImGui::PushStyleVar(ImGuiStyleVar_ItemSpacing, {0.0F, between_rows});
    }
    PopupFrame(const PopupFrame&) = delete;
    PopupFrame& operator=(const PopupFrame&) = delete;
    ~PopupFrame() { ImGui::PopStyleVar(2); }
};

constexpr float more_width = 34.0F;

constexpr float tab_pad = 20.0F; // of both sides
constexpr float tight_tab_pad = 10.0F;

struct TabRow {
    bool icons = true;
    float pad = tab_pad;
    std::vector<int> shown;
    std::vector<int> others; ///< behind a button at the end
};

float tab_width(const Ui& ui, const Option& option, const TabRow& row) {
    const std::string words = row.icons ? with_icon(option) : std::string(option.label);
    return std::ceil(text_width(ui.look().fonts.strong, words) + ui.px(row.pad));
}

float tabs_width(const Ui& ui, std::span<const Option> options, const TabRow& row) {
    float width = 0.0F;
    for (const Option& option : options) {
        width += tab_width(ui, option, row);
    }
    return width;
}

/// Where not all of them have room, they lose their icons and some of the space between them; where that is
/// not enough, the last ones go behind a button, but never the chosen one.
TabRow tabs_that_fit(const Ui& ui, float room, int now, std::span<const Option> options) {
    TabRow row;
    row.icons = tabs_width(ui, options, row) <= room;
    if (tabs_width(ui, options, row) > room) {
        row.pad = tight_tab_pad;
    }
    const bool all = tabs_width(ui, options, row) <= room;
    float left = room;
    if (!all) {
        left -= ui.px(more_width) + tab_width(ui, options[static_cast<std::size_t>(now)], row);
    }
    int index = 0;
    for (const Option& option : options) {
        const float width = index == now ? 0.0F : tab_width(ui, option, row);
        const bool fits = all || index == now || (left >= width && row.others.empty());
        (fits ? row.shown : row.others).push_back(index);
        left -= width;
        ++index;
    }
    return row;
}

/// The button that has the tabs without room, and its list.
std::optional<int> other_tabs(Ui& ui,
                              const std::string& own,
                              const Rect& place,
                              const std::vector<int>& others,
                              std::span<const Option> options) {
    const std::string more = own + "/more";
    const Press pressed = press(ui, more, place, {}, "More pages");
    const Colour colour = pressed.hovered ? ui.colours().text : ui.colours().muted;
    draw_text(ui, ui.look().fonts.text, place, colour, icons::chevron_down, Align::centre);
    if (pressed.clicked) {
        ImGui::OpenPopup(more.c_str());
    }
    if (!ImGui::IsPopupOpen(more.c_str())) {
        return std::nullopt;
    }
    std::vector<Option> rows;
    for (const int index : others) {
        rows.push_back(options[static_cast<std::size_t>(index)]);
    }
    const PopupFrame frame(ui, popup_place(ui, place, rows));
    std::optional<int> chosen;
    if (ImGui::BeginPopup(more.c_str())) {
        chosen = popup_rows(ui, own, -1, rows);
        ImGui::EndPopup();
    }
    return chosen ? std::optional(others[static_cast<std::size_t>(*chosen)]) : std::nullopt;
}

/// One of the cells of a segmented choice.
bool draw_segment(Ui& ui, const Rect& cell, const Press& pressed, bool chosen, const Option& option) {
    const Palette& colours = ui.colours();
    if (chosen || pressed.hovered) {
        const float in = ui.px(2.0F);
        fill({cell.x + in, cell.y + in, cell.w - 2.0F * in, cell.h - 2.0F * in},
             chosen ? colours.selection : colours.hover,
             ui.px(3.0F));
    }
    const float pad = ui.px(5.0F);
    return draw_text(ui,
                     ui.look().fonts.text,
                     {cell.x + pad, cell.y, cell.w - 2.0F * pad, cell.h},
                     faded(chosen ? colours.text : mixed(colours.muted, colours.text, 0.4),
                           pressed.enabled ? 1.0 : disabled_opacity),
                     with_icon(option),
                     Align::centre);
}

} // namespace

std::optional<int> Ui::choice(std::string_view id,
                              std::string_view label,
                              int now,
                              std::span<const Option> options,
                              std::string_view tip) {
    const std::string own = path(id);
    expect_index(own, now, options);
    Rect field;
    {
        const Slot slot(*this, 0.0F, px(gaps::row));
        field = labelled(*this, own, slot.rect(), label, tip, effective(*this, {}).allowed);
        const Press pressed = press(*this, own, field, {}, tip);
        const double opacity = pressed.enabled ? 1.0 : disabled_opacity;
        fill(field, faded(pressed.hovered ? colours().hover : colours().raised, opacity), px(gaps::rounding));
        const float arrow = px(24.0F);
        const std::string words = with_icon(options[static_cast<std::size_t>(now)]);
        const bool cut = draw_text(*this,
                                   look_.fonts.text,
                                   {field.x + px(8.0F), field.y, field.w - px(8.0F) - arrow, field.h},
                                   faded(colours().text, opacity),
                                   words);
        if (cut && pressed.enabled) {
            offer_tip(*this, own, field, tip.empty() ? words : words + "\n" + std::string(tip));
        }
        draw_text(*this,
                  look_.fonts.small,
                  {field.right() - arrow, field.y, arrow, field.h},
                  faded(colours().muted, opacity),
                  icons::chevron_down,
                  Align::centre);
        if (pressed.clicked) {
            ImGui::OpenPopup(own.c_str());
        }
    }
    if (!ImGui::IsPopupOpen(own.c_str())) {
        return std::nullopt;
    }
    const PopupFrame frame(*this, popup_place(*this, field, options));
    std::optional<int> chosen;
    if (ImGui::BeginPopup(own.c_str())) {
        chosen = popup_rows(*this, own, now, options);
        ImGui::EndPopup();
    }
    return chosen == now ? std::nullopt : chosen;
}

std::optional<int> Ui::segmented(std::string_view id,
                                 std::string_view label,
                                 int now,
                                 std::span<const Option> options,
                                 std::string_view tip) {
    const std::string own = path(id);
    expect_index(own, now, options);
    const Slot slot(*this, 0.0F, px(gaps::row));
    const Rect all = labelled(*this, own, slot.rect(), label, tip, effective(*this, {}).allowed);
    record_at(*this, own, all);
    fill(all, colours().field, px(gaps::rounding));
    outline(all, colours().line, px(gaps::rounding));
    std::optional<int> chosen;
    const float width = all.w / static_cast<float>(options.size());
    int index = 0;
    for (const Option& option : options) {
        const float x = std::round(all.x + static_cast<float>(index) * width);
        const Rect cell{x, all.y, std::round(all.x + static_cast<float>(index + 1) * width) - x, all.h};
        const Press pressed = press(*this, option_path(own, option), cell, option.permission, option.tip);
        const bool cut = draw_segment(*this, cell, pressed, index == now, option);
        if (cut && option.tip.empty()) {
            offer_tip(*this, option_path(own, option), cell, option.label);
        }
        if (pressed.clicked && index != now) {
            chosen = index;
        }
        ++index;
    }
    return chosen;
}

std::optional<int> Ui::tabs(std::string_view id, int now, std::span<const Option> options) {
    const std::string own = path(id);
    expect_index(own, now, options);
    const Slot slot(*this, 0.0F, px(gaps::row + 4.0F));
    const Rect& bar = slot.rect();
    record_at(*this, own, bar);
    fill({bar.x, bar.bottom() - 1.0F, bar.w, 1.0F}, colours().line);
    const TabRow row = tabs_that_fit(*this, bar.w, now, options);
    std::optional<int> chosen;
    float x = bar.x;
    for (const int index : row.shown) {
        const Option& option = options[static_cast<std::size_t>(index)];
        const ImFont* font = index == now ? look_.fonts.strong : look_.fonts.text;
        const Rect tab{x, bar.y, tab_width(*this, option, row), bar.h};
        const Press pressed = press(*this, option_path(own, option), tab, option.permission, option.tip);
        const Colour colour = index == now || pressed.hovered ? colours().text : colours().muted;
        const std::string words = row.icons ? with_icon(option) : std::string(option.label);
        draw_text(
            *this, font, tab, faded(colour, pressed.enabled ? 1.0 : disabled_opacity), words, Align::centre);
        if (index == now) {
            fill({tab.x, bar.bottom() - px(2.0F), tab.w, px(2.0F)}, colours().accent);
        }
        if (pressed.clicked && index != now) {
            chosen = index;
        }
        x = tab.right();
    }
    if (!row.others.empty()) {
        const auto other = other_tabs(*this, own, {x, bar.y, px(more_width), bar.h}, row.others, options);
        chosen = other ? other : chosen;
    }
    return chosen;
}

} // namespace millwright::widgets
