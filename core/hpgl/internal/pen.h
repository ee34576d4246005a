// The pen: where it is, whether it is down, and what of its way becomes strokes. Plotter units in, mm out.
#pragma once

#include "core/geometry/vectors.h"
#include "core/hpgl/internal/problems.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace millwright::hpgl::internal {

// Line types: which parts of a vector are drawn (LT, UL). Lengths in plotter units.

/// Percents of the pattern's length: drawn, left out, drawn, ... A drawn part of 0 is a dot.
using Pattern = std::vector<double>;

/// The patterns 1 to 8 that a plotter has after IN (HP-GL/2 reference guide, UL). [0] is that of type 1.
[[nodiscard]] const std::array<Pattern, 8>& initial_patterns();

class LineType {
public:
    /// Whole vectors.
    void set_solid();
    /// Dots at the ends of vectors and nothing between.
    void set_dots();
    /// `pattern` again and again, going on from vector to vector until the pen is lifted.
    void set_pattern(const Pattern& pattern, double length);
    /// The pattern a whole number of times a vector, beginning and ending in the middle of its first part.
    void set_adaptive(const Pattern& pattern, double length);

    [[nodiscard]] bool solid() const { return kind_ == Kind::solid; }
    /// The pen was lifted: the pattern begins anew.
    void restart() { phase_ = 0.0; }

    /// Calls `draw(a, b)` for each part of the vector that is drawn; a dot has a = b. Stops when it returns
    /// false.
    void apply(const Vec2& from, const Vec2& to, const std::function<void(const Vec2&, const Vec2&)>& draw);

private:
    enum class Kind { solid, dots, pattern, adaptive };
    Kind kind_ = Kind::solid;
    Pattern pattern_; ///< fractions of the length
    double length_ = 0.0;
    double phase_ = 0.0; ///< how far into the pattern the next vector begins, in plotter units
};

/// A vertex of the polygon buffer (PM), with whether the pen was down on the way to it.
struct Vertex {
    Vec2 at = Vec2::Zero();
    bool drawn = false;
};
using Outline = std::vector<Vertex>; ///< closed: its last vertex leads to the first
using Polygon = std::vector<Outline>;

struct Window {
    Vec2 lower = Vec2::Zero();
    Vec2 upper = Vec2::Zero();
};

class Pen {
public:
    Pen(const HpglSettings& settings, const Problems& problems);

    [[nodiscard]] Vec2 at() const { return at_; }
    [[nodiscard]] bool down() const { return down_; }
    [[nodiscard]] std::optional<int> number() const { return number_; }

    void select(int number);
    /// No pen: what follows is not drawn.
    void put_away();
    void lower();
    void lift();

    /// To a position, as the pen stands; the position is known from now on.
    void go(const Vec2& to);
    /// By a step, as the pen stands.
    void step(const Vec2& by);
    /// Up, whatever the pen's state, which stays.
    void place(const Vec2& to);
    /// Down, whatever the pen's state, which stays.
    void draw(const Vec2& to);

    /// Whether a line to there would end where the stroke that is being drawn began; plotter units.
    [[nodiscard]] bool would_close(const Vec2& to) const;

    /// A place so far away that two numbers must have become one is refused; plotter units.
    [[nodiscard]] bool is_near(const Vec2& place);

    /// The command being followed cannot be: the pen stays where it is. The first reason counts.
    void refuse(std::string why);
    [[nodiscard]] bool refused() const { return refusal_.has_value(); }
    /// Begins the next command.
    [[nodiscard]] std::optional<std::string> take_refusal() { return std::exchange(refusal_, std::nullopt); }

    /// All that a command may change of the drawing.
    struct Mark {
        std::size_t strokes = 0;
        std::size_t points = 0; ///< of the last of them
        std::int64_t points_left = 0;
        Vec2 at = Vec2::Zero();
        bool down = false;
        std::optional<int> number;
    };
    [[nodiscard]] Mark mark() const;
    /// Takes back what was drawn since.
    void take_back(const Mark& mark);

    /// A command was wrong: where the plotter would be now is not known, so nothing is drawn up to the next
    /// go().
    void lose();
    /// Whether go() finds the position again.
    void stay_lost(bool stays) { stays_lost_ = stays; }
    [[nodiscard]] bool lost() const { return lost_; }

    LineType line;
    std::optional<Window> window;

    /// While open, the way of the pen is kept as a polygon and not drawn.
    void open_polygon();
    void next_outline();
    void close_polygon();
    [[nodiscard]] bool in_polygon() const { return polygon_open_; }
    [[nodiscard]] const Polygon& polygon() const { return polygon_; }

    /// Ends the last stroke and gives everything away.
    void finish(Plot& plot, std::int64_t byte);

    std::int64_t byte = 0; ///< of the command being followed

private:
    void move(const Vec2& to, bool drawn);
    void draw_vector(const Vec2& from, const Vec2& to);
    void draw_clipped(Vec2 from, Vec2 to);
    void append(const Vec2& from, const Vec2& to);
    void count_points(int count);
    void end_dot();
    [[nodiscard]] Vec2 mm(const Vec2& plotter) const { return plotter.cwiseProduct(unit_); }

    struct LastStroke {
        bool open = false;       ///< it may go on
        Vec2 tip = Vec2::Zero(); ///< where it ends
    };

    const Problems& problems_;
    Vec2 unit_;
    Vec2 farthest_; ///< of the origin on each axis
    std::int64_t points_left_;
    Vec2 at_ = Vec2::Zero();
    bool down_ = false;
    bool lost_ = false;
    bool stays_lost_ = false;
    bool dot_ = false; ///< the pen went down and has drawn nothing yet
    std::optional<int> number_ = 1;
    plot::Strokes strokes_;
    LastStroke last_;
    Polygon polygon_;
    bool polygon_open_ = false;
    std::optional<std::string> refusal_;
};

// The part of a straight line inside a window (Liang and Barsky 1984).

/// Shortens the line to what is inside or on the edge; false if nothing is. Ends that are inside stay as they
/// are.
[[nodiscard]] bool clip(const Window& window, Vec2& from, Vec2& to);

} // namespace millwright::hpgl::internal
