#include "ui/widgets/internal/wrap.h"

#include <imgui.h>

namespace millwright::widgets {

std::string
broken_at_blanks(std::string_view text, float width, const std::function<float(std::string_view)>& width_of) {
    std::string broken(text);
    std::size_t line = 0; // where it begins
    std::size_t blank = std::string::npos;
    for (std::size_t end = 0; end <= text.size(); ++end) {
        const bool at_end = end == text.size() || text[end] == '\n';
        if (!at_end && text[end] != ' ') {
            continue;
        }
        if (blank != std::string::npos && width_of(text.substr(line, end - line)) > width) {
            broken[blank] = '\n';
            line = blank + 1;
        }
        blank = at_end ? std::string::npos : end;
        line = at_end ? end + 1 : line;
    }
    return broken;
}

std::string broken_at_blanks(const ImFont* font, std::string_view text, float width) {
    return broken_at_blanks(text, width, [font](std::string_view piece) {
        constexpr float endless = 1e9F;
        return font->CalcTextSizeA(font->FontSize, endless, 0.0F, piece.data(), piece.data() + piece.size())
            .x;
    });
}

} // namespace millwright::widgets
