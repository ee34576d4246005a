#include "ui/toolpath_panels/listing_panel.h"

#include "ui/panels/lines.h"
#include "ui/widgets/icons.h"
#include "ui/widgets/listing.h"

#include <fmt/format.h>

#include <algorithm>
#include <limits>

namespace millwright::panels {

namespace {

namespace icons = widgets::icons;
using widgets::Permission;

constexpr std::size_t bytes_per_frame = std::size_t{2} << 20U; // to count in: 2 to 4 ms
constexpr std::size_t most_shown = 2000;                       // characters of a line

std::string shown_part(std::string_view line) {
    std::string shown(line.substr(0, most_shown));
    if (line.size() > most_shown) {
        shown += "\u2026";
    }
    return shown;
}

} // namespace

/// Holds on to what the lines belong to, so that an index never outlives its text.
void ListingPanel::follow(const FrameState& now) {
    std::shared_ptr<const void> text;
    if (now.in_file()) {
        text = now.opened->text;
    } else {
        text = now.listing();
    }
    if (now.in_file() && faulty_ != now.opened) {
        faulty_ = now.opened;
        faults_ = now.opened->errors_by_line();
    } else if (!now.in_file()) {
        faulty_.reset();
        faults_.clear();
    }
    if (text == shown_ && (text == nullptr) == (lines_ == nullptr)) {
        return;
    }
    found_.reset();
    count_.reset();
    lines_ = nullptr;
    if (text && now.in_file()) {
        lines_ = &now.opened->text->lines();
    } else if (text) {
        own_ = gcode::LineIndex(now.listing()->text);
        lines_ = &own_;
    }
    shown_ = std::move(text);
    if (lines_ != nullptr && !wanted_.empty()) {
        count_.emplace(lines_->text(), TextPattern(wanted_));
    }
}

void ListingPanel::draw(Ui& ui, const FrameState& now, ActionQueue& ask) {
    follow(now);
    if (lines_ != nullptr) {
        draw_search(ui, now, ask);
        ui.gap();
    }
    draw_lines(ui, now, ask);
}

void ListingPanel::draw_search(Ui& ui, const FrameState& now, ActionQueue& ask) {
    // of the width: beside it stands how many places were found
    const float line_share = wanted_.empty() ? 1.0F : 0.66F;
    constexpr float buttons = 76.0F;
    const float whole = ui.rest().w;
    const float label = 0.15F * whole;
    {
        const auto width = ui.width(whole - ui.px(buttons));
        const auto labels = ui.label_share(label / (whole - ui.px(buttons)));
        if (now.view_state.file.find_wanted) {
            ui.focus_field(ui.path("find"));
            ask.show([](actions::ViewState& view_state) { view_state.file.find_wanted = false; });
        }
        if (const auto text =
                ui.search_field("find", "Find", wanted_, "Search text; Enter finds the next match")) {
            *text == wanted_ && !wanted_.empty() ? go_on(1, now, ask) : look_for(*text, now, ask);
        }
    }
    const Permission can = wanted_.empty() ? Permission::refused("Enter a search text first.") : Permission{};
    ui.beside();
    if (ui.icon_button("previous", icons::chevron_up, "Previous match (Ctrl+Shift+G)", can)) {
        go_on(-1, now, ask);
    }
    ui.beside();
    if (ui.icon_button("next", icons::chevron_down, "Next match (Ctrl+G)", can)) {
        go_on(1, now, ask);
    }
    if (now.view_state.file.find_next != 0) {
        if (can.allowed) {
            go_on(now.view_state.file.find_next, now, ask);
        }
        ask.show([](actions::ViewState& view_state) { view_state.file.find_next = 0; });
    }
    if (count_ && !count_->done()) {
        count_->advance(bytes_per_frame);
        ui.change_in(0.0);
    }
    const std::string of_all = fmt::format("of {}", lines_->count());
    const widgets::FieldInfo line{"line",
                                  "Line",
                                  wanted_.empty() ? std::string_view(of_all) : std::string_view(),
                                  "Go to line",
                                  1.0,
                                  static_cast<double>(std::max<std::ptrdiff_t>(lines_->count(), 1)),
                                  std::numeric_limits<double>::quiet_NaN(),
                                  0};
    {
        const auto width = ui.width(whole * line_share);
        const auto labels = ui.label_share(label / (whole * line_share));
        const auto at = static_cast<int>(std::max<std::ptrdiff_t>(current_line(now), 0)) + 1;
        if (const auto chosen = ui.integer(at, line)) {
            go_to_line(now, ask, *chosen - 1);
        }
    }
    if (!wanted_.empty()) {
        ui.beside();
        ui.words(count_text(), widgets::Tone::muted);
    }
}

std::string ListingPanel::count_text() const {
    if (!count_) {
        return {};
    }
    const std::string count = fmt::format("{} found", count_->count());
    return count_->done() ? count : count + " \u2026";
}

void ListingPanel::look_for(const std::string& wanted, const FrameState& now, ActionQueue& ask) {
    wanted_ = wanted;
    found_.reset();
    count_.reset();
    if (!wanted_.empty()) {
        count_.emplace(lines_->text(), TextPattern(wanted_));
        go_on(1, now, ask);
    }
}

/// From the hit that is shown, else from the current line; around the end of the text.
void ListingPanel::go_on(int direction, const FrameState& now, ActionQueue& ask) {
    const TextPattern pattern(wanted_);
    const std::string_view text = lines_->text();
    const std::ptrdiff_t current = std::max<std::ptrdiff_t>(current_line(now), 0);
    std::size_t from = current < lines_->count() ? lines_->begin_of(current) : 0;
    if (found_ && lines_->line_at(*found_) == current) {
        from = *found_ + (direction > 0 ? 1 : 0);
    }
    found_ = direction > 0 ? pattern.next(text, from) : pattern.previous(text, from);
    if (!found_) {
        found_ = direction > 0 ? pattern.next(text, 0) : pattern.previous(text, text.size());
    }
    if (found_) {
        go_to_line(now, ask, lines_->line_at(*found_));
    }
}

void ListingPanel::draw_lines(Ui& ui, const FrameState& now, ActionQueue& ask) {
    follow(now);
    if (lines_ == nullptr) {
        ui.note(now.in_file() ? "Opening the file \u2026"
                              : "No program is open. Open a G-code file (Ctrl+O) or drop one on the window.");
        return;
    }
    widgets::ListingView view;
    view.lines = lines_->count();
    view.line = [this](std::ptrdiff_t line) { return shown_part(lines_->line(line)); };
    view.current = current_line(now);
    view.found = wanted_;
    view.wanted = found_ ? lines_->line_at(*found_) : -1;
    view.fault = [this](std::ptrdiff_t line) -> std::optional<widgets::LineFault> {
        const auto fault = faults_.find(static_cast<int>(line) + 1);
        return fault == faults_.end()
                   ? std::nullopt
                   : std::optional(widgets::LineFault{fault->second->place.column, fault->second->message});
    };
    if (const auto line = widgets::listing(ui, "listing", view)) {
        go_to_line(now, ask, *line);
    }
}

} // namespace millwright::panels
