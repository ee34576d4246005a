#include "ui/widgets/reading.h"

#include "core/base/error.h"
#include "ui/widgets/internal/draw.h"

#include <algorithm>

namespace millwright::widgets {

namespace {

constexpr float first_share = 0.8F; ///< of the first column of a table, against 2 of the others together

bool is_row(const ReadingBlock& block) {
    return block.kind == ReadingKind::row || block.kind == ReadingKind::head_row;
}

void draw_reading_row(Ui& ui, const ReadingBlock& row, int columns) {
    ImGui::TableNextRow();
    for (int n = 0; n < columns; ++n) {
        ImGui::TableSetColumnIndex(n);
        const auto at = static_cast<std::size_t>(n);
        const std::string_view cell = at < row.cells.size() ? std::string_view(row.cells[at]) : "";
        if (row.kind == ReadingKind::head_row) {
            ui.note(cell);
        } else {
            ui.text(cell);
        }
    }
}

void draw_table(Ui& ui, std::span<const ReadingBlock> rows, int number) {
    std::size_t columns = 0;
    for (const ReadingBlock& row : rows) {
        columns = std::max(columns, row.cells.size());
    }
    const int count = static_cast<int>(columns);
    constexpr ImGuiTableFlags flags = ImGuiTableFlags_BordersInnerH | ImGuiTableFlags_SizingStretchProp;
    if (count > 0 && ImGui::BeginTable(("rows " + std::to_string(number)).c_str(), count, flags)) {
        for (int n = 0; n < count; ++n) {
            const float share = n == 0 ? first_share : 2.0F / static_cast<float>(std::max(count - 1, 1));
            ImGui::TableSetupColumn("", ImGuiTableColumnFlags_WidthStretch, share);
        }
        for (const ReadingBlock& row : rows) {
            draw_reading_row(ui, row, count);
        }
        ImGui::EndTable();
    }
    ui.gap();
}

void draw_list_item(Ui& ui, std::string_view text) {
    const float indent = ui.px(14.0F);
    const float y = ImGui::GetCursorScreenPos().y;
    draw_text(ui,
              ui.look().fonts.text,
              {ImGui::GetCursorScreenPos().x, y, indent, ImGui::GetTextLineHeight()},
              ui.colours().muted,
              "\u2013");
    ImGui::Indent(indent);
    ui.text(text);
    ImGui::Unindent(indent);
}

void draw_block(Ui& ui, const ReadingBlock& block) {
    expects(block.cells.size() == 1, "a block other than a table row has one text");
    const std::string& text = block.cells.front();
    switch (block.kind) {
    case ReadingKind::heading:
        ui.gap();
        ui.heading(text);
        break;
    case ReadingKind::item:
        draw_list_item(ui, text);
        break;
    case ReadingKind::code:
        ImGui::PushFont(ui.look().fonts.mono);
        ImGui::PushStyleColor(ImGuiCol_Text, ui.colours().accent);
        ImGui::TextWrapped("%s", text.c_str());
        ImGui::PopStyleColor();
        ImGui::PopFont();
        ui.gap();
        break;
    default:
        ui.text(text);
        ui.gap();
    }
}

void draw_all(Ui& ui, std::span<const ReadingBlock> blocks) {
    for (std::size_t n = 0; n < blocks.size();) {
        std::size_t end = n;
        while (end < blocks.size() && is_row(blocks[end]) &&
               (end == n || blocks[end].kind != ReadingKind::head_row)) {
            ++end;
        }
        if (end > n) {
            draw_table(ui, blocks.subspan(n, end - n), static_cast<int>(n));
            n = end;
        } else {
            draw_block(ui, blocks[n++]);
        }
    }
}

/// Arrows and page keys, where no field has the keyboard.
void scroll_by_keys(const Ui& ui) {
    const float page = ImGui::GetWindowHeight() - ui.px(gaps::row);
    float way = 0.0F;
    way += key_pressed(ImGuiKey_PageDown) ? page : 0.0F;
    way -= key_pressed(ImGuiKey_PageUp) ? page : 0.0F;
    way += key_pressed(ImGuiKey_DownArrow) ? ui.px(gaps::row) : 0.0F;
    way -= key_pressed(ImGuiKey_UpArrow) ? ui.px(gaps::row) : 0.0F;
    if (way < 0.0F || way > 0.0F) {
        ImGui::SetScrollY(ImGui::GetScrollY() + way);
    }
}

} // namespace

void reading(
    Ui& ui, std::string_view id, std::string_view page, std::span<const ReadingBlock> blocks, float height) {
    const std::string path = ui.path(id);
    {
        const Slot slot(ui, 0.0F, height);
        ui.record(id, slot.rect());
        ImGui::SetCursorScreenPos(upper_left(slot.rect()));
        // A child of its own for each page: every one keeps where it was scrolled to.
        const std::string child = path + "/" + std::string(page);
        if (ImGui::BeginChild(child.c_str(), {slot.rect().w, slot.rect().h}, false)) {
            scroll_by_keys(ui);
            draw_all(ui, blocks);
        }
        ImGui::EndChild();
    }
}

} // namespace millwright::widgets
