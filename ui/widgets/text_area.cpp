#include "ui/widgets/text_area.h"

#include "ui/widgets/internal/draw.h"
#include "ui/widgets/internal/state.h"

#include <imgui_stdlib.h>

#include <algorithm>
#include <string>

namespace millwright::widgets {

namespace {

/// What ImGui's own copy of the text is given, and reports, while it is being written.
struct Writing {
    std::optional<std::string_view> given; ///< takes the place of what ImGui has
    int caret = -1;                        ///< byte offset
    int line = -1;                         ///< of the caret, from 0
};

int on_writing(ImGuiInputTextCallbackData* data) {
    auto& writing = *static_cast<Writing*>(data->UserData);
    if (writing.given) {
        const std::string_view text = *writing.given;
        const TextDifference what = difference({data->Buf, static_cast<std::size_t>(data->BufTextLen)}, text);
        data->DeleteChars(static_cast<int>(what.at), static_cast<int>(what.removed));
        data->InsertChars(
            static_cast<int>(what.at), text.data() + what.at, text.data() + what.at + what.inserted);
        data->CursorPos = static_cast<int>(what.at + what.inserted);
        data->SelectionStart = data->SelectionEnd = data->CursorPos;
    }
    writing.caret = data->CursorPos;
    writing.line = static_cast<int>(std::count(data->Buf, data->Buf + data->CursorPos, '\n'));
    return 0;
}

/// -1: undo, 1: redo.
int history_asked() {
    const ImGuiIO& io = ImGui::GetIO();
    if (!io.KeyCtrl || io.KeyAlt) {
        return 0;
    }
    const auto pressed = [](ImGuiKey key) { return ImGui::IsKeyPressed(ImGui::GetKeyIndex(key)); };
    if (pressed(ImGuiKey_Z)) {
        return io.KeyShift ? 1 : -1;
    }
    return pressed(ImGuiKey_Y) ? 1 : 0;
}

int line_count(std::string_view text) {
    return static_cast<int>(std::ranges::count(text, '\n')) + 1;
}

/// Line numbers at the left, in the danger colour where something is wrong.
void draw_gutter(Ui& ui, const Rect& whole, float gutter, float top, float step, const TextAreaView& view) {
    const ImFont* font = ui.look().fonts.mono;
    const ImGuiIO& io = ImGui::GetIO();
    const int lines = line_count(view.text);
    const int first = std::max(0, static_cast<int>((whole.y - top) / step));
    for (int n = first; n < lines; ++n) {
        const Rect row{whole.x, top + static_cast<float>(n) * step, whole.w, step};
        if (row.y > whole.bottom()) {
            return;
        }
        const std::string fault = view.fault ? view.fault(n + 1) : std::string();
        const Colour colour = fault.empty() ? faded(ui.colours().muted, 0.75) : ui.colours().danger;
        draw_text(ui,
                  font,
                  {row.x, row.y, gutter - ui.px(10.0F), row.h},
                  colour,
                  std::to_string(n + 1),
                  Align::right);
        if (fault.empty()) {
            continue;
        }
        fill({row.x, row.y, ui.px(3.0F), row.h}, ui.colours().danger);
        if (ImGui::IsWindowHovered(ImGuiHoveredFlags_ChildWindows) &&
            row.contains({io.MousePos.x, io.MousePos.y})) {
            offer_tip(ui, ui.path("line_" + std::to_string(n + 1)), row, fault);
        }
    }
}

int line_of(std::string_view text, std::size_t at) {
    return static_cast<int>(std::ranges::count(text.substr(0, at), '\n'));
}

/// Line by line behind the letters, which begin at `left` and `top`.
void draw_marked(Ui& ui, std::string_view text, const TextRange& range, float left, float top, float step) {
    const ImFont* font = ui.look().fonts.mono;
    const std::size_t to = std::min(range.to, text.size());
    std::size_t from = std::min(range.from, to);
    while (from < to) {
        const std::size_t line_begin = from == 0 ? 0 : text.rfind('\n', from - 1) + 1; // npos + 1 is 0
        const std::size_t line_end = std::min(text.find('\n', from), to);
        const float x = left + text_width(font, text.substr(line_begin, from - line_begin));
        const float width = text_width(font, text.substr(from, line_end - from));
        const float y = top + static_cast<float>(line_of(text, from)) * step;
        fill({x, y, std::max(width, ui.px(3.0F)), step}, faded(ui.colours().warning, 0.45), ui.px(2.0F));
        from = line_end + 1;
    }
}

void bring_into_sight(int line, float step, float height) {
    const float top = static_cast<float>(line) * step;
    if (top < ImGui::GetScrollY()) {
        ImGui::SetScrollY(top);
    } else if (top + 2.0F * step > ImGui::GetScrollY() + height) {
        ImGui::SetScrollY(top + 2.0F * step - height);
    }
}

/// Notes what was written in this frame: whether it is a step of its own, and for how long the caret is
/// followed.
void follow_writing(Ui& ui,
                    const std::string& path,
                    std::string_view before,
                    const Writing& writing,
                    TextAreaAnswer& answer) {
    Ui::State::Written& written = ui.state().written;
    if (written.path != path) {
        written = {.path = path, .text = {}, .caret = -1, .steps = {}, .frames_to_follow = 0};
    }
    if (answer.text) {
        answer.begins_step = written.steps.begins(before, *answer.text, written.caret, writing.caret);
    }
    if (writing.given || answer.history != 0) {
        written.steps.end();
    }
    // What a changed text needs of height counts for the scroll bar a frame later.
    const bool moved = writing.caret != written.caret || answer.text || writing.given;
    written.frames_to_follow = moved ? 3 : std::max(0, written.frames_to_follow - 1);
    if (written.frames_to_follow > 0) {
        ui.change_in(0.0);
    }
    written.caret = writing.caret;
    written.text = answer.text ? *answer.text : std::string(before);
}

/// Line numbers, and what is marked.
void draw_behind_text(
    Ui& ui, const Rect& whole, float gutter, float top, float step, const TextAreaView& view) {
    draw_gutter(ui, whole, gutter, top, step, view);
    if (view.marked) {
        draw_marked(ui, view.text, *view.marked, whole.x + gutter, top, step);
        if (view.follow_marked) {
            bring_into_sight(line_of(view.text, view.marked->from), step, whole.h);
            ui.change_in(0.0);
        }
    }
}

/// Whether the text was changed.
bool write_in(const std::string& path, std::string& text, const ImVec2& size, Writing& writing) {
    return ImGui::InputTextMultiline(("##" + path).c_str(),
                                     &text,
                                     size,
                                     ImGuiInputTextFlags_CallbackAlways | ImGuiInputTextFlags_NoUndoRedo,
                                     on_writing,
                                     &writing);
}

} // namespace

TextAreaAnswer text_area(Ui& ui, std::string_view id, const TextAreaView& view) {
    const std::string path = ui.path(id);
    const Slot slot(ui, 0.0F, view.height > 0.0F ? view.height : std::max(ui.rest().h, ui.px(48.0F)));
    const Rect& whole = slot.rect();
    fill(whole, ui.colours().field, ui.px(4.0F));
    const float gutter = ui.px(46.0F);
    TextAreaAnswer answer;
    ImGui::SetCursorScreenPos(upper_left(whole));
    ImGui::PushStyleColor(ImGuiCol_ChildBg, 0U);
    ImGui::PushStyleColor(ImGuiCol_FrameBg, 0U);
    ImGui::PushStyleVar(ImGuiStyleVar_FramePadding, {0.0F, 0.0F});
    ImGui::PushStyleVar(ImGuiStyleVar_WindowPadding, {0.0F, 0.0F});
    ImFont* font = ui.look().fonts.mono;
    ImGui::PushFont(font);
    if (ImGui::BeginChild(path.c_str(), {whole.w, whole.h}, false)) {
        const float step = ImGui::GetTextLineHeight();
        const float needed = step * static_cast<float>(line_count(view.text) + 1);
        const float top = ImGui::GetCursorScreenPos().y;
        draw_behind_text(ui, whole, gutter, top, step, view);
        ImGui::SetCursorScreenPos({whole.x + gutter, top});
        Ui::State::Written& written = ui.state().written;
        const bool known = written.path == path; // it was being written in the last frame
        std::string text(view.text);
        Writing writing;
        if (known && written.text != view.text) {
            writing.given = view.text;
        }
        const ImVec2 size{whole.w - gutter - ui.px(14.0F), std::max(needed, whole.h - 2.0F)};
        const bool changed = write_in(path, text, size, writing);
        answer.left = ImGui::IsItemDeactivated();
        const bool typing = ImGui::IsItemActive();
        // ImGui takes all back that was typed since the field was entered; here it stays.
        const bool taken_back = ImGui::IsKeyPressed(ImGui::GetKeyIndex(ImGuiKey_Escape), false);
        if (changed && !taken_back && text != view.text) {
            answer.text = std::move(text);
        }
        if (typing) {
            answer.history = history_asked();
            follow_writing(ui, path, view.text, writing, answer);
            answer.caret =
                writing.caret < 0 ? std::nullopt : std::optional(static_cast<std::size_t>(writing.caret));
            if (written.frames_to_follow > 0) {
                bring_into_sight(writing.line, step, whole.h);
            }
        } else if (known) {
            written = {};
        }
        outline(whole,
                typing ? ui.colours().accent : ui.colours().line,
                ui.px(4.0F),
                typing ? ui.px(1.5F) : 1.0F);
    }
    ImGui::EndChild();
    ImGui::PopFont();
    ImGui::PopStyleVar(2);
    ImGui::PopStyleColor(2);
    record_at(ui, path, whole);
    return answer;
}

} // namespace millwright::widgets
