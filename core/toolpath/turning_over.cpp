#include "core/toolpath/turning_over.h"

#include "core/base/error.h"
#include "core/geometry/outline_tree.h"

#include <fmt/format.h>

#include <algorithm>

namespace millwright::toolpath {

namespace {

constexpr int halvings = 26; // to 1.5e-8 of a move: what turns within that flips

[[noreturn]] void refuse_turn(const Vec2& a, const Vec2& b, const Vec2& at) {
    throw Error(fmt::format("the surface folds over itself: between u {:.3f}, v {:.3f} and u {:.3f}, v "
                            "{:.3f} its normal flips to the other side, at u {:.4f}, v {:.4f}",
                            a.x(),
                            a.y(),
                            b.x(),
                            b.y(),
                            at.x(),
                            at.y()),
                {},
                "check for rows of control points in the wrong order there, or split the surface: a tool "
                "cuts from one side");
}

} // namespace

std::optional<Vec2> flip_between(const geometry::ParametricSurface& patch, const Vec2& a, const Vec2& b) {
    const auto normal = [&](const Vec2& uv) { return patch.unit_normal(uv.x(), uv.y()); };
    const auto opposed = [](const Vec3& n, const Vec3& m) { return n.dot(m) < 0.0; };
    auto before = normal(a), after = normal(b);
    if (!before || !after || !opposed(*before, *after)) {
        return std::nullopt;
    }
    Vec2 low = a, high = b;
    for (int k = 0; k < halvings; ++k) {
        const Vec2 middle = 0.5 * (low + high);
        const auto between = normal(middle);
        if (!between) {
            return middle;
        }
        if (opposed(*before, *between)) {
            high = middle;
            after = between;
        } else if (opposed(*between, *after)) {
            low = middle;
            before = between;
        } else {
            return std::nullopt;
        }
    }
    return 0.5 * (low + high);
}

void refuse_turning_over(const geometry::ParametricSurface& patch,
                         const geometry::Trim& trim,
                         const grid::Grid& grid,
                         const Toolpath& contacts) {
    const geometry::OutlineTree outline(trim);
    const auto look = [&](const Vec2& a, const Vec2& b) {
        for (const auto& [from, to] : outline.parts_inside(a, b)) {
            const Vec2 begin = a + from * (b - a), end = a + to * (b - a);
            if (const auto at = flip_between(patch, begin, end)) {
                refuse_turn(begin, end, *at);
            }
        }
    };
    const auto& points = contacts.points;
    for (std::size_t n = 1; n < points.size(); ++n) {
        look(points[n - 1].origin.uv, points[n].origin.uv);
    }
    for (int i = 0; i < grid.nu(); ++i) { // links may run where nothing is cut: from track to track, too
        for (int j = 0; j < grid.nv(); ++j) {
            look(grid.node(std::max(i - 1, 0), j), grid.node(i, j));
            look(grid.node(i, std::max(j - 1, 0)), grid.node(i, j));
        }
    }
}

} // namespace millwright::toolpath
