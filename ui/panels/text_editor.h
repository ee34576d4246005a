// A text of the project that a person writes: line numbers with what is wrong, undo word by word, and a row
// to find and replace. Every editor of the window is one of these.
#pragma once

#include "core/base/text_search.h"
#include "ui/panels/panel.h"
#include "ui/widgets/text_area.h"

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace millwright::panels {

/// Which text of the project it is, and how the writing of it is called in the list of what can be undone.
struct EditedText {
    std::string& (*draft)(project::Project&) = nullptr;
    const std::string& (*shown)(const project::Project&) = nullptr;
    const char* title = "";
    const char* merge_key = "";
};

/// Of a part of the project: edited_text<&project::Project::arm, &project::ArmInput::program>("Write ...",
/// "...").
template <auto part, auto text>
[[nodiscard]] constexpr EditedText edited_text(const char* title, const char* merge_key) {
    return {[](project::Project& draft) -> std::string& { return (draft.*part).*text; },
            [](const project::Project& shown) -> const std::string& { return (shown.*part).*text; },
            title,
            merge_key};
}

class TextEditor {
public:
    explicit TextEditor(const EditedText& edited) : edited_(edited) {}

    /// Opens and closes the row that finds.
    void draw_find_button(Ui& ui);
    /// `faults`: by line.
    void draw(Ui& ui, const FrameState& now, ActionQueue& ask, const std::vector<Diagnostic>& faults);

private:
    void follow(const FrameState& now, ActionQueue& ask);
    void draw_find(Ui& ui, ActionQueue& ask);
    void draw_find_buttons(Ui& ui, ActionQueue& ask);
    void draw_area(Ui& ui, const FrameState& now, ActionQueue& ask, const std::vector<Diagnostic>& faults);
    void go_on(int direction);
    void replace_one(ActionQueue& ask);
    void replace_all(ActionQueue& ask);
    void put(ActionQueue& ask, std::string text);
    [[nodiscard]] TextPattern pattern() const { return TextPattern(wanted_, matching_); }
    [[nodiscard]] std::string count_text() const;

    EditedText edited_;
    bool finds_ = false; ///< the row is open
    bool calls_ = false; ///< its field takes the keyboard
    std::string wanted_, replacement_;
    TextMatching matching_;
    std::optional<std::size_t> found_; ///< first byte of the place that is shown
    bool shows_ = false;               ///< it is brought into sight
    std::size_t caret_ = 0;            ///< from which a search begins
    std::string text_;                 ///< of this frame; what was found belongs to it
    std::string news_;                 ///< how many places were replaced
};

/// The first fault with its line and what to do, and how many more there are.
[[nodiscard]] std::string fault_text(const std::vector<Diagnostic>& faults);

/// The first fault, in as many lines as it needs, else `help`.
void fault_line(Ui& ui, const std::vector<Diagnostic>& faults, std::string_view help);

} // namespace millwright::panels
