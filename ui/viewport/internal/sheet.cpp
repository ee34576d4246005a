#include "ui/viewport/internal/sheet.h"

#include "ui/viewport/internal/overlay.h"
#include "ui/widgets/canvas.h"

#include <glm/ext/matrix_transform.hpp>
#include <imgui.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace millwright::viewport {

namespace {

using widgets::Rect;

// Pixels at scale 1.
constexpr float sheet_margin = 16.0F;
constexpr float title_height = 38.0F;
constexpr float row_height = 21.0F;
constexpr float table_pad = 9.0F;
constexpr float below = 36.0F; // scale bar and captions
constexpr float legend_space = 116.0F;
constexpr float part_gap = 2.0F;
constexpr float widest_gap = 56.0F; // between columns

// A picture of this size has words of their usual size; a larger one has larger words, a smaller one the
// same.
constexpr render::PixelSize usual = {1280, 800};
constexpr render::PixelSize smallest_with_words = {480, 320};
// The same for lines and points in a 3D picture, which become thinner too.
constexpr render::PixelSize usual_part = {640, 480};
constexpr double least_line_scale = 0.55;

float sheet_text_width(const ImFont* font, const std::string& text) {
    return font->CalcTextSizeA(font->FontSize, FLT_MAX, 0.0F, text.c_str()).x;
}

void write(const ImFont* font, float x, float y, widgets::Colour colour, const std::string& text) {
    ImGui::GetWindowDrawList()->AddText(
        font, font->FontSize, {std::round(x), std::round(y)}, colour, text.c_str());
}

/// The text without its last parts, which are parted by dots, so that it fits.
std::string fitting(const ImFont* font, std::string text, float width) {
    constexpr std::string_view dot = "  \u00B7  ";
    while (sheet_text_width(font, text) > width && text.rfind(dot) != std::string::npos) {
        text.resize(text.rfind(dot));
    }
    const auto continues = [&] { return (static_cast<unsigned char>(text.back()) & 0xC0U) == 0x80U; };
    while (sheet_text_width(font, text) > width && !text.empty()) {
        while (text.size() > 1 && continues()) { // a character of UTF-8 goes as a whole
            text.pop_back();
        }
        text.pop_back();
    }
    return text;
}

/// How wide each column has to be.
std::vector<float> column_widths(const ImFont* font, const PictureFacts& facts) {
    std::vector<float> widths;
    for (std::size_t k = 0; k < facts.columns.size(); ++k) {
        widths.push_back(sheet_text_width(font, facts.columns[k]));
        for (const auto& row : facts.rows) {
            widths.back() = std::max(widths.back(), sheet_text_width(font, row[k]));
        }
    }
    return widths;
}

void draw_ground(widgets::Ui& ui, const Rect& place, float line_y) {
    ImDrawList& list = *ImGui::GetWindowDrawList();
    list.AddRectFilled({place.x, place.y}, {place.right(), place.bottom()}, ui.colours().pane);
    list.AddLine({place.x, line_y}, {place.right(), line_y}, ui.colours().line, ui.px(1.0F));
}

void draw_table(widgets::Ui& ui, const Rect& place, const PictureFacts& facts) {
    draw_ground(ui, place, place.y);
    const ImFont* font = ui.look().fonts.small;
    const std::vector<float> widths = column_widths(font, facts);
    const float left = place.x + ui.px(sheet_margin);
    const float needed = std::accumulate(widths.begin(), widths.end(), 0.0F);
    const auto gaps = static_cast<float>(std::max<std::ptrdiff_t>(std::ssize(widths) - 1, 1));
    const float gap =
        std::min(ui.px(widest_gap), (place.right() - ui.px(sheet_margin) - left - needed) / gaps);
    float y = place.y + ui.px(table_pad) + 0.5F * (ui.px(row_height) - font->FontSize);
    const auto draw_row = [&](const std::vector<std::string>& cells, widgets::Colour colour) {
        float right = left;
        for (std::size_t k = 0; k < cells.size(); ++k) {
            right += widths[k] + (k == 0 ? 0.0F : gap);
            const float x = k == 0 ? left : right - sheet_text_width(font, cells[k]);
            write(font, x, y, colour, cells[k]);
        }
        y += ui.px(row_height);
    };
    draw_row(facts.columns, ui.colours().muted);
    for (const auto& row : facts.rows) {
        draw_row(row, ui.colours().text);
    }
}

void draw_title(widgets::Ui& ui, const Rect& place, const PictureFacts& facts) {
    draw_ground(ui, place, place.bottom());
    const ImFont* strong = ui.look().fonts.strong;
    const ImFont* small = ui.look().fonts.small;
    const float left = place.x + ui.px(sheet_margin);
    const float room = place.right() - ui.px(sheet_margin) - left;
    const std::string title = fitting(strong, facts.title, 0.6F * room);
    const float beside = sheet_text_width(strong, title) + ui.px(sheet_margin);
    const float middle = place.centre().y;
    write(strong, left, middle - 0.5F * strong->FontSize, ui.colours().text, title);
    write(small,
          left + beside,
          middle - 0.5F * small->FontSize + ui.px(0.5F),
          ui.colours().muted,
          fitting(small, facts.subtitle, room - beside));
}

/// How large `width` x `height` is against `full`, by its shorter side.
double shrunk(float width, float height, const render::PixelSize& full) {
    return std::min(static_cast<double>(width) / full.width, static_cast<double>(height) / full.height);
}

/// Divides the room for signs among the 3D pictures, all with as much that is free: before and after are
/// compared at the same size.
void add_parts(Sheet& sheet, int count, float border, float bottom, float left) {
    const Rect& room = sheet.signs;
    const float gap = count > 1 ? part_gap : 0.0F;
    const float each = std::floor((room.w - gap * static_cast<float>(count - 1)) / static_cast<float>(count));
    const float free_width = std::max(each - left - border, 1.0F);
    for (int k = 0; k < count; ++k) {
        const float x = room.x + static_cast<float>(k) * (each + gap);
        const Rect place = {x, room.y, k + 1 == count ? room.right() - x : each, room.h};
        const float free_x = k == 0 ? x + left : x + 0.5F * (place.w - free_width);
        const float free_height = std::max(room.h - border - bottom, 1.0F);
        sheet.parts.push_back({.place = place, .free = {free_x, room.y + border, free_width, free_height}});
    }
}

} // namespace

render::PixelSize pixel_size(const Rect& rect) {
    return {.width = std::max(static_cast<int>(std::lround(rect.w)), 1),
            .height = std::max(static_cast<int>(std::lround(rect.h)), 1)};
}

Sheet sheet_for(const render::PixelSize& size, int parts, const PictureFacts& facts, bool has_legend) {
    const auto width = static_cast<float>(size.width);
    const auto height = static_cast<float>(size.height);
    Sheet sheet;
    sheet.scale = std::max(1.0, shrunk(width, height, usual));
    sheet.details = size.width >= smallest_with_words.width && size.height >= smallest_with_words.height;
    const auto px = [&](float length) {
        return sheet.details ? std::round(length * static_cast<float>(sheet.scale)) : 0.0F;
    };
    const auto lines = static_cast<float>(facts.rows.empty() ? 0 : std::ssize(facts.rows) + 1);
    const float table = lines > 0.0F ? lines * px(row_height) + 2.0F * px(table_pad) : 0.0F;
    sheet.title = {0.0F, 0.0F, width, px(title_height)};
    sheet.table = {0.0F, height - table, width, table};
    sheet.signs = {0.0F, sheet.title.h, width, height - sheet.title.h - table};
    add_parts(sheet, parts, px(sheet_margin), px(below), has_legend ? px(legend_space) : px(sheet_margin));
    const Rect& free = sheet.parts.front().free;
    sheet.line_scale = std::max(least_line_scale, shrunk(free.w, free.h, usual_part));
    return sheet;
}

render::View framed(const render::Camera& camera,
                    const Rect& place,
                    const Rect& free,
                    const render::Bounds& scene,
                    double scale) {
    const auto wide = [](float length) { return static_cast<double>(length); };
    render::View view = camera.view(pixel_size(free), scene, scale);
    const double shrink_x = wide(free.w) / wide(place.w);
    const double shrink_y = wide(free.h) / wide(place.h);
    const glm::dvec3 middle = {2.0 * wide(free.centre().x - place.x) / wide(place.w) - 1.0,
                               1.0 - 2.0 * wide(free.centre().y - place.y) / wide(place.h),
                               0.0};
    const glm::dmat4 moved = glm::translate(glm::dmat4(1.0), middle);
    view.projection = glm::scale(moved, glm::dvec3(shrink_x, shrink_y, 1.0)) * view.projection;
    view.size = pixel_size(place);
    return view;
}

void draw_sheet(widgets::Ui& ui, const Sheet& sheet, const PictureFacts& facts) {
    if (!sheet.details) {
        return;
    }
    draw_title(ui, sheet.title, facts);
    if (!facts.rows.empty()) {
        draw_table(ui, sheet.table, facts);
    }
}

void draw_part_caption(widgets::Ui& ui, const Sheet& sheet, std::size_t k, std::string_view caption) {
    const Rect& place = sheet.parts[k].place;
    if (sheet.details && !caption.empty()) {
        widgets::label_at(
            ui, {place.centre().x, place.bottom() - ui.px(0.55F * below)}, caption, ui.colours().text);
    }
}

} // namespace millwright::viewport
