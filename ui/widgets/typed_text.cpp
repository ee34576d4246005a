#include "ui/widgets/typed_text.h"

#include "ui/widgets/internal/edit.h"
#include "ui/widgets/internal/state.h"
#include "ui/widgets/matching.h"
#include "ui/widgets/ui.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace millwright::widgets {

std::optional<std::string> typed_text(Ui& ui, std::string_view id) {
    const Ui::State::Edit& edit = ui.state().edit;
    return edit.path == ui.path(id) && !edit.called ? std::optional(edit.text) : std::nullopt;
}

namespace {

std::optional<std::string> text_row(Ui& ui, std::string_view label, EditBox box) {
    const Slot slot(ui, 0.0F, ui.px(gaps::row));
    const bool enabled = effective(ui, box.permission).allowed;
    box.rect = labelled(ui, box.path, slot.rect(), label, box.tip, enabled);
    const auto committed = edit_box(ui, box);
    return committed && (box.asks_again || *committed != box.shown) ? committed : std::nullopt;
}

/// The line before `text` in time, or after it; behind the newest an empty one.
std::string line_of_history(const std::vector<std::string>& lines, std::string_view text, double steps) {
    const auto at = std::find(lines.begin(), lines.end(), text);
    if (steps > 0.0) {
        return at == lines.begin() ? std::string(text) : *(at - 1);
    }
    return at == lines.end() || at + 1 == lines.end() ? std::string() : *(at + 1);
}

/// Any text is taken.
EditBox text_box(std::string path, std::string_view value, std::string_view tip, const ImFont* font) {
    EditBox box;
    box.path = std::move(path);
    box.shown = value;
    box.tip = tip;
    box.font = font;
    box.refusal = [](std::string_view) { return std::string(); };
    return box;
}

} // namespace

std::optional<std::string> Ui::text_field(std::string_view id,
                                          std::string_view label,
                                          std::string_view value,
                                          std::string_view tip,
                                          const Permission& permission) {
    EditBox box = text_box(path(id), value, tip, look_.fonts.text);
    box.permission = permission;
    return text_row(*this, label, box);
}

std::optional<std::string>
Ui::search_field(std::string_view id, std::string_view label, std::string_view value, std::string_view tip) {
    EditBox box = text_box(path(id), value, tip, look_.fonts.text);
    box.asks_again = true;
    return text_row(*this, label, box);
}

std::optional<std::string> Ui::command_line(std::string_view id,
                                            std::string_view label,
                                            std::span<const std::string> history,
                                            std::string_view tip,
                                            const Permission& permission,
                                            std::span<const std::string_view> words) {
    EditBox box;
    box.path = path(id);
    box.tip = tip;
    box.font = look_.fonts.mono;
    box.completed = [=](std::string_view text) { return completed(text, history, words); };
    box.enter_only = true;
    box.refusal = [&permission](std::string_view) {
        return permission.allowed ? std::string() : permission.reason;
    };
    box.stepped = [lines = std::vector<std::string>(history.begin(), history.end())](
                      std::string_view text, double steps) { return line_of_history(lines, text, steps); };
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
