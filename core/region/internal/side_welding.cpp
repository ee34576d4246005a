#include "core/region/internal/side_welding.h"

#include "core/base/error.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <map>
#include <utility>

namespace millwright::region {

namespace {

/// A side from one corner point to the next on it.
struct Piece {
    int face = 0, side = 0;
    int first = 0, last = 0;     ///< points
    double from = 0.0, to = 1.0; ///< along the side
};

class Welding {
public:
    Welding(std::span<const ExactFace> faces, double tolerance, double spacing)
        : faces_(faces), tolerance_(tolerance), spacing_(spacing) {
        for (const ExactFace& face : faces) {
            for (int side = 0; side < 4; ++side) {
                curves_.emplace_back(face.surface, side);
            }
        }
    }

    WeldedSides run(const Progress& progress) {
        weld_corners();
        std::vector<Piece> pieces;
        for (int face = 0; face < std::ssize(faces_); ++face) {
            progress.check();
            for (int side = 0; side < 4; ++side) {
                add_pieces(face, side, pieces);
            }
        }
        std::map<std::pair<int, int>, std::vector<Piece>> between;
        for (const Piece& piece : pieces) {
            between[std::minmax(piece.first, piece.last)].push_back(piece);
        }
        for (auto& [ends, same] : between) {
            progress.check();
            match(same);
        }
        return std::move(welded_);
    }

private:
    [[nodiscard]] const SideCurve& curve(int face, int side) const {
        return curves_[static_cast<std::size_t>(4 * face + side)];
    }
    [[nodiscard]] const SideCurve& curve(const Piece& of) const { return curve(of.face, of.side); }
    [[nodiscard]] int number(int face) const { return faces_[static_cast<std::size_t>(face)].number; }

    int point_at(const Vec3& corner) {
        for (std::size_t n = 0; n < welded_.points.size(); ++n) {
            if ((welded_.points[n] - corner).norm() <= tolerance_) {
                return static_cast<int>(n);
            }
        }
        welded_.points.push_back(corner);
        return static_cast<int>(welded_.points.size()) - 1;
    }

    void weld_corners() {
        for (int face = 0; face < std::ssize(faces_); ++face) {
            std::array<int, 4> corners{};
            int points = 0; // sides that are no more than that
            for (int side = 0; side < 4; ++side) {
                corners[static_cast<std::size_t>(side)] = point_at(curve(face, side).position(0.0));
                points += curve(face, side).length() <= tolerance_ ? 1 : 0;
            }
            if (points > 2) {
                throw Error(fmt::format("face {} is no larger than the tolerance of {} mm, at {}",
                                        number(face),
                                        tolerance_,
                                        place_text(curve(face, 0).position(0.0))),
                            {},
                            "leave it out, or choose a smaller tolerance");
            }
            welded_.corners.push_back(corners);
        }
    }

    /// The side, cut at the corners of other faces that lie on it.
    void add_pieces(int face, int side, std::vector<Piece>& pieces) const {
        const SideCurve& whole = curve(face, side);
        if (whole.length() <= tolerance_) {
            return;
        }
        const auto& corners = welded_.corners[static_cast<std::size_t>(face)];
        const int first = corners[static_cast<std::size_t>(side)];
        const int last = corners[static_cast<std::size_t>((side + 1) % 4)];
        std::vector<std::pair<double, int>> cuts{{0.0, first}, {1.0, last}};
        Box3 box = whole.box();
        box.extend(Vec3(box.min() - Vec3::Constant(tolerance_ + 0.01 * whole.length())));
        box.extend(Vec3(box.max() + Vec3::Constant(tolerance_ + 0.01 * whole.length())));
        for (int n = 0; n < std::ssize(welded_.points); ++n) {
            const Vec3& at = welded_.points[static_cast<std::size_t>(n)];
            if (n == first || n == last || !box.contains(at)) {
                continue;
            }
            if (const SideCurve::Foot foot = whole.nearest(at); foot.distance <= tolerance_) {
                cuts.emplace_back(foot.along, n);
            }
        }
        std::ranges::sort(cuts);
        for (std::size_t n = 1; n < cuts.size(); ++n) {
            pieces.push_back(
                {face, side, cuts[n - 1].second, cuts[n].second, cuts[n - 1].first, cuts[n].first});
        }
    }

    /// Along `piece` at a share of its length.
    [[nodiscard]] double along(const Piece& piece, double share) const {
        const SideCurve& side = curve(piece);
        const double from = side.length_at(piece.from), to = side.length_at(piece.to);
        return side.along_at(from + share * (to - from));
    }
    [[nodiscard]] Vec3 middle(const Piece& piece) const { return curve(piece).position(along(piece, 0.5)); }

    /// How far `piece` is at most from `master` at its quarters, mm.
    [[nodiscard]] double apart(const Piece& piece, const Piece& master) const {
        double most = 0.0;
        for (const double share : {0.25, 0.5, 0.75}) {
            const Vec3 at = curve(piece).position(along(piece, share));
            most = std::max(most, curve(master).nearest(at, master.from, master.to).distance);
        }
        return most;
    }

    /// Pieces between the same two points: those that run together become one border.
    void match(const std::vector<Piece>& pieces) {
        std::vector<std::vector<Piece>> groups;
        for (const Piece& piece : pieces) {
            const auto own = std::ranges::find_if(groups, [&](const std::vector<Piece>& group) {
                return apart(piece, group.front()) <= tolerance_;
            });
            if (own == groups.end()) {
                groups.push_back({piece});
            } else {
                own->push_back(piece);
            }
        }
        refuse_gaps(groups);
        for (const std::vector<Piece>& group : groups) {
            if (group.size() > 2) {
                refuse_narrow_faces(group);
                std::string names;
                for (const Piece& piece : group) {
                    names += fmt::format("{}{}", names.empty() ? "" : ", ", number(piece.face));
                }
                throw Error(fmt::format("more than two faces meet along one border: {}, at {}",
                                        names,
                                        place_text(middle(group.front()))),
                            {},
                            "choose two of them");
            }
            add_border(group);
        }
    }

    /// Of more than two pieces: where both long sides of a face are among them, it is the face that is wrong.
    void refuse_narrow_faces(const std::vector<Piece>& group) const {
        const auto is_short = [this](int face, int side) {
            return curve(face, side % 4).length() <= tolerance_;
        };
        for (std::size_t a = 0; a < group.size(); ++a) {
            for (std::size_t b = a + 1; b < group.size(); ++b) {
                const Piece &one = group[a], &other = group[b];
                if (one.face != other.face) {
                    continue;
                }
                const bool closes = std::abs(one.side - other.side) == 2 &&
                                    !is_short(one.face, one.side + 1) &&
                                    !is_short(one.face, one.side + 3); // such as a cylinder at its seam
                if (!closes) {
                    throw Error(fmt::format("face {} is narrower than the tolerance of {} mm, at {}",
                                            number(one.face),
                                            tolerance_,
                                            place_text(middle(one))),
                                {},
                                "leave it out, or choose a smaller tolerance");
                }
            }
        }
    }

    /// A sliver between two borders that end at the same points is no hole that anyone wants.
    void refuse_gaps(const std::vector<std::vector<Piece>>& groups) const {
        constexpr double narrow = 0.1; // of the border's length
        for (std::size_t a = 0; a < groups.size(); ++a) {
            for (std::size_t b = a + 1; b < groups.size(); ++b) {
                const Piece& one = groups[a].front();
                const Piece& other = groups[b].front();
                const double length = curve(one).length_at(one.to) - curve(one).length_at(one.from);
                const double gap = apart(one, other);
                if (groups[a].size() == 1 && groups[b].size() == 1 && one.face != other.face &&
                    gap < narrow * length) {
                    throw Error(fmt::format("the borders of faces {} and {} are {:.4f} mm apart, at {}",
                                            number(one.face),
                                            number(other.face),
                                            gap,
                                            place_text(middle(one))),
                                {},
                                fmt::format("choose a tolerance above {:.4f} mm", gap));
                }
            }
        }
    }

    void add_border(const std::vector<Piece>& group) {
        const Piece& master = group.front();
        const double length = curve(master).length_at(master.to) - curve(master).length_at(master.from);
        constexpr double least_steps = 3.0, most_steps = 2000.0;
        const int steps =
            static_cast<int>(std::clamp(std::round(length / spacing_), least_steps, most_steps));
        FaceBorder border;
        FaceBorder::Side own{master.face, master.side, {}};
        for (int n = 0; n <= steps; ++n) {
            const bool inner = n > 0 && n < steps;
            own.along.push_back(n == 0       ? master.from
                                : n == steps ? master.to
                                             : along(master, static_cast<double>(n) / steps));
            border.points.push_back(n == 0 ? master.first : master.last);
            if (inner) {
                border.points.back() = static_cast<int>(welded_.points.size());
                welded_.points.push_back(curve(master).position(own.along.back()));
            }
        }
        border.sides.push_back(std::move(own));
        if (group.size() == 2) {
            border.sides.push_back(second_side(group[1], border));
        }
        welded_.borders.push_back(std::move(border));
    }

    [[nodiscard]] FaceBorder::Side second_side(const Piece& piece, const FaceBorder& border) const {
        FaceBorder::Side side{piece.face, piece.side, {}};
        const std::size_t last = border.points.size() - 1;
        for (std::size_t n = 1; n < last; ++n) {
            const Vec3& at = welded_.points[static_cast<std::size_t>(border.points[n])];
            const SideCurve::Foot foot = curve(piece).nearest(at, piece.from, piece.to);
            if (foot.distance > tolerance_) {
                throw Error(fmt::format("the borders of faces {} and {} are {:.4f} mm apart, at {}",
                                        number(border.sides.front().face),
                                        number(piece.face),
                                        foot.distance,
                                        place_text(at)),
                            {},
                            fmt::format("choose a tolerance above {:.4f} mm", foot.distance));
            }
            side.along.push_back(foot.along);
        }
        const bool rises = side.along.front() < side.along.back();
        side.along.insert(side.along.begin(), rises ? piece.from : piece.to);
        side.along.push_back(rises ? piece.to : piece.from);
        const auto out_of_order = [rises](double a, double b) { return rises ? b <= a : b >= a; };
        if (std::ranges::adjacent_find(side.along, out_of_order) != side.along.end()) {
            throw Error(fmt::format("the borders of faces {} and {} turn back within the tolerance, at {}",
                                    number(border.sides.front().face),
                                    number(piece.face),
                                    place_text(middle(piece))),
                        {},
                        "choose a smaller tolerance");
        }
        return side;
    }

    std::span<const ExactFace> faces_;
    double tolerance_, spacing_;
    std::vector<SideCurve> curves_;
    WeldedSides welded_;
};

} // namespace

std::string place_text(const Vec3& at) {
    return fmt::format("x {:.3f}, y {:.3f}, z {:.3f} mm", at.x(), at.y(), at.z());
}

WeldedSides
weld_sides(std::span<const ExactFace> faces, double tolerance, double spacing, const Progress& progress) {
    return Welding(faces, tolerance, spacing).run(progress);
}

} // namespace millwright::region
