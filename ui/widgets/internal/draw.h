// How the widgets of this folder draw and take the mouse: reserved rectangles, presses, texts that fit.
#pragma once

#include "ui/widgets/internal/state.h"
#include "ui/widgets/ui.h"

#include <imgui.h>

#include <functional>
#include <string>
#include <string_view>

// Texts of several lines. Dear ImGui also breaks a line behind a point or a comma, in the middle of
// "1450.141".

struct ImFont;

namespace millwright::widgets {

/// `text` with a line end in place of each blank at which it has to be broken to fit into `width`, measured
/// by `width_of`. A word that is longer stays as it is.
[[nodiscard]] std::string
broken_at_blanks(std::string_view text, float width, const std::function<float(std::string_view)>& width_of);

/// The same in a font at its size.
[[nodiscard]] std::string broken_at_blanks(const ImFont* font, std::string_view text, float width);

[[nodiscard]] inline ImVec2 upper_left(const Rect& r) {
    return {r.x, r.y};
}
[[nodiscard]] inline ImVec2 lower_right(const Rect& r) {
    return {r.x + r.w, r.y + r.h};
}

/// A rectangle taken out of the flow, in which pieces are then placed freely.
class Slot {
public:
    /// `width` 0 or less: all that is left. In a row() of n widgets: the next n-th part of it.
    Slot(Ui& ui, float width, float height);
    Slot(const Slot&) = delete;
    Slot& operator=(const Slot&) = delete;
    ~Slot();

    [[nodiscard]] const Rect& rect() const { return rect_; }

private:
    Rect rect_;
};

/// Ui::record for a path that is already whole.
void record_at(
    Ui& ui, const std::string& path, const Rect& rect, bool enabled = true, std::string reason = {});

/// Whether the Tab key stops at a piece; small extras beside a field are for the mouse.
enum class Reach { tab_and_mouse, mouse };

struct Press {
    bool clicked = false;
    bool hovered = false;
    bool held = false;
    bool focused = false; ///< the keyboard stands on it
    bool enabled = true;
};

/// A piece of a slot that can be pressed by mouse or space bar; records `path`. Draws only the keyboard's
/// ring. The reason of a refusal, else `tip`, appears when the mouse rests on it.
Press press(Ui& ui,
            const std::string& path,
            const Rect& rect,
            const Permission& permission = {},
            std::string_view tip = {},
            Reach reach = Reach::tab_and_mouse);

/// The permission of this place: the innermost permitted() that refuses, else `own`.
[[nodiscard]] const Permission& effective(Ui& ui, const Permission& own);

/// Shows `tip` if the mouse rests on `rect` of the current window for a moment.
void offer_tip(Ui& ui, const std::string& path, const Rect& rect, std::string_view tip);

/// Shows `text` beside the mouse at once, as long as it is called.
void show_at_mouse(Ui& ui, const std::string& path, std::string text);

inline constexpr double disabled_opacity = 0.45;

[[nodiscard]] float text_width(const ImFont* font, std::string_view text);

enum class Align { left, centre, right };

/// One line of text in the middle of `rect`'s height; what does not fit ends in an ellipsis.
/// True if it was cut; Ui::cut_texts() has it then, and also where the pane ends before the text.
bool draw_text(Ui& ui,
               const ImFont* font,
               const Rect& rect,
               Colour colour,
               std::string_view text,
               Align align = Align::left);

void fill(const Rect& rect, Colour colour, float rounding = 0.0F);
void outline(const Rect& rect, Colour colour, float rounding = 0.0F, float thickness = 1.0F);

/// The two columns of a settings row: draws the label (with `tip`) at the left, gives the rest.
[[nodiscard]] Rect labelled(Ui& ui,
                            const std::string& path,
                            const Rect& row,
                            std::string_view label,
                            std::string_view tip,
                            bool enabled = true);

[[nodiscard]] bool key_pressed(ImGuiKey key);

} // namespace millwright::widgets
