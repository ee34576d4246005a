// Where each widget of this frame is, by path: `grid/adapt`, whatever its label says. Tests, recorded scripts
// and the first-run tour find widgets here. Lengths are pixels, the origin is the window's upper left corner.
#pragma once

#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::widgets {

struct Point {
    float x = 0.0F;
    float y = 0.0F;

    friend bool operator==(const Point&, const Point&) = default;
};

struct Rect {
    float x = 0.0F;
    float y = 0.0F;
    float w = 0.0F;
    float h = 0.0F;

    [[nodiscard]] float right() const { return x + w; }
    [[nodiscard]] float bottom() const { return y + h; }
    [[nodiscard]] Point centre() const { return {x + 0.5F * w, y + 0.5F * h}; }
    [[nodiscard]] bool contains(Point p) const {
        return p.x >= x && p.x < right() && p.y >= y && p.y < bottom();
    }
    friend bool operator==(const Rect&, const Rect&) = default;
};

/// What a widget reported about itself when it was drawn.
struct Seen {
    Rect rect;
    bool enabled = true;
    bool visible = true; ///< false when its middle is scrolled or clipped away
    std::string reason;  ///< why it is greyed out, or why what was typed was refused; else empty

    friend bool operator==(const Seen&, const Seen&) = default;
};

class Places {
public:
    /// The full path of `id` in the scopes entered now.
    [[nodiscard]] std::string path(std::string_view id) const;
    /// Null when nothing of that path was drawn since clear(). Valid until the next clear().
    [[nodiscard]] const Seen* find(std::string_view path) const;
    [[nodiscard]] const std::map<std::string, Seen, std::less<>>& all() const { return seen_; }

    /// Forgets the last frame. Throws Defect if a scope was left open.
    void clear();
    void enter(std::string_view id);
    void leave() noexcept;
    /// Throws Defect if `path` was used before in this frame or is empty.
    void record(std::string path, Seen seen);

private:
    std::vector<std::string> scopes_;
    std::map<std::string, Seen, std::less<>> seen_;
};

} // namespace millwright::widgets
