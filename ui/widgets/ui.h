// The vocabulary of the panels: each call draws one widget of this frame and says what the user just
// committed. Every widget has an id apart from its label; scopes and ids make its path (`grid/adapt`), by
// which tests, scripts and the tour find it. Lengths are pixels at the monitor's scale unless said otherwise.
// For the UI thread; needs a current ImGui context between NewFrame and Render. All texts are UTF-8.
#pragma once

#include "ui/widgets/field_info.h"
#include "ui/widgets/fonts.h"
#include "ui/widgets/permission.h"
#include "ui/widgets/places.h"
#include "ui/widgets/theme.h"

#include <array>
#include <functional>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace millwright::widgets {

class Ui;

struct Look {
    Theme theme = Theme::dark;
    float scale = 1.0F; ///< of the monitor, as given to load_fonts
    Fonts fonts;
};

/// Ends what a call began (a scope, a pane, a section) when it goes out of scope.
class [[nodiscard]] Guard {
public:
    using End = void (*)(Ui&);
    Guard(Ui& ui, End end, bool open = true) : ui_(ui), end_(end), open_(open) {}
    Guard(const Guard&) = delete;
    Guard& operator=(const Guard&) = delete;
    ~Guard() { end_(ui_); }

    /// Whether there is anything to draw inside.
    explicit operator bool() const { return open_; }

private:
    Ui& ui_;
    End end_;
    bool open_;
};

/// One of several to choose from. Its path is the widget's path, a slash, and `id`.
struct Option {
    std::string_view id;
    std::string_view label;
    std::string_view icon = {};
    std::string_view tip = {};
    Permission permission = {};
};

enum class Tone { normal, muted, good, warning, danger };

enum class Rank { normal, primary, quiet, danger };

struct ButtonLook {
    std::string_view icon = {};
    Rank rank = Rank::normal;
    float width = 0.0F; ///< 0: as wide as the label needs; negative: all that is left
    std::string_view tip = {};
};

/// A button that does something for as long as it is held.
struct HeldButton {
    bool held = false;    ///< the mouse is down on it and still over it, or the space bar
    bool pressed = false; ///< went down in this frame
};

/// "" if the text may be committed, else the sentence that says what is wrong with it.
using TextCheck = std::function<std::string(std::string_view)>;

class Ui {
public:
    explicit Ui(Look look);
    Ui(const Ui&) = delete;
    Ui& operator=(const Ui&) = delete;
    ~Ui();

    // ---- the frame
    /// After ImGui::NewFrame. Forgets the places of the last frame; throws Defect if a scope was left open.
    void begin_frame();
    /// Before ImGui::Render: draws the tip and the reasons for refused input over everything else.
    void end_frame();
    /// Seconds until the picture changes without any input (a tip, a fading notice); empty: never.
    [[nodiscard]] std::optional<double> next_change() const;
    /// A widget whose picture changes without input asks for a frame `seconds` from now.
    void change_in(double seconds);

    [[nodiscard]] const Look& look() const { return look_; }
    [[nodiscard]] const Palette& colours() const { return palette(look_.theme); }
    void set_look(const Look& look) { look_ = look; }
    [[nodiscard]] float px(float length) const { return length * look_.scale; }

    // ---- paths
    /// Widgets drawn until the guard ends have `id` before their own.
    Guard scope(std::string_view id);
    [[nodiscard]] std::string path(std::string_view id) const;
    /// For what is not drawn by this class, such as handles in the 3D view. Throws Defect on a path used
    /// twice.
    void record(std::string_view id, const Rect& rect, bool enabled = true, std::string reason = {});
    /// Neither tips nor reasons of refusals lie over that widget in this frame.
    void keep_clear(std::string_view path);
    [[nodiscard]] std::optional<Rect> place(std::string_view path) const;
    [[nodiscard]] const Places& places() const;
    /// What did not fit its place in this frame, and ends in an ellipsis or at the pane's border: for the
    /// tests of the layout.
    [[nodiscard]] std::span<const std::string> cut_texts() const;

    // ---- the keyboard
    /// A text field has it: letters are not shortcuts now.
    [[nodiscard]] bool is_typing() const;
    /// A text field had the keyboard when the frame began, or has it now, or all keys are claimed: a key that
    /// went down in this frame was meant for it.
    [[nodiscard]] bool was_typing() const;
    /// In this frame every key is meant for what lies over the window: a list of commands to choose from.
    void claim_keys();
    [[nodiscard]] bool keys_claimed() const;
    [[nodiscard]] bool escape_pressed() const;
    [[nodiscard]] bool enter_pressed() const;
    /// In the next frame arrows and page keys walk through no widgets, and the space bar presses none:
    /// somebody else listens to the keyboard. For as long as each frame says so.
    void keep_keys_from_widgets();
    /// Gives the keyboard to the pane of that path, of no content; Tab then goes through its widgets.
    void focus_pane(std::string_view path);
    /// Gives the keyboard to the field of that path when it is drawn next, soon, with all of its text
    /// selected; until then letters are meant for it.
    void focus_field(std::string_view path);
    /// Until the guard ends Enter in a number or text field goes on to the next of these fields, in the order
    /// in which they are drawn, with all of its text selected; behind the last one it goes nowhere.
    Guard enter_goes_on();

    // ---- panes and order (panes.cpp)
    /// A fixed part of the window with its own scroll bar; enters the scope `id`. `title` may be empty. For
    /// each `content` it keeps where it was scrolled to.
    Guard
    pane(std::string_view id, const Rect& rect, std::string_view title = {}, std::string_view content = {});
    /// The same without padding, for pictures and lists that reach the border.
    Guard bare_pane(std::string_view id, const Rect& rect);
    /// What is left to draw on: x and y of the next widget, width to the border, height to the bottom.
    [[nodiscard]] Rect rest() const;
    /// A heading that folds what follows away; draw it only if the guard is true. Enters the scope `id`.
    Guard section(std::string_view id, std::string_view title, bool open_at_first = true);
    /// The next `count` widgets without a label share one line in equal parts, or as few lines as leave each
    /// of them `least_width` pixels.
    Guard row(int count, float least_width = 0.0F);
    /// Widgets that would take all the width that is left take this much until the guard ends.
    Guard width(float width);
    /// Share of the width that labels take until the guard ends; 0.42 else.
    Guard label_share(float share);
    /// Everything until the guard ends is greyed out, with the reason, unless allowed.
    Guard permitted(const Permission& permission);
    /// A dialog in the middle of the window, over everything else, for as long as it is drawn; enters `id`.
    Guard dialog(std::string_view id, std::string_view title, float width);
    /// The next widget stands on the line of the last one.
    void beside();
    /// Leaves some room before the next widget.
    void move_by(float right, float down);
    void gap();
    void line();

    // ---- words and read-only values (values.cpp)
    void heading(std::string_view text);
    void text(std::string_view text, Tone tone = Tone::normal); ///< wraps
    /// One line as wide as its text, for bars: put several side by side with beside(). `most`: pixels, 0: up
    /// to the pane's border; what does not fit ends in an ellipsis, and its tip is the whole of it.
    void words(std::string_view text, Tone tone = Tone::normal, float most = 0.0F);
    /// Pixels that words() of it take.
    [[nodiscard]] float words_width(std::string_view text) const;
    void note(std::string_view text); ///< wraps, in the muted colour
    void value(std::string_view id,
               std::string_view label,
               std::string_view text,
               std::string_view unit = {},
               std::string_view tip = {});
    void value(std::string_view id, double number, const FieldInfo& info);
    /// True when Cancel was pressed. `fraction` below 0: not known, a bar that moves.
    bool progress(std::string_view id, std::string_view text, double fraction, const Permission& cancel = {});

    // ---- buttons and switches (buttons.cpp)
    bool button(std::string_view id,
                std::string_view label,
                const Permission& permission = {},
                const ButtonLook& look = {});
    HeldButton hold_button(std::string_view id,
                           std::string_view label,
                           const Permission& permission = {},
                           const ButtonLook& look = {});
    /// A square button; `chosen` draws it pressed. The tip is its only label, so it must not be empty.
    bool icon_button(std::string_view id,
                     std::string_view icon,
                     std::string_view tip,
                     const Permission& permission = {},
                     bool chosen = false);
    std::optional<bool> checkbox(std::string_view id,
                                 std::string_view label,
                                 bool on,
                                 std::string_view tip = {},
                                 const Permission& permission = {});
    /// A row with a switch at its right; for settings that act at once.
    std::optional<bool> toggle(std::string_view id,
                               std::string_view label,
                               bool on,
                               std::string_view tip = {},
                               const Permission& permission = {});

    // ---- one of several (choices.cpp); the answer is the index of the option just chosen, never `now`
    std::optional<int> choice(std::string_view id,
                              std::string_view label,
                              int now,
                              std::span<const Option> options,
                              std::string_view tip = {});
    std::optional<int> segmented(std::string_view id,
                                 std::string_view label,
                                 int now,
                                 std::span<const Option> options,
                                 std::string_view tip = {});
    std::optional<int> tabs(std::string_view id, int now, std::span<const Option> options);

    // ---- numbers (numbers.cpp): arithmetic is allowed; Enter, Tab or a click elsewhere commits, Esc
    // reverts, up and down step (Shift fine, Ctrl coarse). What is no finite number in the range is refused,
    // with the reason in `places()` and beside the field; the old value stays. Values are in `info.unit`.
    std::optional<double> number(std::string_view id,
                                 std::string_view label,
                                 double value,
                                 const FieldInfo& info,
                                 const Permission& permission = {});
    std::optional<double> number(double value, const FieldInfo& info, const Permission& permission = {});
    std::optional<int> integer(std::string_view id,
                               std::string_view label,
                               int value,
                               const FieldInfo& info,
                               const Permission& permission = {});
    std::optional<int> integer(int value, const FieldInfo& info, const Permission& permission = {});
    /// Three numbers with ids x, y and z below `id`: in a line, or below each other in a narrow pane.
    std::optional<std::array<double, 3>> vec3(std::string_view id,
                                              std::string_view label,
                                              const std::array<double, 3>& value,
                                              const FieldInfo& info,
                                              const Permission& permission = {});

    // ---- text (typed_text.cpp)
    std::optional<std::string> text_field(std::string_view id,
                                          std::string_view label,
                                          std::string_view value,
                                          std::string_view tip = {},
                                          const Permission& permission = {});
    /// What is looked for: each Enter answers it, changed or not, and leaves the field the keyboard.
    std::optional<std::string> search_field(std::string_view id,
                                            std::string_view label,
                                            std::string_view value,
                                            std::string_view tip = {});
    /// A line to be sent: Enter answers it, empties the field and leaves it the keyboard; while `permission`
    /// is refused, Enter shows why. Leaving the field sends nothing. The arrows bring back the lines of
    /// `history`, oldest first; Tab completes from it and from `words` (matching.h).
    std::optional<std::string> command_line(std::string_view id,
                                            std::string_view label,
                                            std::span<const std::string> history,
                                            std::string_view tip = {},
                                            const Permission& permission = {},
                                            std::span<const std::string_view> words = {});
    /// In the mono font; refused text stays in the field with its reason below until it is right or Esc.
    std::optional<std::string> expression(std::string_view id,
                                          std::string_view label,
                                          std::string_view value,
                                          const TextCheck& check,
                                          std::string_view tip = {},
                                          const Permission& permission = {});

    /// What the widgets of this folder keep from frame to frame.
    struct State;
    [[nodiscard]] State& state() { return *state_; }

private:
    Look look_;
    std::unique_ptr<State> state_;
};

} // namespace millwright::widgets
