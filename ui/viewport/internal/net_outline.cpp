#include "ui/viewport/internal/net_outline.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>

namespace millwright::viewport {

namespace {

using geometry::Trim;

double cross(const Vec2& a, const Vec2& b) {
    return a.x() * b.y() - a.y() * b.x();
}

/// Nodes of a cell, and from its first one along rows, along columns and what both do together.
struct Cell {
    Vec2 first, along_rows, along_columns, twist;

    Cell(const grid::NodeArray& nodes, int i, int j)
        : first(nodes.at(i, j)), along_rows(nodes.at(i + 1, j) - first),
          along_columns(nodes.at(i, j + 1) - first),
          twist(nodes.at(i + 1, j + 1) - nodes.at(i + 1, j) - along_columns) {}

    [[nodiscard]] Vec2 at(const Vec2& share) const {
        return first + share.x() * along_rows + share.y() * along_columns + share.x() * share.y() * twist;
    }

    /// The shares of `uv`, by Newton's steps, kept in the cell.
    [[nodiscard]] Vec2 shares_of(const Vec2& uv) const {
        constexpr int steps = 12; // from the middle of a cell without folds
        Vec2 share(0.5, 0.5);
        for (int k = 0; k < steps; ++k) {
            const Vec2 by_row = along_rows + share.y() * twist;
            const Vec2 by_column = along_columns + share.x() * twist;
            const double area = cross(by_row, by_column);
            const Vec2 left = uv - at(share);
            share += Vec2(cross(left, by_column), cross(by_row, left)) / area;
            share = share.cwiseMax(0.0).cwiseMin(1.0);
        }
        return share;
    }
};

/// Finds places one after the other, each from the cell of the one before.
class Net {
public:
    Net(const grid::NodeArray& nodes, int fine) : nodes_(nodes), fine_(fine) {}

    [[nodiscard]] Trim::Loop outline(const Trim::Loop& loop) {
        Trim::Loop found;
        for (std::size_t n = 0; n < loop.size(); ++n) {
            const Vec2& a = loop[n];
            const Vec2& b = loop[n + 1 == loop.size() ? 0 : n + 1];
            const Vec2 from = find(a);
            found.push_back(from);
            add_between(found, {a, from}, {b, find(b)}, most_halvings);
        }
        return found;
    }

private:
    static constexpr int most_halvings = 12;

    struct Corner {
        Vec2 uv;     ///< in the parameters of the patch
        Vec2 on_net; ///< in those of the net
    };

    [[nodiscard]] Vec2 cells() const { return {nodes_.rows - 1.0, nodes_.columns - 1.0}; }

    /// Inner corners of an edge: half a cell of the net apart or less, and as many as its bends take.
    void add_between(Trim::Loop& found, const Corner& a, const Corner& b, int halvings) {
        constexpr double bend = 0.02; // of a cell of the mesh
        if (halvings == 0) {
            return;
        }
        const Vec2 uv = 0.5 * (a.uv + b.uv);
        const Corner middle{uv, find(uv)};
        const Vec2 off = (middle.on_net - 0.5 * (a.on_net + b.on_net)).cwiseProduct(cells());
        const Vec2 way = (b.on_net - a.on_net).cwiseProduct(cells());
        if (way.cwiseAbs().maxCoeff() < 0.5 && fine_ * off.norm() < bend) {
            return;
        }
        add_between(found, a, middle, halvings - 1);
        found.push_back(middle.on_net);
        add_between(found, middle, b, halvings - 1);
    }

    [[nodiscard]] Vec2 find(const Vec2& uv) {
        walk_to(uv);
        const Vec2 share = Cell(nodes_, i_, j_).shares_of(uv);
        Vec2 place = (Vec2(i_, j_) + share).cwiseQuotient(cells());
        constexpr double rounding = 1e-9; // what lies on the border of the patch lies on that of the net
        for (int axis = 0; axis < 2; ++axis) {
            place[axis] = place[axis] < rounding ? 0.0 : place[axis] > 1.0 - rounding ? 1.0 : place[axis];
        }
        return place;
    }

    /// Over the side of a cell on which `uv` lies outside, until there is none, or the net ends there.
    void walk_to(const Vec2& uv) {
        for (int steps = 4 * (nodes_.rows + nodes_.columns); steps > 0; --steps) {
            const Vec2& a = nodes_.at(i_, j_);
            const Vec2& b = nodes_.at(i_ + 1, j_);
            const Vec2& c = nodes_.at(i_ + 1, j_ + 1);
            const Vec2& d = nodes_.at(i_, j_ + 1);
            const auto beyond = [&](const Vec2& p, const Vec2& q) { return cross(q - p, uv - p) < 0.0; };
            if (j_ > 0 && beyond(a, b)) {
                --j_;
            } else if (i_ + 2 < nodes_.rows && beyond(b, c)) {
                ++i_;
            } else if (j_ + 2 < nodes_.columns && beyond(c, d)) {
                ++j_;
            } else if (i_ > 0 && beyond(d, a)) {
                --i_;
            } else {
                return;
            }
        }
    }

    const grid::NodeArray& nodes_;
    int fine_;
    int i_ = 0, j_ = 0; ///< cell of the last place
};

} // namespace

Vec2 place_on_net(const grid::NodeArray& nodes, const Vec2& at) {
    expects(nodes.rows >= 2 && nodes.columns >= 2, "a net has cells");
    const auto cell = [](double place, int count) {
        return std::clamp(static_cast<int>(std::floor(place)), 0, count - 2);
    };
    const Vec2 place = at.cwiseProduct(Vec2(nodes.rows - 1.0, nodes.columns - 1.0));
    const int i = cell(place.x(), nodes.rows), j = cell(place.y(), nodes.columns);
    return Cell(nodes, i, j).at(place - Vec2(i, j));
}

geometry::Trim trim_on_net(const Trim& trim, const grid::NodeArray& nodes, int fine) {
    expects(nodes.rows >= 2 && nodes.columns >= 2, "a net has cells");
    Net net(nodes, fine);
    Trim found;
    for (const Trim::Loop& loop : trim.loops) {
        found.loops.push_back(net.outline(loop));
    }
    return found;
}

} // namespace millwright::viewport
