#include "core/base/numbers.h"

#include "core/base/error.h"
#include "core/base/text.h"
#include "ui/widgets/arithmetic.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/internal/draw.h"
#include "ui/widgets/internal/edit.h"
#include "ui/widgets/ui.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>
#include <string>

namespace millwright::widgets {

// A number changed by dragging its label sideways: shown while the mouse moves, committed when it is let go.

struct ScrubView {
    std::string path; ///< of the field
    Rect label;
    double value = 0.0;
    double step = 1.0; ///< a few pixels of the mouse; Shift a tenth, Ctrl ten of them
    FieldInfo info;
    Permission permission;
};

struct Scrubbed {
    std::optional<double> shown;     ///< while the label is dragged
    std::optional<double> committed; ///< the mouse was let go; Esc before that leaves the value as it was
};

namespace {

constexpr float pixels_per_step = 4.0F;

/// Kept by path while the label is held.
enum class Stage { idle, dragging, given_up };

double dragged_value(const Ui& ui, const ScrubView& view) {
    const ImGuiIO& io = ImGui::GetIO();
    const double size = io.KeyShift ? 0.1 : io.KeyCtrl ? 10.0 : 1.0;
    const float along = ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0.0F).x;
    const double steps = std::trunc(static_cast<double>(along / ui.px(pixels_per_step)));
    const double whole = std::pow(10.0, view.info.decimals);
    const double wanted = view.value + steps * size * view.step;
    return std::clamp(std::round(wanted * whole) / whole, view.info.min, view.info.max);
}

} // namespace

/// The label's path is the field's with `.label` behind it.
Scrubbed scrub(Ui& ui, const ScrubView& view) {
    const Press now = press(ui, view.path + ".label", view.label, view.permission, {}, Reach::mouse);
    double& kept = ui.state().memory[view.path + "@scrub"];
    const auto stage = static_cast<Stage>(static_cast<int>(kept));
    if (now.hovered || now.held) {
        ImGui::SetMouseCursor(ImGuiMouseCursor_ResizeEW);
    }
    const bool moved =
        std::abs(ImGui::GetMouseDragDelta(ImGuiMouseButton_Left, 0.0F).x) >= ui.px(pixels_per_step);
    const auto keep = [&kept](Stage next) { kept = static_cast<double>(next); };
    if (!now.held) {
        keep(Stage::idle);
        const bool let_go = stage == Stage::dragging && ImGui::IsMouseReleased(ImGuiMouseButton_Left);
        return let_go ? Scrubbed{std::nullopt, dragged_value(ui, view)} : Scrubbed{};
    }
    if (key_pressed(ImGuiKey_Escape)) {
        keep(Stage::given_up);
        return {};
    }
    if (stage == Stage::given_up || (stage == Stage::idle && !moved)) {
        return {};
    }
    keep(Stage::dragging);
    return {dragged_value(ui, view), std::nullopt};
}

namespace {

constexpr std::array<std::string_view, 3> part_names{"x", "y", "z"};
constexpr std::array<std::string_view, 3> part_marks{"X", "Y", "Z"};
constexpr float narrowest_in_a_line = 440.0F; // below that a coordinate of five digits would be cut
constexpr float part_gap = 4.0F;

/// The place of one of the three parts: in equal parts of a line, or below each other.
Rect part_place(const Rect& all, std::size_t part, float gap, bool stacked) {
    const auto i = static_cast<float>(part);
    if (stacked) {
        const float height = (all.h - 2.0F * gap) / 3.0F;
        return {all.x, std::round(all.y + i * (height + gap)), all.w, height};
    }
    const float width = (all.w - 2.0F * gap) / 3.0F;
    const float x = std::round(all.x + i * (width + gap));
    return {x, all.y, std::round(all.x + i * (width + gap) + width) - x, all.h};
}

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

constexpr float reset_width = 20.0F;

/// A button inside the field, before its unit, that puts the default back.
bool reset_button(Ui& ui, const std::string& path, const Rect& field, const FieldInfo& info) {
    const float unit = info.unit.empty() ? 0.0F : text_width(ui.look().fonts.text, info.unit) + ui.px(6.0F);
    const float width = ui.px(reset_width);
    const Rect place{field.right() - ui.px(7.0F) - unit - width, field.y, width, field.h};
    const std::string tip = "Reset to " + fixed(info.default_value, info.decimals) +
                            (info.unit.empty() ? "" : " " + std::string(info.unit));
    const Press now = press(ui, path + ".reset", place, {}, tip, Reach::mouse);
    const Colour colour = now.hovered ? ui.colours().accent : faded(ui.colours().muted, 0.8);
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
    const Rect field = labelled(ui, row.path, slot.rect(), row.label, row.info.tip, enabled);
    const bool can_reset =
        enabled && std::isfinite(row.info.default_value) && !exactly_equal(row.value, row.info.default_value);
    std::optional<double> committed;
    double now = row.value;
    if (!row.label.empty()) {
        const float label_width = field.x - slot.rect().x - ui.px(gaps::small);
        const Scrubbed dragged = scrub(ui,
                                       {.path = row.path,
                                        .label = {slot.rect().x, field.y, label_width, field.h},
                                        .value = row.value,
                                        .step = step_of(row.info),
                                        .info = row.info,
                                        .permission = row.permission});
        committed = dragged.committed;
        now = dragged.shown.value_or(row.value);
    }
    const std::string shown = fixed(now, row.info.decimals);
    EditBox box = number_box(row.info, shown, row.evaluated, row.smallest_step);
    box.path = row.path;
    box.rect = field;
    box.font = ui.look().fonts.text;
    box.permission = row.permission;
    box.room = can_reset ? ui.px(reset_width) : 0.0F;
    if (const auto text = edit_box(ui, box)) {
        committed = row.evaluated(*text, row.info).value;
    }
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
    const std::string own = path(id);
    const bool stacked = rest().w < px(narrowest_in_a_line);
    const Slot slot(*this, 0.0F, stacked ? px(3.0F * gaps::row + 2.0F * part_gap) : px(gaps::row));
    const bool enabled = effective(*this, permission).allowed;
    const Rect first_line{slot.rect().x, slot.rect().y, slot.rect().w, px(gaps::row)};
    const Rect line = labelled(*this, own, first_line, label, info.tip, enabled);
    const Rect all{line.x, line.y, line.w, slot.rect().h};
    record_at(*this, own, all);
    std::optional<std::array<double, 3>> committed;
    for (std::size_t i = 0; i < 3; ++i) {
        expects(std::isfinite(value[i]), "the value of a field is finite: " + own);
        const std::string shown = fixed(value[i], info.decimals);
        EditBox box = number_box(info, shown, evaluate_number, 0.0);
        box.path = own + "/" + std::string(part_names[i]);
        box.rect = part_place(all, i, px(part_gap), stacked);
        box.unit = stacked ? info.unit : std::string_view();
        box.font = look_.fonts.text;
        box.permission = permission;
        box.mark = part_marks[i];
        box.mark_colour = colours().axis[i];
        if (const auto text = edit_box(*this, box)) {
            committed = value;
            (*committed)[i] = *evaluate_number(*text, info).value;
        }
    }
    return committed;
}

} // namespace millwright::widgets
