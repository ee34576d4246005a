#include "ui/widgets/timeline.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/internal/curve.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace millwright::widgets {

namespace {

using Kind = TimelineAsk::Kind;

constexpr float least_track = 32.0F;
constexpr std::array<double, 8> speeds{0.1, 0.25, 0.5, 1.0, 2.0, 5.0, 20.0, 100.0};
constexpr std::array<std::string_view, 8> speed_ids{"0.1", "0.25", "0.5", "1", "2", "5", "20", "100"};

std::string speed_text(double speed) {
    return fmt::format("× {:g}", speed);
}

constexpr float speed_width = 78.0F;

std::optional<TimelineAsk> speed_choice(Ui& ui, double now) {
    std::array<std::string, speeds.size()> labels;
    std::vector<Option> options;
    for (std::size_t i = 0; i < speeds.size(); ++i) {
        labels[i] = speed_text(speeds[i]);
        options.push_back({.id = speed_ids[i], .label = labels[i]});
    }
    const auto known =
        std::find_if(speeds.begin(), speeds.end(), [now](double s) { return std::abs(s - now) < 1e-9 * s; });
    const std::string own = known == speeds.end() ? speed_text(now) : std::string();
    int index = static_cast<int>(known - speeds.begin());
    if (known == speeds.end()) {
        options.push_back({.id = "now", .label = own});
    }
    const auto width = ui.width(ui.px(speed_width));
    const auto chosen = ui.choice("speed", "", index, options, "Playback speed, as a factor of real time.");
    if (!chosen || *chosen >= std::ssize(speeds)) {
        return std::nullopt;
    }
    return TimelineAsk{Kind::speed, speeds[static_cast<std::size_t>(*chosen)]};
}

std::optional<TimelineAsk> transport(Ui& ui, const TimelineView& view) {
    std::optional<TimelineAsk> ask;
    const auto button = [&](std::string_view id, std::string_view icon, std::string_view tip, Kind kind) {
        if (ui.icon_button(id, icon, tip, view.permission, kind == Kind::pause)) {
            ask = TimelineAsk{kind, 0.0};
        }
        ui.beside();
    };
    button("first", icons::skip_first, "Go to the start", Kind::first);
    button("back", icons::step_back, "Previous block", Kind::back);
    if (view.is_playing) {
        button("play", icons::pause, "Pause", Kind::pause);
    } else {
        button("play", icons::play, "Play", Kind::play);
    }
    button("step", icons::step_forward, "Next block", Kind::step);
    button("last", icons::skip_last, "Go to the end", Kind::last);
    return ask;
}

/// Words of a fixed width, so that what stands beside them does not move while the numbers run.
void fixed_words(Ui& ui, std::string_view caption, std::string_view text, float width) {
    const Slot slot(ui, width, ui.px(gaps::row));
    const Rect& place = slot.rect();
    const float caption_width = text_width(ui.look().fonts.text, caption);
    draw_text(ui, ui.look().fonts.text, place, ui.colours().muted, caption);
    const Rect words{place.x + caption_width, place.y, place.w - caption_width, place.h};
    draw_text(ui, ui.look().fonts.text, words, ui.colours().text, text);
}

/// Where there is little room for the choice of the speed behind it, less and less of it is said.
void where(Ui& ui, const TimelineView& view) {
    ui.move_by(ui.px(10.0F), 0.0F);
    const ImFont* font = ui.look().fonts.text;
    const auto width_of = [&](std::string_view text) { return text_width(font, text); };
    const float room = ui.rest().w - ui.px(speed_width);
    const float spaces = 2.0F * ui.px(18.0F + gaps::small);
    const std::string last = std::to_string(view.blocks);
    const std::string end = clock_time(view.total_s);
    const std::string caption = std::string(view.what) + "  ";
    const float least = width_of(last) + width_of(end) + spaces;
    const float with_end = least + width_of(" / " + end);
    const float with_last = with_end + width_of(" / " + last);
    const std::string_view said = room < with_last + width_of(caption) ? "" : std::string_view(caption);
    const std::string of_last = room < with_last ? "" : " / " + last;
    if (room >= least) {
        fixed_words(ui,
                    said,
                    std::to_string(view.block) + of_last,
                    width_of(said) + width_of(last + of_last) + ui.px(18.0F));
        ui.beside();
    }
    const std::string time = clock_time(view.time_s) + (room < with_end ? "" : " / " + end);
    const float time_width = width_of(time) + ui.px(18.0F);
    if (room >= time_width + ui.px(gaps::small)) {
        fixed_words(ui, "", time, time_width);
        ui.beside();
    }
}

Colour timeline_colour(const Palette& colours, std::span<const TimelineSeries> series, std::size_t i) {
    return series[i].colour != 0 ? series[i].colour : colours.series[i % std::size(colours.series)];
}

void draw_track_series(Ui& ui, const Rect& track, std::span<const TimelineSeries> all) {
    for (std::size_t s = 0; s < all.size(); ++s) {
        const std::span<const double> values = all[s].values;
        double high = 0.0;
        for (const double value : values) {
            high = std::isfinite(value) ? std::max(high, value) : high;
        }
        if (!(high > 0.0) || values.size() < 2) {
            continue;
        }
        std::vector<double> x(values.size());
        for (std::size_t i = 0; i < x.size(); ++i) {
            x[i] = static_cast<double>(i) / static_cast<double>(x.size() - 1);
        }
        const Mapping mapping{.box = track, .y_high = 1.1 * high};
        const Colour colour = timeline_colour(ui.colours(), all, s);
        for (const auto& run : runs(mapping, x, values)) {
            if (s == 0) {
                fill_below(run, track.bottom(), faded(colour, 0.3));
            }
            draw_run(run, faded(colour, s == 0 ? 1.0 : 0.8), ui.px(1.2F));
        }
    }
}

std::string track_text(const TimelineView& view, double fraction) {
    std::string text = fmt::format("{:.1f} % of the path", 100.0 * fraction);
    for (const TimelineSeries& series : view.series) {
        if (series.values.empty()) {
            continue;
        }
        const auto last = static_cast<double>(series.values.size() - 1);
        const double value = series.values[static_cast<std::size_t>(std::lround(fraction * last))];
        text += std::isfinite(value) ? fmt::format("\n{}: {:.4g} {}", series.label, value, series.unit)
                                     : fmt::format("\n{}: –", series.label);
    }
    return text;
}

std::optional<TimelineAsk> track(Ui& ui, const TimelineView& view) {
    const float height =
        view.track_height > 0.0F ? view.track_height : std::max(ui.rest().h, ui.px(least_track));
    const Slot slot(ui, 0.0F, height);
    const Rect& box = slot.rect();
    const Palette& colours = ui.colours();
    const std::string own = ui.path("track");
    fill(box, colours.field, ui.px(gaps::rounding));
    const Press now = press(ui, own, box, view.permission);
    ImGui::PushClipRect(upper_left(box), lower_right(box), true);
    draw_track_series(ui, box, view.series);
    const auto at = [&](double fraction) { return box.x + box.w * static_cast<float>(fraction); };
    const double shown = std::clamp(view.fraction, 0.0, 1.0);
    fill({box.x, box.y, at(shown) - box.x, box.h}, faded(colours.accent, 0.12));
    fill({std::round(at(shown)) - ui.px(1.0F), box.y, ui.px(2.0F), box.h}, colours.accent);
    ImGui::PopClipRect();
    const double mouse =
        std::clamp(static_cast<double>((ImGui::GetIO().MousePos.x - box.x) / box.w), 0.0, 1.0);
    if (now.hovered || now.held) {
        fill({std::round(at(mouse)), box.y, 1.0F, box.h}, colours.muted);
        show_at_mouse(ui, own, track_text(view, mouse));
    }
    const bool moves = now.held && std::abs(mouse - view.fraction) > 0.0;
    return moves ? std::optional(TimelineAsk{Kind::scrub, mouse}) : std::nullopt;
}

/// Names the series at the right; without their units where there is little room: the tip on the track has
/// them.
void draw_timeline_key(Ui& ui, std::span<const TimelineSeries> series) {
    const ImFont* font = ui.look().fonts.small;
    const Slot slot(ui, 0.0F, ui.px(gaps::row));
    const float swatch = ui.px(12.0F);
    const float space = ui.px(14.0F);
    std::vector<std::string> words;
    float needed = 0.0F;
    for (const TimelineSeries& one : series) {
        words.push_back(fmt::format("{} ({})", one.label, one.unit));
        needed += text_width(font, words.back()) + swatch + ui.px(5.0F) + space;
    }
    float right = slot.rect().right();
    for (std::size_t i = series.size(); i-- > 0;) {
        const std::string text = needed - space > slot.rect().w ? std::string(series[i].label) : words[i];
        const float width = text_width(font, text);
        const float x = right - width - swatch - ui.px(5.0F);
        if (x < slot.rect().x) {
            break;
        }
        draw_text(ui, font, {right - width, slot.rect().y, width, slot.rect().h}, ui.colours().muted, text);
        const float y = std::round(slot.rect().centre().y) - ui.px(1.5F);
        fill({x, y, swatch, ui.px(3.0F)}, timeline_colour(ui.colours(), series, i), ui.px(1.5F));
        right = x - space;
    }
}

} // namespace

std::optional<TimelineAsk> timeline(Ui& ui, std::string_view id, const TimelineView& view) {
    expects(std::isfinite(view.fraction) && std::isfinite(view.speed), "a timeline has a position");
    const auto scope = ui.scope(id);
    std::optional<TimelineAsk> ask = transport(ui, view);
    where(ui, view);
    if (const auto speed = speed_choice(ui, view.speed)) {
        ask = speed;
    }
    ui.beside();
    draw_timeline_key(ui, view.series);
    if (const auto scrub = track(ui, view)) {
        ask = scrub;
    }
    return ask;
}

} // namespace millwright::widgets
