// What was typed, in its order. ImGui takes all characters of a frame before its keys, and a key once:
// of "12 Enter 3" in one slow frame it makes "123 Enter". Here a frame gets no more than it keeps in order.
#pragma once

#include <functional>
#include <optional>
#include <vector>

namespace millwright::render {

/// A key that changed, in GLFW's numbers, a character, or a button of the mouse that went down.
struct TypedEvent {
    std::optional<unsigned int> character{}; ///< the rest is of a key
    std::optional<int> button{};             ///< the same
    int key = 0, scancode = 0, action = 0, mods = 0;

    friend bool operator==(const TypedEvent&, const TypedEvent&) = default;
};

class Typing {
public:
    void add(const std::vector<TypedEvent>& events);
    /// For the next frame. Not `into_text`: all of it. Else what comes before the first event that would be
    /// taken out of its order; `was_down` tells of a key whether the last frame saw it down. Keys that are
    /// let go are reported at once, unless they went down among what still waits: nothing is held for longer
    /// than a person holds it.
    [[nodiscard]] std::vector<TypedEvent> next(bool into_text, const std::function<bool(int key)>& was_down);
    /// Something is left for another frame.
    [[nodiscard]] bool waits() const { return !waiting_.empty(); }
    /// That button went down behind something that has to be seen before it.
    [[nodiscard]] bool waits_for_button(int button) const;

private:
    std::vector<TypedEvent> waiting_;
};

} // namespace millwright::render
