// What the widgets keep from frame to frame: half-typed text, refusals, folded sections, the tip on its way.
#pragma once

#include "ui/widgets/ui.h"

#include <cstddef>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::widgets {

// How the writing of a text falls into the steps that undo takes back: words, runs of erasing, what was
// pasted.

/// What differs between two texts, in bytes, on borders of UTF-8 letters.
struct TextDifference {
    std::size_t at = 0;       ///< where both begin to differ
    std::size_t removed = 0;  ///< of the first one
    std::size_t inserted = 0; ///< of the second one
};

[[nodiscard]] TextDifference difference(std::string_view before, std::string_view after);

/// The writing of a text, key by key.
class TextSteps {
public:
    /// Whether the change begins a step: a word after a blank, a new line, a pasted piece, erasing after
    /// typing, or either of them at another place. `caret_before` and `caret_after` are byte offsets.
    [[nodiscard]] bool
    begins(std::string_view before, std::string_view after, int caret_before, int caret_after);
    /// What comes next begins a step.
    void end() { kind_ = Kind::none; }

private:
    enum class Kind { none, typed, erased, piece };
    [[nodiscard]] static Kind kind_of(std::string_view before, std::string_view after);

    Kind kind_ = Kind::none;
    int caret_ = -1; ///< behind the last change
};

struct Ui::State {
    struct Edit {
        std::string path;    ///< of the one field being typed into; empty: none
        std::string text;    ///< as typed
        std::string initial; ///< as it was before
        bool called = false; ///< it takes the keyboard when it is drawn next
        int kept_until = -1; ///< ImGui's frame: behind Enter the field takes the keyboard again until then
    };
    /// What is typed while a called field does not have the keyboard yet: it goes into it.
    struct EarlyText {
        int until = -1; ///< ImGui's frame; -1: no field is on its way
        std::vector<unsigned int> characters = {};
    };
    struct Refusal {
        std::string reason;
        double until = 0.0; ///< ImGui time
    };
    struct Tip {
        std::string path;
        std::string text;
        Rect rect;
        bool at_once = false;
        double since = 0.0; ///< ImGui time when the mouse came
        int frame = -1;     ///< last frame in which the mouse was there
    };
    /// The widget pressed last, which stays where it is while rows above it come and go.
    struct Anchor {
        std::string path; ///< empty: none
        float y = 0.0F;   ///< from the top of its pane, as a person sees it
        float scrolled = 0.0F;
    };
    struct Hint {
        Rect rect;
        std::string reason;
    };
    struct Cells {
        int count = 0; ///< side by side
        int next = 0;
        int left = 0; ///< that have no place yet
        Rect line;
    };

    /// The one text of several lines that is being written.
    struct Written {
        std::string path; ///< empty: none
        std::string text; ///< as its owner has it behind this frame
        int caret = -1;   ///< byte offset
        TextSteps steps;
        int frames_to_follow = 0; ///< the caret is brought into sight
    };

    /// Fields of which Enter gives the keyboard to the next one.
    struct Chain {
        bool open = false;    ///< fields that are drawn now belong to it
        bool goes_on = false; ///< Enter ended one in this frame, and the next has not been drawn yet
    };

    Places places;
    Edit edit;
    Chain chain;
    EarlyText early;
    Written written;
    std::map<std::string, Refusal, std::less<>> refusals;
    std::map<std::string, std::string, std::less<>> drafts; ///< refused text that stays in its box, by path
    std::map<std::string, double, std::less<>> memory;      ///< by path: scroll positions, open sections
    Tip tip;
    Anchor anchor;
    std::string under_mouse;            ///< path of the last widget of this frame that the mouse is over
    std::string under_mouse_before;     ///< the same of the frame before: the one on top
    std::vector<Hint> hints;            ///< of this frame
    std::vector<std::string> cut_texts; ///< of this frame
    bool scrolls_sideways = false;      ///< what is drawn now: what is out of its box is not cut
    std::vector<Cells> cells;
    std::vector<float> widths;
    std::vector<float> label_shares;
    std::vector<Permission> permissions;
    bool typing_at_begin = false;        ///< of the frame
    bool keys_claimed = false;           ///< in this frame
    std::vector<std::string> kept_clear; ///< of this frame
    int open_menu_frame = -2;            ///< last frame in which a menu of the bar was open
    std::optional<double> change_at;     ///< ImGui time
};

} // namespace millwright::widgets
