#include "core/base/numbers.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "ui/widgets/arithmetic.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/internal/edit.h"
#include "ui/widgets/ui.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace millwright::widgets {

namespace {

using Evaluate = Evaluated (*)(std::string_view, const FieldInfo&);

double step_of(const FieldInfo& info) {
    if (info.step > 0.0) {
        return info.step;
    }
    return info.decimals > 0 ? 0.1 : 1.0;
}

/// What the arrow keys make of the text: unreadable text stays, the range is kept.
std::string stepped_text(std::string_view text, double steps, const FieldInfo& info, double smallest) {
    const Evaluated now = evaluate(text, info.unit);
    if (!now.value) {
        return std::string(text);
    }
    const double step = steps * std::max(std::abs(step_of(info)), smallest / std::min(1.0, std::abs(steps)));
    return fixed(std::clamp(*now.value + step, info.min, info.max), info.decimals);
}

EditBox number_box(const FieldInfo& info, std::string_view shown, Evaluate evaluated, double smallest) {
    EditBox box;
    box.shown = shown;
    box.unit = info.unit;
    box.tip = info.tip;
    box.refusal = [evaluated, info](std::string_view text) { return evaluated(text, info).reason; };
    box.stepped = [info, smallest](std::string_view text, double steps) {
        return stepped_text(text, steps, info, smallest);
    };
    return box;
}

/// A button that puts the default back; drawn at the right of the label when the value is another.
bool reset_button(Ui& ui, const std::string& path, const Rect& field, const FieldInfo& info) {
    const float side = ui.px(18.0F);
    const Rect place{field.x - side - ui.px(4.0F), std::round(field.y + 0.5F * (field.h - side)), side, side};
    const std::string tip = "Back to " + fixed(info.default_value, info.decimals) +
                            (info.unit.empty() ? "" : " " + std::string(info.unit));
    const Press now = press(ui, path + ".reset", place, {}, tip);
    const Colour colour = now.hovered ? ui.colours().accent : faded(ui.colours().muted, 0.7);
    draw_text(ui, ui.look().fonts.small, place, colour, icons::reset, Align::centre);
    return now.clicked;
}

struct NumberRow {
    std::string path;
    std::string_view label;
    double value = 0.0;
    FieldInfo info;
    Permission permission;
    Evaluate evaluated = nullptr;
    double smallest_step = 0.0;
};

std::optional<double> number_row(Ui& ui, const NumberRow& row) {
    expects(std::isfinite(row.value), "the value of a field is finite: " + row.path);
    const Slot slot(ui, 0.0F, ui.px(gaps::row));
    const bool enabled = effective(ui, row.permission).allowed;
    Rect label_place = slot.rect();
    const Rect field = labelled(ui, row.path, label_place, row.label, row.info.tip, enabled);
    const std::string shown = fixed(row.value, row.info.decimals);
    EditBox box = number_box(row.info, shown, row.evaluated, row.smallest_step);
    box.path = row.path;
    box.rect = field;
    box.font = ui.look().fonts.text;
    box.permission = row.permission;
    std::optional<double> committed;
    if (const auto text = edit_box(ui, box)) {
        committed = row.evaluated(*text, row.info).value;
    }
    const bool can_reset = !row.label.empty() && enabled && std::isfinite(row.info.default_value) &&
                           !exactly_equal(row.value, row.info.default_value);
    if (can_reset && reset_button(ui, row.path, field, row.info)) {
        committed = row.info.default_value;
    }
    return committed && !exactly_equal(*committed, row.value) ? committed : std::nullopt;
}

} // namespace

std::optional<double> Ui::number(std::string_view id,
                                 std::string_view label,
                                 double value,
                                 const FieldInfo& info,
                                 const Permission& permission) {
    return number_row(*this, {path(id), label, value, info, permission, evaluate_number, 0.0});
}

std::optional<double> Ui::number(double value, const FieldInfo& info, const Permission& permission) {
    return number(info.id, info.label, value, info, permission);
}

std::optional<int> Ui::integer(std::string_view id,
                               std::string_view label,
                               int value,
                               const FieldInfo& info,
                               const Permission& permission) {
    FieldInfo whole = info;
    whole.decimals = 0;
    whole.min = std::max(info.min, static_cast<double>(std::numeric_limits<int>::min()));
    whole.max = std::min(info.max, static_cast<double>(std::numeric_limits<int>::max()));
    const auto committed = number_row(
        *this, {path(id), label, static_cast<double>(value), whole, permission, evaluate_integer, 1.0});
    return committed ? std::optional(static_cast<int>(*committed)) : std::nullopt;
}

std::optional<int> Ui::integer(int value, const FieldInfo& info, const Permission& permission) {
    return integer(info.id, info.label, value, info, permission);
}

std::optional<std::array<double, 3>> Ui::vec3(std::string_view id,
                                              std::string_view label,
                                              const std::array<double, 3>& value,
                                              const FieldInfo& info,
                                              const Permission& permission) {
    const Slot slot(*this, 0.0F, px(gaps::row));
    const std::string own = path(id);
    const Rect all = labelled(*this, own, slot.rect(), label, info.tip, effective(*this, permission).allowed);
    record_at(*this, own, all);
    std::optional<std::array<double, 3>> committed;
    const float gap = px(gaps::tiny);
    const float width = (all.w - 2.0F * gap) / 3.0F;
    for (std::size_t i = 0; i < 3; ++i) {
        expects(std::isfinite(value[i]), "the value of a field is finite: " + own);
        const std::string shown = fixed(value[i], info.decimals);
        EditBox box = number_box(info, shown, evaluate_number, 0.0);
        const float x = std::round(all.x + static_cast<float>(i) * (width + gap));
        const float right = std::round(all.x + static_cast<float>(i) * (width + gap) + width);
        constexpr std::array<std::string_view, 3> names{"x", "y", "z"};
        constexpr std::array<std::string_view, 3> marks{"X", "Y", "Z"};
        box.path = own + "/" + std::string(names[i]);
        box.rect = {x, all.y, right - x, all.h};
        box.unit = {};
        box.font = look_.fonts.text;
        box.permission = permission;
        box.mark = marks[i];
        box.mark_colour = colours().axis[i];
        if (const auto text = edit_box(*this, box)) {
            committed = value;
            (*committed)[i] = *evaluate_number(*text, info).value;
        }
    }
    return committed;
}

} // namespace millwright::widgets
