#include "ui/widgets/internal/draw.h"

#include "ui/widgets/internal/imgui_inside.h"

#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::widgets {

std::string
broken_at_blanks(std::string_view text, float width, const std::function<float(std::string_view)>& width_of) {
    std::string broken(text);
    std::size_t line = 0; // where it begins
    std::size_t blank = std::string::npos;
    for (std::size_t end = 0; end <= text.size(); ++end) {
        const bool at_end = end == text.size() || text[end] == '\n';
        if (!at_end && text[end] != ' ') {
            continue;
        }
        if (blank != std::string::npos && width_of(text.substr(line, end - line)) > width) {
            broken[blank] = '\n';
            line = blank + 1;
        }
        blank = at_end ? std::string::npos : end;
        line = at_end ? end + 1 : line;
    }
    return broken;
}

std::string broken_at_blanks(const ImFont* font, std::string_view text, float width) {
    return broken_at_blanks(text, width, [font](std::string_view piece) {
        constexpr float endless = 1e9F;
        return font->CalcTextSizeA(font->FontSize, endless, 0.0F, piece.data(), piece.data() + piece.size())
            .x;
    });
}

namespace {

constexpr float default_label_share = 0.42F;
constexpr std::string_view ellipsis = "…";

Rect next_cell(Ui& ui, float height) {
    Ui::State::Cells& cells = ui.state().cells.back();
    cells.next = cells.next == cells.count ? 0 : cells.next; // the next line
    const ImVec2 at = ImGui::GetCursorScreenPos();
    if (cells.next == 0) {
        cells.line = {at.x, at.y, ImGui::GetContentRegionAvail().x, height};
    }
    const float gap = ui.px(gaps::small);
    const auto count = static_cast<float>(cells.count);
    const float width = (cells.line.w - gap * (count - 1.0F)) / count;
    const float x = std::round(cells.line.x + static_cast<float>(cells.next) * (width + gap));
    const float right = std::round(cells.line.x + static_cast<float>(cells.next) * (width + gap) + width);
    if (cells.next > 0) {
        ImGui::SetCursorScreenPos({x, cells.line.y});
    }
    ++cells.next;
    --cells.left;
    return {x, cells.line.y, right - x, height};
}

/// The longest start of `text`, cut between characters, that is at most `width` wide.
std::string_view start_of(const ImFont* font, std::string_view text, float width) {
    const char* end = text.data();
    font->CalcTextSizeA(
        font->FontSize, std::max(width, 1.0F), 0.0F, text.data(), text.data() + text.size(), &end);
    return text.substr(0, static_cast<std::size_t>(end - text.data()));
}

} // namespace

Slot::Slot(Ui& ui, float width, float height) {
    if (!ui.state().cells.empty() && ui.state().cells.back().left > 0) {
        rect_ = next_cell(ui, height);
    } else {
        const ImVec2 at = ImGui::GetCursorScreenPos();
        const auto& widths = ui.state().widths;
        const float left = std::max(widths.empty() ? ImGui::GetContentRegionAvail().x : widths.back(), 1.0F);
        rect_ = {at.x, at.y, width > 0.0F ? width : left, height};
    }
    ImGui::BeginGroup();
}

Slot::~Slot() {
    ImGui::SetCursorScreenPos(upper_left(rect_));
    ImGui::Dummy({rect_.w, rect_.h});
    ImGui::EndGroup();
}

void record_at(Ui& ui, const std::string& path, const Rect& rect, bool enabled, std::string reason) {
    const Point middle = rect.centre();
    const bool visible = ImGui::IsRectVisible({middle.x, middle.y}, {middle.x + 1.0F, middle.y + 1.0F});
    ui.state().places.record(path, {rect, enabled, visible, std::move(reason)});
}

const Permission& effective(Ui& ui, const Permission& own) {
    const auto& outer = ui.state().permissions;
    const auto refusing =
        std::find_if(outer.rbegin(), outer.rend(), [](const auto& p) { return !p.allowed; });
    return refusing == outer.rend() ? own : *refusing;
}

Press press(Ui& ui,
            const std::string& path,
            const Rect& rect,
            const Permission& permission,
            std::string_view tip,
            Reach reach) {
    const Permission& allowed = effective(ui, permission);
    Press now;
    now.enabled = allowed.allowed;
    ImGui::SetCursorScreenPos(upper_left(rect));
    ImGui::BeginDisabled(!now.enabled);
    {
        const TabStop stop(reach == Reach::tab_and_mouse);
        now.clicked =
            ImGui::InvisibleButton(path.c_str(), {std::max(rect.w, 1.0F), std::max(rect.h, 1.0F)}) &&
            now.enabled;
    }
    now.hovered = ImGui::IsItemHovered();
    now.held = ImGui::IsItemActive();
    if (ImGui::IsItemHovered(ImGuiHoveredFlags_AllowWhenDisabled)) {
        ui.state().under_mouse = path;
    }
    now.focused = ImGui::IsItemFocused() && ImGui::GetIO().NavVisible;
    ImGui::EndDisabled();
    if (now.focused) {
        const float away = ui.px(1.0F);
        outline({rect.x - away, rect.y - away, rect.w + 2.0F * away, rect.h + 2.0F * away},
                ui.colours().accent,
                ui.px(gaps::rounding),
                ui.px(2.0F));
    }
    record_at(ui, path, rect, now.enabled, allowed.reason);
    offer_tip(ui, path, rect, now.enabled ? tip : std::string_view(allowed.reason));
    return now;
}

void offer_tip(Ui& ui, const std::string& path, const Rect& rect, std::string_view tip) {
    if (tip.empty() || !ImGui::IsWindowHovered(ImGuiHoveredFlags_AllowWhenBlockedByActiveItem) ||
        !ImGui::IsMouseHoveringRect(upper_left(rect), lower_right(rect))) {
        return;
    }
    Ui::State::Tip& now = ui.state().tip;
    const int frame = ImGui::GetFrameCount();
    if (now.path != path || now.frame < frame - 1) {
        now.since = ImGui::GetTime();
    }
    now.path = path;
    now.text = tip;
    now.rect = rect;
    now.at_once = false;
    now.frame = frame;
}

void show_at_mouse(Ui& ui, const std::string& path, std::string text) {
    const ImVec2 mouse = ImGui::GetIO().MousePos;
    const float away = ui.px(14.0F);
    ui.state().tip = {.path = path,
                      .text = std::move(text),
                      .rect = {mouse.x + away, mouse.y, 0.0F, away},
                      .at_once = true,
                      .frame = ImGui::GetFrameCount()};
}

float text_width(const ImFont* font, std::string_view text) {
    if (text.empty()) {
        return 0.0F; // ImGui takes a null end for "up to the zero byte"
    }
    return font->CalcTextSizeA(font->FontSize, 1e9F, 0.0F, text.data(), text.data() + text.size()).x;
}

bool draw_text(
    Ui& ui, const ImFont* font, const Rect& rect, Colour colour, std::string_view text, Align align) {
    if (text.empty()) {
        return false;
    }
    const float width = text_width(font, text);
    const float y = std::round(rect.y + 0.5F * (rect.h - font->FontSize));
    ImDrawList& list = *ImGui::GetWindowDrawList();
    const auto put = [&](float x, std::string_view part) {
        list.AddText(
            font, font->FontSize, {std::round(x), y}, colour, part.data(), part.data() + part.size());
    };
    if (width <= rect.w + 0.5F) {
        const float free = rect.w - width;
        const float x = rect.x + (align == Align::left ? 0.0F : align == Align::right ? free : 0.5F * free);
        put(x, text);
        const bool beyond = x < list.GetClipRectMin().x - 1.0F || x + width > list.GetClipRectMax().x + 1.0F;
        if (beyond && !ui.state().scrolls_sideways) {
            ui.state().cut_texts.emplace_back(text);
        }
        return false;
    }
    ui.state().cut_texts.emplace_back(text);
    const std::string_view shown = start_of(font, text, rect.w - text_width(font, ellipsis));
    put(rect.x, shown);
    put(rect.x + text_width(font, shown), ellipsis);
    return true;
}

void fill(const Rect& rect, Colour colour, float rounding) {
    ImGui::GetWindowDrawList()->AddRectFilled(upper_left(rect), lower_right(rect), colour, rounding);
}

void outline(const Rect& rect, Colour colour, float rounding, float thickness) {
    ImGui::GetWindowDrawList()->AddRect(
        upper_left(rect), lower_right(rect), colour, rounding, ImDrawFlags_None, thickness);
}

Rect labelled(Ui& ui,
              const std::string& path,
              const Rect& row,
              std::string_view label,
              std::string_view tip,
              bool enabled) {
    if (label.empty()) {
        return row;
    }
    const auto& shares = ui.state().label_shares;
    const float share = shares.empty() ? default_label_share : shares.back();
    const float column = std::round(row.w * share);
    const Rect place{row.x, row.y, column - ui.px(gaps::small), row.h};
    const Colour colour = enabled ? ui.colours().text : faded(ui.colours().text, 0.5);
    const bool cut = draw_text(ui, ui.look().fonts.text, place, colour, label);
    const std::string whole = tip.empty() ? std::string(label) : std::string(label) + "\n" + std::string(tip);
    offer_tip(ui, path, place, cut ? std::string_view(whole) : tip);
    return {row.x + column, row.y, row.w - column, row.h};
}

bool key_pressed(ImGuiKey key) {
    return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key));
}

} // namespace millwright::widgets
