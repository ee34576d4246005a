#include "core/plot/stroke_svg.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <array>
#include <iterator>
#include <string_view>

namespace millwright::plot {

namespace {

constexpr std::array<std::string_view, pen_groups> colours = {
    "#c71f1f", "#9e7a00", "#14852e", "#008094", "#2647d1", "#9e1f9e"};
constexpr double margin = 2.0;

/// Writes positions of the drawing, y up, as those of an SVG.
class Sheet {
public:
    explicit Sheet(const Extents& box)
        : left_(box.lower.x() - margin), top_(box.upper.y() + margin),
          size_(box.upper - box.lower + Vec2(2.0 * margin, 2.0 * margin)) {}

    void open() {
        add("<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"{0:.4f}mm\" height=\"{1:.4f}mm\" "
            "viewBox=\"0 0 {0:.4f} {1:.4f}\" fill=\"none\" stroke-linecap=\"round\" "
            "stroke-linejoin=\"round\">\n",
            size_.x(),
            size_.y());
    }
    void begin_path(std::string_view colour, double width, std::string_view more) {
        add("<path stroke=\"{}\" stroke-width=\"{}\"{} d=\"\n", colour, width, more);
    }
    void point(char command, const Vec2& at) {
        add("{}{:.4f} {:.4f}", command, at.x() - left_, top_ - at.y());
    }
    void end_stroke() { text_ += '\n'; }
    void end_path() { text_ += "\"/>\n"; }
    [[nodiscard]] std::string close() && { return std::move(text_) + "</svg>\n"; }

private:
    template <class... Values> void add(fmt::format_string<Values...> format, Values&&... values) {
        fmt::format_to(std::back_inserter(text_), format, std::forward<Values>(values)...);
    }

    double left_;
    double top_;
    Vec2 size_;
    std::string text_;
};

void add_air(Sheet& sheet, const Strokes& strokes) {
    sheet.begin_path("#999999", 0.1, " stroke-dasharray=\"1 1\"");
    Vec2 at = Vec2::Zero();
    for (const Stroke& stroke : strokes) {
        sheet.point('M', at);
        sheet.point('L', stroke.points.front());
        sheet.end_stroke();
        at = stroke.points.back();
    }
    sheet.end_path();
}

void add_strokes(Sheet& sheet, const Strokes& strokes) {
    for (std::size_t n = 0; n < strokes.size(); ++n) {
        const int pen = strokes[n].pen;
        if (n == 0 || strokes[n - 1].pen != pen) {
            sheet.begin_path(colours[static_cast<std::size_t>(pen_group(pen))], 0.3, "");
        }
        sheet.point('M', strokes[n].points.front());
        for (const Vec2& point : strokes[n].points) {
            sheet.point('L', point); // the first one, too: a dot is a line to itself
        }
        sheet.end_stroke();
        if (n + 1 == strokes.size() || strokes[n + 1].pen != pen) {
            sheet.end_path();
        }
    }
}

} // namespace

std::string svg_text(const Strokes& strokes, AirInSvg air) {
    auto box = extents(strokes);
    if (!box) {
        throw Error("there is nothing to draw");
    }
    if (air == AirInSvg::shown) {
        box->lower = box->lower.cwiseMin(Vec2::Zero());
        box->upper = box->upper.cwiseMax(Vec2::Zero());
    }
    Sheet sheet(*box);
    sheet.open();
    if (air == AirInSvg::shown) {
        add_air(sheet, strokes);
    }
    add_strokes(sheet, strokes);
    return std::move(sheet).close();
}

} // namespace millwright::plot
