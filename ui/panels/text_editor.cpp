#include "ui/panels/text_editor.h"

#include "core/base/error.h"
#include "core/base/sentences.h"
#include "ui/widgets/icons.h"

#include <fmt/format.h>

#include <algorithm>
#include <utility>

namespace millwright::panels {

namespace {

namespace icons = widgets::icons;
using widgets::Permission;

std::string fault_of(const std::vector<Diagnostic>& faults, int line) {
    const auto found = std::ranges::find(faults, line, [](const Diagnostic& one) { return one.place.line; });
    if (found == faults.end()) {
        return {};
    }
    return found->message + (found->hint.empty() ? "" : " (" + found->hint + ")");
}

} // namespace

std::string fault_text(const std::vector<Diagnostic>& faults) {
    const Diagnostic& first = faults.front();
    const std::string more = faults.size() > 1 ? fmt::format(" (and {} more)", faults.size() - 1) : "";
    const std::string place = first.place.line > 0 ? fmt::format("Line {}: ", first.place.line) : "";
    const std::string hint = first.hint.empty() ? "" : " (" + first.hint + ")";
    return with_full_stop(place + first.message + hint + more);
}

void fault_line(Ui& ui, const std::vector<Diagnostic>& faults, std::string_view help) {
    if (faults.empty()) {
        ui.words(help, widgets::Tone::muted);
        return;
    }
    const std::string whole = fault_text(faults);
    if (ui.words_width(whole) <= ui.rest().w) {
        ui.words(whole, widgets::Tone::danger);
    } else {
        ui.text(whole, widgets::Tone::danger);
    }
}

void TextEditor::draw_find_button(Ui& ui) {
    if (ui.button("find_replace",
                  "Find",
                  {},
                  {icons::search,
                   finds_ ? widgets::Rank::primary : widgets::Rank::normal,
                   -1.0F,
                   "Find and replace (Ctrl+F)"})) {
        finds_ = !finds_;
        calls_ = finds_;
    }
}

void TextEditor::draw(Ui& ui,
                      const FrameState& now,
                      ActionQueue& ask,
                      const std::vector<Diagnostic>& faults) {
    follow(now, ask);
    if (finds_) {
        draw_find(ui, ask);
    }
    draw_area(ui, now, ask, faults);
}

/// What was found is no longer there in another text.
void TextEditor::follow(const FrameState& now, ActionQueue& ask) {
    const std::string& text = edited_.shown(now.project);
    if (text != text_) {
        text_ = text;
        found_.reset();
        caret_ = std::min(caret_, text_.size());
    }
    const actions::FileView& file = now.view_state.file;
    if (file.find_wanted) {
        finds_ = calls_ = true;
        ask.show([](actions::ViewState& view_state) { view_state.file.find_wanted = false; });
    }
    if (file.find_next != 0) {
        if (wanted_.empty()) {
            finds_ = calls_ = true;
        } else {
            go_on(file.find_next);
        }
        ask.show([](actions::ViewState& view_state) { view_state.file.find_next = 0; });
    }
}

void TextEditor::draw_find(Ui& ui, ActionQueue& ask) {
    constexpr float buttons = 372.0F;
    const float field = std::max(0.5F * (ui.rest().w - ui.px(buttons)), ui.px(120.0F));
    const auto scope = ui.scope("find");
    {
        const auto width = ui.width(field);
        const auto labels = ui.label_share(0.26F);
        if (std::exchange(calls_, false)) {
            ui.focus_field(ui.path("wanted"));
        }
        if (const auto text =
                ui.search_field("wanted", "Find", wanted_, "Search text; Enter finds the next match")) {
            if (*text != wanted_) {
                wanted_ = *text;
                found_.reset();
            }
            news_.clear();
            if (!wanted_.empty()) {
                go_on(1);
            }
        }
        ui.beside();
        if (const auto text = ui.text_field("replacement", "With", replacement_, "Replacement text")) {
            replacement_ = *text;
        }
    }
    draw_find_buttons(ui, ask);
}

void TextEditor::draw_find_buttons(Ui& ui, ActionQueue& ask) {
    const Permission can = wanted_.empty() ? Permission::refused("Enter a search text first.") : Permission{};
    const auto toggle = [&](const char* id, const char* label, bool& on, const char* tip) {
        ui.beside();
        const auto width = ui.width(ui.px(44.0F));
        if (ui.button(id, label, {}, {{}, on ? widgets::Rank::primary : widgets::Rank::normal, -1.0F, tip})) {
            on = !on;
            found_.reset();
        }
    };
    toggle("same_case", "Aa", matching_.same_case, "Match case");
    toggle("whole_words", "ab", matching_.whole_words, "Match whole words");
    ui.beside();
    if (ui.icon_button("previous", icons::chevron_up, "Previous match (Ctrl+Shift+G)", can)) {
        go_on(-1);
    }
    ui.beside();
    if (ui.icon_button("next", icons::chevron_down, "Next match (Ctrl+G)", can)) {
        go_on(1);
    }
    {
        const auto width = ui.width(ui.px(74.0F));
        ui.beside();
        if (ui.button(
                "replace",
                "Replace",
                can,
                {{}, widgets::Rank::normal, -1.0F, "Replace the current match and go to the next one"})) {
            replace_one(ask);
        }
    }
    {
        const auto width = ui.width(ui.px(44.0F));
        ui.beside();
        if (ui.button("replace_all", "All", can, {{}, widgets::Rank::normal, -1.0F, "Replace all matches"})) {
            replace_all(ask);
        }
    }
    ui.beside();
    ui.words(count_text(), widgets::Tone::muted);
}

std::string TextEditor::count_text() const {
    if (wanted_.empty() || !news_.empty()) {
        return news_;
    }
    TextCount count(text_, pattern());
    count.advance(text_.size());
    return fmt::format("{} found", count.count());
}

void TextEditor::draw_area(Ui& ui,
                           const FrameState& now,
                           ActionQueue& ask,
                           const std::vector<Diagnostic>& faults) {
    widgets::TextAreaView view;
    view.text = text_;
    view.fault = [&](int line) { return fault_of(faults, line); };
    if (finds_ && found_) {
        view.marked = widgets::TextRange{*found_, *found_ + wanted_.size()};
        view.follow_marked = std::exchange(shows_, false);
    }
    const widgets::TextAreaAnswer answer = widgets::text_area(ui, "text", view);
    if (answer.caret) {
        caret_ = *answer.caret;
    }
    if (answer.begins_step) {
        ask.end_step();
    }
    if (answer.text) {
        news_.clear();
        put(ask, *answer.text);
    }
    if (answer.left) {
        ask.end_step();
    }
    // What else was changed in the project is not taken back from within the text, where the change is not
    // visible.
    if (answer.history < 0 && now.undo_title == edited_.title) {
        ask.run("edit.undo");
    } else if (answer.history > 0 && now.redo_title == edited_.title) {
        ask.run("edit.redo");
    }
}

/// From the place that is shown, else from the caret; around the end of the text.
void TextEditor::go_on(int direction) {
    const TextPattern what = pattern();
    finds_ = true;
    if (direction > 0) {
        found_ = what.next(text_, found_ ? *found_ + 1 : caret_);
        found_ = found_ ? found_ : what.next(text_, 0);
    } else {
        found_ = what.previous(text_, found_.value_or(caret_));
        found_ = found_ ? found_ : what.previous(text_, text_.size());
    }
    shows_ = found_.has_value();
}

/// The first press shows the place, the second one replaces it: nothing changes that has not been seen.
void TextEditor::replace_one(ActionQueue& ask) {
    news_.clear();
    if (!found_) {
        go_on(1);
        return;
    }
    const std::size_t at = *found_;
    std::string text = text_;
    text.replace(at, wanted_.size(), replacement_);
    ask.end_step();
    put(ask, text);
    ask.end_step();
    text_ = std::move(text); // so that the next place is looked for in it
    caret_ = at + replacement_.size();
    found_.reset();
    if (const auto next = pattern().next(text_, caret_)) {
        found_ = next;
        shows_ = true;
    }
}

void TextEditor::replace_all(ActionQueue& ask) {
    ReplacedText all = replaced_everywhere(text_, pattern(), replacement_);
    news_ = fmt::format("{} replaced", all.count);
    if (all.count > 0) {
        ask.end_step();
        put(ask, std::move(all.text));
        ask.end_step();
    }
}

void TextEditor::put(ActionQueue& ask, std::string text) {
    ask.edit(
        edited_.title,
        [where = edited_.draft, text = std::move(text)](project::Project& draft) { where(draft) = text; },
        edited_.merge_key);
}

} // namespace millwright::panels
