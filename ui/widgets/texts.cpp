#include "ui/widgets/internal/edit.h"
#include "ui/widgets/ui.h"

namespace millwright::widgets {

namespace {

std::optional<std::string> text_row(Ui& ui, std::string_view label, EditBox box) {
    const Slot slot(ui, 0.0F, ui.px(gaps::row));
    const bool enabled = effective(ui, box.permission).allowed;
    box.rect = labelled(ui, box.path, slot.rect(), label, box.tip, enabled);
    const auto committed = edit_box(ui, box);
    return committed && *committed != box.shown ? committed : std::nullopt;
}

} // namespace

std::optional<std::string> Ui::text_field(std::string_view id,
                                          std::string_view label,
                                          std::string_view value,
                                          std::string_view tip,
                                          const Permission& permission) {
    EditBox box;
    box.path = path(id);
    box.shown = value;
    box.tip = tip;
    box.font = look_.fonts.text;
    box.permission = permission;
    box.refusal = [](std::string_view) { return std::string(); };
    return text_row(*this, label, box);
}

std::optional<std::string> Ui::expression(std::string_view id,
                                          std::string_view label,
                                          std::string_view value,
                                          const TextCheck& check,
                                          std::string_view tip,
                                          const Permission& permission) {
    EditBox box;
    box.path = path(id);
    box.shown = value;
    box.tip = tip;
    box.font = look_.fonts.mono;
    box.permission = permission;
    box.refusal = check;
    box.keeps_refused = true;
    return text_row(*this, label, box);
}

} // namespace millwright::widgets
