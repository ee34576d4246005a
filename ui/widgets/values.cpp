#include "core/base/error.h"
#include "core/base/text.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/internal/draw.h"
#include "ui/widgets/ui.h"

#include <algorithm>
#include <cmath>

namespace millwright::widgets {

namespace {

void wrapped(const Ui& ui, std::string_view text, Colour colour) {
    ImGui::PushFont(ui.look().fonts.text);
    ImGui::PushStyleColor(ImGuiCol_Text, colour);
    ImGui::PushTextWrapPos(0.0F);
    if (!text.empty()) {
        const std::string broken =
            broken_at_blanks(ui.look().fonts.text, text, ImGui::GetContentRegionAvail().x);
        ImGui::TextUnformatted(broken.data(), broken.data() + broken.size());
    }
    ImGui::PopTextWrapPos();
    ImGui::PopStyleColor();
    ImGui::PopFont();
}

Colour tone_colour(const Palette& colours, Tone tone) {
    switch (tone) {
    case Tone::muted:
        return colours.muted;
    case Tone::good:
        return colours.good;
    case Tone::warning:
        return colours.warning;
    case Tone::danger:
        return colours.danger;
    case Tone::normal:
        break;
    }
    return colours.text;
}

/// The filled part of a bar; when the fraction is not known, a piece that wanders.
Rect bar_part(Ui& ui, const Rect& bar, double fraction) {
    if (fraction >= 0.0) {
        return {bar.x, bar.y, bar.w * static_cast<float>(std::min(fraction, 1.0)), bar.h};
    }
    constexpr double frame = 1.0 / 30.0;
    constexpr double round_trip = 1.6; // s
    ui.change_in(frame);
    const double phase = std::fmod(ImGui::GetTime(), round_trip) / round_trip;
    const float width = 0.3F * bar.w;
    const float x = bar.x + static_cast<float>(1.0 - std::abs(2.0 * phase - 1.0)) * (bar.w - width);
    return {x, bar.y, width, bar.h};
}

} // namespace

void Ui::heading(std::string_view text) {
    const Slot slot(*this, 0.0F, px(gaps::row));
    draw_text(*this, look_.fonts.strong, slot.rect(), colours().text, text);
}

void Ui::text(std::string_view text, Tone tone) {
    wrapped(*this, text, tone_colour(colours(), tone));
}

void Ui::words(std::string_view text, Tone tone, float most) {
    const float border = state_->scrolls_sideways ? words_width(text) : std::max(rest().w, 1.0F);
    const float width = std::min({words_width(text), border, most > 0.0F ? most : border});
    const Slot slot(*this, width, px(gaps::row));
    if (draw_text(*this, look_.fonts.text, slot.rect(), tone_colour(colours(), tone), text)) {
        offer_tip(*this, path(text), slot.rect(), text);
    }
}

float Ui::words_width(std::string_view text) const {
    return std::ceil(text_width(look_.fonts.text, text)) + 1.0F;
}

void Ui::note(std::string_view text) {
    wrapped(*this, text, colours().muted);
}

void Ui::value(std::string_view id,
               std::string_view label,
               std::string_view text,
               std::string_view unit,
               std::string_view tip) {
    const Slot slot(*this, 0.0F, px(gaps::row - 4.0F));
    const std::string own = path(id);
    const Rect place = labelled(*this, own, slot.rect(), label, tip);
    const float pad = px(7.0F);
    const float unit_width = unit.empty() ? 0.0F : text_width(look_.fonts.text, unit) + px(6.0F);
    const Rect number{place.x + pad, place.y, place.w - 2.0F * pad - unit_width, place.h};
    const bool cut = draw_text(*this, look_.fonts.text, number, colours().text, text, Align::right);
    draw_text(*this,
              look_.fonts.text,
              {number.right(), place.y, unit_width, place.h},
              colours().muted,
              unit,
              Align::right);
    record_at(*this, own, slot.rect());
    offer_tip(*this, own, place, cut ? text : tip);
}

void Ui::value(std::string_view id, double number, const FieldInfo& info) {
    value(id, info.label, std::isfinite(number) ? fixed(number, info.decimals) : "–", info.unit);
}

bool Ui::progress(std::string_view id, std::string_view text, double fraction, const Permission& cancel) {
    const std::string own = path(id);
    const Slot slot(*this, 0.0F, px(gaps::row));
    const Rect& all = slot.rect();
    const float cancel_width = px(76.0F);
    const Rect place{all.x, all.y, all.w - cancel_width - px(gaps::small), all.h};
    // Cut, not rounded: only what is done is at 100 %.
    const std::string percent =
        fraction < 0.0 ? "" : fixed(std::floor(100.0 * std::min(fraction, 1.0)), 0) + " %";
    const float percent_width = px(44.0F);
    const Rect words{place.x, place.y, place.w - percent_width, place.h - px(7.0F)};
    const bool cut = draw_text(*this, look_.fonts.text, words, colours().text, text);
    draw_text(*this,
              look_.fonts.text,
              {words.right(), place.y, percent_width, words.h},
              colours().muted,
              percent,
              Align::right);
    const Rect bar{place.x, place.bottom() - px(5.0F), place.w, px(4.0F)};
    fill(bar, colours().raised, px(2.0F));
    fill(bar_part(*this, bar, fraction), colours().accent, px(2.0F));
    record_at(*this, own, place);
    offer_tip(*this, own, place, cut ? text : std::string_view());

    const Rect button{place.right() + px(gaps::small), all.y, cancel_width, all.h};
    const Press now =
        press(*this, own + "/cancel", button, cancel, "Cancel this operation; the project is not changed.");
    fill(button, now.hovered ? colours().hover : colours().raised, px(gaps::rounding));
    draw_text(*this,
              look_.fonts.text,
              button,
              faded(colours().text, now.enabled ? 1.0 : 0.45),
              "Cancel",
              Align::centre);
    return now.clicked;
}

} // namespace millwright::widgets
