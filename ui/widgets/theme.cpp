#include "ui/widgets/theme.h"

#include <imgui.h>

#include <algorithm>
#include <initializer_list>

namespace millwright::widgets {

namespace {

// The first six series of both themes follow Okabe and Ito's set for colour-blind readers, lightened on dark
// ground.
constexpr Palette dark{
    .window = rgb(0x111317),
    .pane = rgb(0x1A1D22),
    .raised = rgb(0x282C34),
    .field = rgb(0x121419),
    .hover = rgb(0x353B45),
    .line = rgb(0x3A404A),
    .text = rgb(0xE8EAEE),
    .muted = rgb(0x9CA4B0),
    .accent = rgb(0x5B9DFF),
    .on_accent = rgb(0x0B1220),
    .selection = rgb(0x24426E),
    .good = rgb(0x4CC38A),
    .warning = rgb(0xF0B340),
    .danger = rgb(0xFF6B64),
    .on_danger = rgb(0x21060A),
    .series = {rgb(0x56B4E9),
               rgb(0xE69F00),
               rgb(0x2CC295),
               rgb(0xF0E442),
               rgb(0xD78FBB),
               rgb(0xE8743B),
               rgb(0xA08CFF),
               rgb(0xA5E05A),
               rgb(0xB98B62),
               rgb(0xA9EDEA),
               rgb(0xFF5FA8),
               rgb(0xAEB6C4)},
    .axis = {rgb(0xF0707A), rgb(0x7BC862), rgb(0x6FA4FF)},
};

constexpr Palette light{
    .window = rgb(0xD9DDE3),
    .pane = rgb(0xF5F6F8),
    .raised = rgb(0xE6E9EE),
    .field = rgb(0xFFFFFF),
    .hover = rgb(0xD8DEE7),
    .line = rgb(0xC2C8D1),
    .text = rgb(0x171B21),
    .muted = rgb(0x56606E),
    .accent = rgb(0x1B62D1),
    .on_accent = rgb(0xFFFFFF),
    .selection = rgb(0xCADFFC),
    .good = rgb(0x12794A),
    .warning = rgb(0x8A5800),
    .danger = rgb(0xC21F27),
    .on_danger = rgb(0xFFFFFF),
    .series = {rgb(0x0072B2),
               rgb(0xB86E00),
               rgb(0x008A66),
               rgb(0x8C7A00),
               rgb(0xA34D83),
               rgb(0xC24A00),
               rgb(0x5B3FD6),
               rgb(0x4B7D1E),
               rgb(0x6E4A2A),
               rgb(0x00707A),
               rgb(0xC2185B),
               rgb(0x5A6472)},
    .axis = {rgb(0xC0303B), rgb(0x3A7F22), rgb(0x1F5FD0)},
};

std::uint32_t mixed_channel(Colour a, Colour b, double t, unsigned shift) {
    const double from = a >> shift & 0xFFU;
    const double to = b >> shift & 0xFFU;
    return static_cast<std::uint32_t>((1.0 - t) * from + t * to + 0.5) << shift;
}

void apply_lengths(float scale, ImGuiStyle& style) {
    style.WindowPadding = {gaps::pad, gaps::pad};
    style.FramePadding = {8.0F, 5.0F};
    style.ItemSpacing = {gaps::small, gaps::small};
    style.ItemInnerSpacing = {gaps::small, gaps::tiny};
    style.CellPadding = {gaps::small, 3.0F};
    style.IndentSpacing = 14.0F;
    style.ScrollbarSize = 10.0F;
    style.GrabMinSize = 12.0F;
    style.WindowRounding = 0.0F;
    style.ChildRounding = gaps::rounding;
    style.FrameRounding = gaps::rounding;
    style.PopupRounding = gaps::rounding;
    style.ScrollbarRounding = gaps::rounding;
    style.GrabRounding = gaps::rounding;
    style.TabRounding = gaps::rounding;
    style.WindowBorderSize = 0.0F;
    style.ChildBorderSize = 0.0F;
    style.FrameBorderSize = 0.0F;
    style.PopupBorderSize = 1.0F;
    style.WindowMinSize = {8.0F, 8.0F};
    style.DisabledAlpha = 0.45F;
    style.ScaleAllSizes(scale);
    style.PopupBorderSize = 1.0F;
}

} // namespace

Colour mixed(Colour a, Colour b, double t) {
    const double share = std::clamp(t, 0.0, 1.0);
    return mixed_channel(a, b, share, 0) | mixed_channel(a, b, share, 8) | mixed_channel(a, b, share, 16) |
           mixed_channel(a, b, share, 24);
}

const Palette& palette(Theme theme) {
    return theme == Theme::dark ? dark : light;
}

void apply(Theme theme, float scale, ImGuiStyle& style) {
    style = ImGuiStyle();
    apply_lengths(scale, style);
    const Palette& now = palette(theme);
    const auto set = [&style](std::initializer_list<ImGuiCol> parts, Colour colour) {
        for (const ImGuiCol part : parts) {
            style.Colors[part] = ImGui::ColorConvertU32ToFloat4(colour);
        }
    };
    for (ImVec4& colour : style.Colors) {
        colour = ImGui::ColorConvertU32ToFloat4(now.raised);
    }
    set({ImGuiCol_Text, ImGuiCol_CheckMark}, now.text);
    set({ImGuiCol_TextDisabled, ImGuiCol_PlotLines, ImGuiCol_PlotHistogram}, now.muted);
    set({ImGuiCol_WindowBg, ImGuiCol_MenuBarBg}, now.pane);
    set({ImGuiCol_PopupBg}, mixed(now.pane, now.raised, 0.5));
    set({ImGuiCol_ChildBg, ImGuiCol_ScrollbarBg, ImGuiCol_BorderShadow, ImGuiCol_TableRowBg}, 0);
    set({ImGuiCol_Border, ImGuiCol_Separator, ImGuiCol_TableBorderStrong, ImGuiCol_TableBorderLight},
        now.line);
    set({ImGuiCol_FrameBg}, now.field);
    set({ImGuiCol_FrameBgHovered, ImGuiCol_ButtonHovered, ImGuiCol_HeaderHovered, ImGuiCol_TabHovered},
        now.hover);
    set({ImGuiCol_ScrollbarGrab}, faded(now.muted, 0.35));
    set({ImGuiCol_ScrollbarGrabHovered}, faded(now.muted, 0.6));
    set({ImGuiCol_ScrollbarGrabActive, ImGuiCol_SliderGrab, ImGuiCol_SliderGrabActive}, now.accent);
    set({ImGuiCol_SeparatorHovered, ImGuiCol_SeparatorActive, ImGuiCol_NavHighlight}, now.accent);
    set({ImGuiCol_Header, ImGuiCol_HeaderActive, ImGuiCol_TabActive}, now.selection);
    set({ImGuiCol_TextSelectedBg}, faded(now.accent, 0.35));
    set({ImGuiCol_TableRowBgAlt}, faded(now.text, 0.03));
    set({ImGuiCol_ModalWindowDimBg, ImGuiCol_NavWindowingDimBg}, faded(now.window, 0.55));
    set({ImGuiCol_DragDropTarget, ImGuiCol_NavWindowingHighlight}, now.accent);
}

} // namespace millwright::widgets
