#include "ui/widgets/notices.h"

#include "ui/widgets/icons.h"
#include "ui/widgets/internal/draw.h"
#include "ui/widgets/internal/imgui_inside.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <utility>

namespace millwright::widgets {

namespace {

constexpr float toast_width = 380.0F;
constexpr std::size_t most_toasts = 5;

struct Sign {
    Colour colour;
    const char* icon;
};

Sign sign(const Palette& colours, Severity severity) {
    switch (severity) {
    case Severity::good:
        return {colours.good, icons::check};
    case Severity::warning:
        return {colours.warning, icons::warning};
    case Severity::danger:
        return {colours.danger, icons::danger};
    case Severity::info:
        break;
    }
    return {colours.accent, icons::info};
}

double shown_for(Severity severity) {
    switch (severity) {
    case Severity::danger:
        return std::numeric_limits<double>::infinity();
    case Severity::warning:
        return 12.0;
    case Severity::info:
    case Severity::good:
        break;
    }
    return 5.0;
}

struct Layout {
    float text_x;
    float text_width;
    float text_height;
    float place_height;
    float height;
};

Layout layout(const Ui& ui, const Notice& notice, float width, bool can_close) {
    const ImFont* font = ui.look().fonts.text;
    const float text_x = ui.px(36.0F);
    const float text_width = std::max(ui.px(40.0F), width - text_x - ui.px(can_close ? 34.0F : 12.0F));
    const auto height_of = [&](const ImFont* with, const std::string& text) {
        const std::string lines = broken_at_blanks(with, text, text_width);
        return text.empty()
                   ? 0.0F
                   : with->CalcTextSizeA(
                             with->FontSize, 1e9F, text_width, lines.data(), lines.data() + lines.size())
                         .y;
    };
    const float text = height_of(font, notice.text);
    const float place = height_of(ui.look().fonts.small, notice.place);
    return {text_x, text_width, text, place, std::ceil(text + place + ui.px(18.0F))};
}

void add_wrapped(const ImFont* font, float x, float y, Colour colour, const std::string& text, float width) {
    if (!text.empty()) {
        const std::string lines = broken_at_blanks(font, text, width);
        ImGui::GetWindowDrawList()->AddText(font,
                                            font->FontSize,
                                            {std::round(x), std::round(y)},
                                            colour,
                                            lines.data(),
                                            lines.data() + lines.size(),
                                            width);
    }
}

/// True when the cross was pressed.
bool draw_notice(Ui& ui, const std::string& path, const Rect& box, const Notice& notice, bool can_close) {
    const Palette& colours = ui.colours();
    const Layout at = layout(ui, notice, box.w, can_close);
    const Sign with = sign(colours, notice.severity);
    const float round = ui.px(gaps::rounding);
    fill(box, mixed(colours.raised, with.colour, 0.1), round);
    outline(box, faded(with.colour, 0.5), round);
    const float top = box.y + ui.px(9.0F);
    const float line = ui.look().fonts.text->FontSize;
    draw_text(
        ui, ui.look().fonts.text, {box.x + ui.px(11.0F), top, ui.px(20.0F), line}, with.colour, with.icon);
    add_wrapped(ui.look().fonts.text, box.x + at.text_x, top, colours.text, notice.text, at.text_width);
    const float place_y = top + at.text_height;
    add_wrapped(
        ui.look().fonts.small, box.x + at.text_x, place_y, colours.muted, notice.place, at.text_width);
    record_at(ui, path, box);
    if (!can_close) {
        return false;
    }
    const float side = ui.px(22.0F);
    const Rect cross{box.right() - side - ui.px(6.0F), box.y + ui.px(6.0F), side, side};
    const Press now = press(ui, path + "/close", cross, {}, "Close");
    const Colour colour = now.hovered ? colours.text : colours.muted;
    draw_text(ui, ui.look().fonts.text, cross, colour, icons::cancel, Align::centre);
    return now.clicked;
}

bool overlap(const Rect& a, const Rect& b) {
    return a.x < b.right() && b.x < a.right() && a.y < b.bottom() && b.y < a.bottom();
}

/// The lower right corner of `area`, or another of the window where nothing of an open dialog is covered.
Rect place_of_stack(const Rect& area, float width, float height, float gap) {
    const auto in_corner = [&](const Rect& of, bool right, bool lower) {
        return Rect{right ? of.right() - width - gap : of.x + gap,
                    lower ? of.bottom() - height - gap : of.y + gap,
                    width,
                    height};
    };
    const Rect wanted = in_corner(area, true, true);
    const std::optional<Rect> dialog = dialog_place();
    if (!dialog || !overlap(wanted, *dialog)) {
        return wanted;
    }
    const ImVec2 display = ImGui::GetIO().DisplaySize;
    const Rect window{0.0F, 0.0F, display.x, display.y};
    for (const bool lower : {true, false}) {
        for (const bool right : {true, false}) {
            const Rect place = in_corner(window, right, lower);
            if (!overlap(place, *dialog)) {
                return place;
            }
        }
    }
    return in_corner(window, true, true);
}

} // namespace

bool banner(Ui& ui, std::string_view id, const Notice& notice, bool can_close) {
    const float width = ui.rest().w;
    const Slot slot(ui, width, layout(ui, notice, width, can_close).height);
    return draw_notice(ui, ui.path(id), slot.rect(), notice, can_close);
}

float banner_height(const Ui& ui, const Notice& notice, float width) {
    return layout(ui, notice, width, false).height;
}

void Toasts::push(Notice notice) {
    const auto same = std::find_if(shown_.begin(), shown_.end(), [&](const Shown& shown) {
        return shown.notice.text == notice.text && shown.notice.place == notice.place;
    });
    if (same != shown_.end()) {
        same->notice.severity = notice.severity;
        same->until = -1.0;
        return;
    }
    shown_.push_back({std::move(notice), ++last_number_});
    if (shown_.size() > most_toasts) {
        const auto leaving = std::find_if(shown_.begin(), shown_.end(), [](const Shown& shown) {
            return shown.notice.severity != Severity::danger;
        });
        shown_.erase(leaving == shown_.end() ? shown_.begin() : leaving);
    }
}

void Toasts::forget_passing() {
    std::erase_if(shown_, [](const Shown& shown) { return shown.notice.passing; });
}

void Toasts::draw(Ui& ui, std::string_view id, const Rect& area) {
    const double now = ImGui::GetTime();
    for (Shown& shown : shown_) {
        shown.until = shown.until < 0.0 ? now + shown_for(shown.notice.severity) : shown.until;
    }
    std::erase_if(shown_, [now](const Shown& shown) { return shown.until <= now; });
    const auto scope = ui.scope(id);
    const float gap = ui.px(gaps::small);
    const float width = std::min(ui.px(toast_width), area.w - 2.0F * gap);
    float whole = -gap;
    for (const Shown& shown : shown_) {
        whole += layout(ui, shown.notice, width, true).height + gap;
    }
    const Rect stack = place_of_stack(area, width, whole, gap);
    float bottom = stack.bottom();
    int closed = 0;
    for (auto shown = shown_.rbegin(); shown != shown_.rend(); ++shown) {
        const std::string own = ui.path(std::to_string(shown->number));
        const float height = layout(ui, shown->notice, width, true).height;
        const Rect box{stack.x, bottom - height, width, height};
        ImGui::SetNextWindowPos(upper_left(box));
        ImGui::SetNextWindowSize({box.w, box.h});
        ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
        constexpr ImGuiWindowFlags flags = ImGuiWindowFlags_NoDecoration | ImGuiWindowFlags_NoMove |
                                           ImGuiWindowFlags_NoSavedSettings | ImGuiWindowFlags_NoBackground |
                                           ImGuiWindowFlags_NoFocusOnAppearing | ImGuiWindowFlags_NoNav;
        ImGui::Begin(own.c_str(), nullptr, flags);
        closed = draw_notice(ui, own, box, shown->notice, true) ? shown->number : closed;
        ImGui::End();
        ImGui::PopStyleVar();
        if (std::isfinite(shown->until)) {
            ui.change_in(shown->until - now);
        }
        bottom = box.y - gap;
    }
    std::erase_if(shown_, [closed](const Shown& shown) { return shown.number == closed; });
}

} // namespace millwright::widgets
