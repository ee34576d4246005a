#include "ui/render/input_state.h"

#define GLFW_INCLUDE_NONE
#include <GLFW/glfw3.h>

#include <algorithm>
#include <iterator>
#include <set>
#include <utility>

namespace millwright::render {

namespace {

/// Going down, it does something to a text that no character does.
bool edits(const TypedEvent& event) {
    if (event.button) {
        return true; // whatever it does to the caret or to what has the keyboard
    }
    if (event.character || event.action != GLFW_PRESS) {
        return false;
    }
    const bool command = (event.mods & (GLFW_MOD_CONTROL | GLFW_MOD_SUPER)) != 0;
    const bool is_modifier = event.key >= GLFW_KEY_LEFT_SHIFT && event.key <= GLFW_KEY_RIGHT_SUPER;
    const bool named = event.key >= GLFW_KEY_ESCAPE && event.key <= GLFW_KEY_END; // Enter, Tab, arrows ...
    return named || event.key == GLFW_KEY_KP_ENTER || (command && !is_modifier);
}

} // namespace

void Typing::add(const std::vector<TypedEvent>& events) {
    waiting_.insert(waiting_.end(), events.begin(), events.end());
}

std::vector<TypedEvent> Typing::next(bool into_text, const std::function<bool(int key)>& was_down) {
    if (!into_text) {
        return std::exchange(waiting_, {});
    }
    bool characters = false, edited = false;
    const auto out_of_order = [&](const TypedEvent& event) {
        if (event.character) {
            characters = true;
            return edited;
        }
        const bool still_down = !event.button && edits(event) && was_down(event.key);
        return edits(event) && (characters || std::exchange(edited, true) || still_down);
    };
    const auto end = std::ranges::find_if(waiting_, out_of_order);
    std::vector<TypedEvent> now(waiting_.begin(), end);
    std::vector<TypedEvent> later;
    std::set<int> pressed;
    for (const TypedEvent& event : std::vector<TypedEvent>(end, waiting_.end())) {
        const bool is_key = !event.character && !event.button;
        const bool is_release = is_key && event.action == GLFW_RELEASE;
        if (is_release && !pressed.contains(event.key)) {
            now.push_back(event);
            continue;
        }
        if (is_key) {
            pressed.insert(event.key);
        }
        later.push_back(event);
    }
    waiting_ = std::move(later);
    return now;
}

bool Typing::waits_for_button(int button) const {
    return std::ranges::find(waiting_, std::optional(button), &TypedEvent::button) != waiting_.end();
}

} // namespace millwright::render
