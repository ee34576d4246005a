#include "core/toolpath/trimmed_path.h"

#include "core/base/error.h"
#include "core/toolpath/internal/contact_point.h"

#include <optional>
#include <utility>

namespace millwright::toolpath {

namespace {

using geometry::Trim;
using geometry::WayPart;

bool is_whole(const std::vector<WayPart>& parts) {
    return parts.size() == 1 && !(parts.front().from > 0.0) && !(parts.front().to < 1.0);
}

class Trimmer {
public:
    Trimmer(const geometry::ParametricSurface& patch, const Trim& trim, const Toolpath& whole, bool flipped)
        : patch_(patch), outline_(trim), whole_(whole), flipped_(flipped) {
        kept_.direction = whole.direction;
        kept_.tool = whole.tool;
    }

    [[nodiscard]] Toolpath take() && {
        for (std::size_t n = 1; n < whole_.points.size(); ++n) {
            if (whole_.points[n].reached_by == MoveKind::track) {
                keep_of_move(n);
            }
        }
        return std::move(kept_);
    }

private:
    /// Of the move to point `n`.
    void keep_of_move(std::size_t n) {
        const PathPoint& a = whole_.points[n - 1];
        const PathPoint& b = whole_.points[n];
        for (const WayPart& part : outline_.parts_inside(a.origin.uv, b.origin.uv)) {
            const bool from_start = !(part.from > 0.0);
            if (!from_start || last_whole_ != n - 1) { // else the piece goes on
                begin(from_start ? with_normal(a) : between(a, b, part.from), from_start ? n - 1 : 0);
            }
            const bool to_end = !(part.to < 1.0);
            PathPoint end = to_end ? with_normal(b) : between(a, b, part.to);
            end.reached_by = MoveKind::track;
            kept_.points.push_back(end);
            last_whole_ = to_end ? std::optional(n) : std::nullopt;
        }
    }

    /// A piece of track begins: at point `n` of the whole path, or at a place of its own for 0.
    void begin(PathPoint point, std::size_t n) {
        point.reached_by = kept_.points.empty() ? MoveKind::start
                           : is_link(point, n)  ? MoveKind::cross
                                                : MoveKind::over;
        kept_.points.push_back(point);
    }

    [[nodiscard]] bool is_link(const PathPoint& to, std::size_t n) const {
        return n > 0 && last_whole_ == n - 1 && whole_.points[n].reached_by == MoveKind::cross &&
               is_whole(outline_.parts_inside(kept_.points.back().origin.uv, to.origin.uv));
    }

    [[nodiscard]] PathPoint with_normal(const PathPoint& point) const {
        if (!point.normal.isZero()) {
            return point;
        }
        PathPoint touched = contact_point(patch_, point.origin.uv, flipped_);
        touched.origin = point.origin;
        return touched;
    }

    [[nodiscard]] PathPoint between(const PathPoint& a, const PathPoint& b, double share) const {
        PathPoint point = contact_point(patch_, a.origin.uv + share * (b.origin.uv - a.origin.uv), flipped_);
        const GridOrigin& nearest = share < 0.5 ? a.origin : b.origin;
        point.origin.i = nearest.i;
        point.origin.j = nearest.j;
        return point;
    }

    const geometry::ParametricSurface& patch_;
    geometry::OutlineTree outline_;
    const Toolpath& whole_;
    bool flipped_;
    Toolpath kept_;
    std::optional<std::size_t> last_whole_; ///< that point of the whole path is the last one that is kept
};

} // namespace

PathPoint point_to_trim(const geometry::ParametricSurface& patch,
                        const geometry::OutlineTree* outline,
                        const Vec2& uv,
                        bool flipped) {
    if (outline == nullptr || outline->contains(uv)) {
        return contact_point(patch, uv, flipped);
    }
    PathPoint point;
    point.contact = patch.position(uv.x(), uv.y());
    point.normal = Vec3::Zero();
    point.pose.tip = point.contact;
    point.origin.uv = uv;
    return point;
}

Toolpath
trimmed(const geometry::ParametricSurface& patch, const Trim& trim, Toolpath contacts, bool flipped) {
    if (trim.everything()) {
        return contacts;
    }
    Toolpath kept = Trimmer(patch, trim, contacts, flipped).take();
    if (kept.points.empty()) {
        throw Error("no track meets the part of the patch inside its outline",
                    {},
                    "use more tracks, or the other direction");
    }
    return kept;
}

} // namespace millwright::toolpath
