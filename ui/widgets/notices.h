// What the program has to say: banners inside a pane, and notices that come up in a corner and go again.
#pragma once

#include "ui/widgets/ui.h"

#include <string>
#include <string_view>
#include <vector>

namespace millwright::widgets {

enum class Severity { info, good, warning, danger };

struct Notice {
    Severity severity = Severity::info;
    std::string text;  ///< a plain sentence
    std::string place; ///< file, line, axis: where it was found; may be empty
    /// Of something that passes: Toasts::forget_passing() takes it away, also where it is danger.
    bool passing = false;
};

/// A banner in the flow of the pane. True when it was closed; `can_close` false leaves the cross out.
bool banner(Ui& ui, std::string_view id, const Notice& notice, bool can_close = false);

/// Pixels that a banner without a cross takes where it has `width` pixels.
[[nodiscard]] float banner_height(const Ui& ui, const Notice& notice, float width);

/// The notices in the corner. Danger stays until it is closed; the others go by themselves.
class Toasts {
public:
    /// The same notice again only makes the one on show start anew.
    void push(Notice notice);
    /// What they tell of is over.
    void forget_passing();
    /// Into the lower right corner of `area`, newest below; into another corner of the window where that
    /// would cover a dialog. Paths: `id`/1 ... in order of coming; `/close`.
    void draw(Ui& ui, std::string_view id, const Rect& area);

    [[nodiscard]] bool is_empty() const { return shown_.empty(); }

private:
    struct Shown {
        Notice notice;
        int number = 0;
        double until = -1.0; ///< ImGui time; negative: not drawn yet
    };
    std::vector<Shown> shown_;
    int last_number_ = 0;
};

} // namespace millwright::widgets
