#include "core/toolpath/swept_cut.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/parallel.h"
#include "core/base/units.h"
#include "core/geometry/closest_point.h"
#include "core/toolpath/actual_trajectory.h"
#include "core/toolpath/body_clearance.h"
#include "core/toolpath/profile.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::toolpath {

namespace {

struct SurfacePoint {
    Vec2 uv = Vec2::Zero();
    Vec3 position = Vec3::Zero();
    Vec3 normal = Vec3::Zero(); ///< on the side of the tool
    std::size_t index = 0;      ///< in the raster
};

/// Neighbouring points in a ball: a body that is far from the middle is far from all.
struct Tile {
    Vec3 middle = Vec3::Zero();
    double radius = 0.0;
    std::vector<SurfacePoint> points;
};

void enclose(Tile& tile) {
    Box3 box;
    for (const SurfacePoint& point : tile.points) {
        box.extend(point.position);
    }
    tile.middle = box.center();
    for (const SurfacePoint& point : tile.points) {
        tile.radius = std::max(tile.radius, (point.position - tile.middle).norm());
    }
}

Tile tile_at(const geometry::ParametricSurface& patch,
             bool flipped,
             const SweepSettings& raster,
             int first_i,
             int first_j,
             int side) {
    Tile tile;
    for (int i = first_i; i < std::min(first_i + side, raster.nu); ++i) {
        for (int j = first_j; j < std::min(first_j + side, raster.nv); ++j) {
            const Vec2 uv(static_cast<double>(i) / (raster.nu - 1), static_cast<double>(j) / (raster.nv - 1));
            if (const auto [position, normal] = patch.point(uv.x(), uv.y()); normal) {
                const auto index = static_cast<std::size_t>(i) * static_cast<std::size_t>(raster.nv) +
                                   static_cast<std::size_t>(j);
                tile.points.push_back({uv, position, flipped ? Vec3(-*normal) : *normal, index});
            }
        }
    }
    enclose(tile);
    return tile;
}

std::vector<Tile>
tiles_of(const geometry::ParametricSurface& patch, bool flipped, const SweepSettings& raster) {
    constexpr int side = 6;
    std::vector<Tile> tiles;
    for (int i = 0; i < raster.nu; i += side) {
        for (int j = 0; j < raster.nv; j += side) {
            tiles.push_back(tile_at(patch, flipped, raster, i, j, side));
        }
    }
    return tiles;
}

/// Looks at a move so often that neither the tip goes farther than `step` between two, nor the axis a degree.
int looks_at(const kinematics::MachineModel& machine, const SweptMove& move, double step) {
    constexpr int coarse = 9;
    constexpr double most = 5000.0;
    const auto poses = actual_poses(machine, move.from, move.to, coarse);
    double way = 0.0;
    double turn = 0.0;
    for (std::size_t n = 1; n < poses.size(); ++n) {
        way += (poses[n].tip - poses[n - 1].tip).norm();
        turn += angle_between(poses[n].axis, poses[n - 1].axis);
    }
    return static_cast<int>(std::clamp(std::ceil(std::max(way / step, turn / from_degrees(1.0))), 1.0, most));
}

/// The height over one point that a move leaves.
struct Left {
    std::size_t index = 0;
    double height = infinity;
};

/// What one move finds, before it is put together with the others.
struct Found {
    std::vector<Left> left;
    MoveBites bites;
};

/// The lowest point of a body so far, with its pose for a sharper look.
struct Lowest {
    double height = 0.0; ///< below 0 only
    SurfacePoint at;
    geometry::ToolPose pose;
};

/// Whether `point` is farther than `limit` from the body: by the cylinder around it, rounded below as its
/// corner is (not around a flank, which may leave the rounding). Cheap, and never wrong where it says so.
bool is_far(const Profile& body, const geometry::ToolPose& pose, const Vec3& point, double limit) {
    constexpr double rounding = 1e-6; // mm
    const ProfileShape& shape = body.shape();
    const double corner = shape.half_angle > 0.0 ? 0.0 : shape.corner;
    const double margin = limit + corner + rounding;
    const Vec3 from_tip = point - pose.tip;
    const double z = from_tip.dot(pose.axis);
    const double above = std::max({shape.bottom + corner - z, z - shape.top, 0.0});
    const double rho = std::sqrt(std::max(from_tip.squaredNorm() - square(z), 0.0));
    const double beside = std::max(rho - (shape.radius - corner), 0.0);
    return square(above) + square(beside) > square(margin);
}

/// How far a point of the body is at most in one pose from where it is in the other.
double displacement(const Profile& body, const geometry::ToolPose& a, const geometry::ToolPose& b) {
    const ProfileShape& shape = body.shape();
    const double reach = std::hypot(std::max(std::abs(shape.bottom), std::abs(shape.top)), shape.radius);
    return (a.tip - b.tip).norm() + reach * (a.axis - b.axis).norm();
}

/// One move against the surface.
class Sweep {
public:
    Sweep(const std::vector<Tile>& tiles, const Tool& tool, double highest)
        : tiles_(tiles), tool_(tool), highest_(highest), heights_(tiles.size()), lowest_at_(tiles.size()) {}

    /// At a few poses that follow each other; `first`: which look of the move the first of them is.
    void look(std::span<const geometry::ToolPose> poses, int first) {
        const std::vector<std::size_t> to_cut = tiles_near(*tool_.cutter, poses, highest_);
        const std::vector<std::size_t> to_hit =
            tool_.holder ? tiles_near(*tool_.holder, poses, 0.0) : std::vector<std::size_t>{};
        int look = first;
        for (const geometry::ToolPose& pose : poses) {
            for (const std::size_t tile : to_cut) {
                if (within(*tool_.cutter, pose, tiles_[tile], highest_)) {
                    cut(pose, tile, look);
                }
            }
            ++look;
            for (const std::size_t tile : to_hit) {
                if (within(*tool_.holder, pose, tiles_[tile], 0.0)) {
                    hit(pose, tiles_[tile]);
                }
            }
        }
    }

    /// The least height of each point, around the look that found it: `pose_at` takes looks and parts of one.
    template <class PoseAt> void look_between(const PoseAt& pose_at, int looks) {
        for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
            for (std::size_t n = 0; n < heights_[tile].size(); ++n) {
                if (heights_[tile][n] < highest_) {
                    descend(pose_at, looks, tiles_[tile].points[n], heights_[tile][n], lowest_at_[tile][n]);
                }
            }
        }
    }

    [[nodiscard]] Found found(const geometry::ParametricSurface& patch) const {
        Found result;
        for (std::size_t tile = 0; tile < tiles_.size(); ++tile) {
            for (std::size_t n = 0; n < heights_[tile].size(); ++n) {
                if (heights_[tile][n] < highest_) {
                    result.left.push_back({tiles_[tile].points[n].index, heights_[tile][n]});
                }
            }
        }
        result.bites.cutter = sharpened(patch, *tool_.cutter, by_cutter_);
        if (tool_.holder) {
            result.bites.holder = sharpened(patch, *tool_.holder, by_holder_);
        }
        return result;
    }

private:
    /// Those that the body may come nearer to than `limit` in one of the poses.
    [[nodiscard]] std::vector<std::size_t>
    tiles_near(const Profile& body, std::span<const geometry::ToolPose> poses, double limit) const {
        const geometry::ToolPose& middle = poses[poses.size() / 2];
        double farthest = 0.0;
        for (const geometry::ToolPose& pose : poses) {
            farthest = std::max(farthest, displacement(body, pose, middle));
        }
        std::vector<std::size_t> found;
        for (std::size_t n = 0; n < tiles_.size(); ++n) {
            if (!is_far(body, middle, tiles_[n].middle, limit + tiles_[n].radius + farthest)) {
                found.push_back(n);
            }
        }
        return found;
    }

    static bool within(const Profile& body, const geometry::ToolPose& pose, const Tile& tile, double limit) {
        return !is_far(body, pose, tile.middle, limit + tile.radius) &&
               distance(body, pose, tile.middle) - tile.radius < limit;
    }

    void cut(const geometry::ToolPose& pose, std::size_t tile, int look) {
        const std::vector<SurfacePoint>& points = tiles_[tile].points;
        heights_[tile].resize(points.size(), highest_);
        lowest_at_[tile].resize(points.size());
        for (std::size_t n = 0; n < points.size(); ++n) {
            if (lower(pose, points[n], heights_[tile][n])) {
                lowest_at_[tile][n] = look;
            }
        }
    }

    /// True if the cutter in `pose` begins below `height` over the point, which it then lowers.
    bool lower(const geometry::ToolPose& pose, const SurfacePoint& point, double& height) {
        const double nearer = std::max(height, 0.0); // the height is not below the distance
        if (is_far(*tool_.cutter, pose, point.position, nearer) ||
            distance(*tool_.cutter, pose, point.position) >= nearer) {
            return false;
        }
        const double found = height_below(*tool_.cutter, pose, point.position, point.normal, height);
        if (!(found < height)) {
            return false;
        }
        height = found;
        note(by_cutter_, height, point, pose);
        return true;
    }

    /// By golden sections of what is left and right of the lowest look, as far as the next ones.
    template <class PoseAt>
    void descend(const PoseAt& pose_at, int looks, const SurfacePoint& point, double& height, int lowest) {
        constexpr double golden = 0.381966;
        constexpr double near_enough = 1e-3; // of a look
        double from = std::max(lowest - 1, 0);
        double at = lowest;
        double to = std::min(lowest + 1, looks);
        while (to - from > near_enough) {
            const bool right = to - at > at - from;
            const double other = right ? at + golden * (to - at) : at - golden * (at - from);
            if (lower(pose_at(other), point, height)) {
                (right ? from : to) = std::exchange(at, other);
            } else {
                (right ? to : from) = other;
            }
        }
    }

    void hit(const geometry::ToolPose& pose, const Tile& tile) {
        for (const SurfacePoint& point : tile.points) {
            if (!is_far(*tool_.holder, pose, point.position, 0.0) &&
                distance(*tool_.holder, pose, point.position) < 0.0) {
                note(by_holder_, height_over(*tool_.holder, pose, point.position, point.normal), point, pose);
            }
        }
    }

    static void
    note(Lowest& lowest, double height, const SurfacePoint& point, const geometry::ToolPose& pose) {
        if (height < lowest.height) {
            lowest = {height, point, pose};
        }
    }

    static Bite
    sharpened(const geometry::ParametricSurface& patch, const Profile& body, const Lowest& lowest) {
        if (lowest.height >= 0.0) {
            return {};
        }
        const BodyClearance sharp = clearance_near(patch, body, lowest.pose, lowest.at.uv);
        if (sharp.distance < lowest.height) {
            return {-sharp.distance,
                    sharp.parameters,
                    patch.position(sharp.parameters.x(), sharp.parameters.y())};
        }
        return {-lowest.height, lowest.at.uv, lowest.at.position};
    }

    const std::vector<Tile>& tiles_;
    const Tool& tool_;
    double highest_ = 0.0;
    std::vector<std::vector<double>> heights_; // of the points of each tile; none where it was never near
    std::vector<std::vector<int>> lowest_at_;  // the look that found each
    Lowest by_cutter_, by_holder_;
};

void look_along(Sweep& sweep,
                const kinematics::MachineModel& machine,
                const SweptMove& move,
                int looks,
                const Progress& progress) {
    constexpr std::size_t at_once = 16; // poses that share a look at all tiles: near to each other
    std::vector<geometry::ToolPose> poses;
    for (int k = 0; k <= looks; ++k) {
        poses.push_back(actual_pose(machine, move.from, move.to, static_cast<double>(k) / looks));
        if (poses.size() == at_once || k == looks) {
            progress.check();
            sweep.look(poses, k + 1 - static_cast<int>(poses.size()));
            poses.clear();
        }
    }
}

/// Where the cutter goes through the surface and out of sight below it, no point of the surface on its way
/// tells how deep its end is. The ball of the corner's radius around `pose`'s core lies in the body.
class Buried {
public:
    Buried(const geometry::ParametricSurface& patch, bool flipped, const Profile& cutter)
        : patch_(patch), flipped_(flipped), shape_(cutter.shape()), search_(patch) {}

    /// Less deep bites come from no core below the surface.
    [[nodiscard]] bool may_follow(const Bite& bite) const {
        constexpr double least = 0.05; // mm
        return bite.depth > std::max(0.5 * shape_.corner, least);
    }

    /// The deeper of `bite` and the ball in that pose.
    [[nodiscard]] Bite deeper(const Bite& bite, const geometry::ToolPose& pose) const {
        const Vec3 core = pose.tip + (shape_.bottom + shape_.corner) * pose.axis;
        const geometry::ClosestPoint foot = search_.closest(core, bite.uv);
        const auto normal = patch_.unit_normal(foot.parameters.x(), foot.parameters.y());
        const double below = normal ? (foot.position - core).dot(flipped_ ? Vec3(-*normal) : *normal) : 0.0;
        constexpr double square_on = 0.999; // else the core is beside the part
        if (below < square_on * foot.distance || below + shape_.corner <= bite.depth) {
            return bite;
        }
        return {below + shape_.corner, foot.parameters, foot.position};
    }

private:
    const geometry::ParametricSurface& patch_;
    bool flipped_;
    const ProfileShape& shape_;
    geometry::ClosestPointSearch search_;
};

} // namespace

SweptCut swept_cut(const geometry::ParametricSurface& patch,
                   bool flipped,
                   const kinematics::MachineModel& machine,
                   const Tool& tool,
                   std::span<const SweptMove> moves,
                   const SweepSettings& settings,
                   const Progress& progress) {
    expects(tool.cutter.has_value(), "a tool without a cutter sweeps nothing");
    expects(settings.nu >= 2 && settings.nv >= 2 && settings.step > 0.0 && settings.highest > 0.0,
            "a raster has at least two points in each direction, and positive steps and heights");
    const std::vector<Tile> tiles = tiles_of(patch, flipped, settings);
    const Buried buried(patch, flipped, *tool.cutter);
    SweptCut cut{settings.nu, settings.nv, {}, {}};
    cut.heights.assign(static_cast<std::size_t>(settings.nu) * static_cast<std::size_t>(settings.nv),
                       infinity);
    cut.moves.resize(moves.size());
    constexpr std::ptrdiff_t at_once = 64; // moves whose findings are held before they are put together
    for (std::ptrdiff_t first = 0; first < std::ssize(moves); first += at_once) {
        const std::ptrdiff_t count = std::min(at_once, std::ssize(moves) - first);
        std::vector<Found> found(static_cast<std::size_t>(count));
        parallel_for(count, 1, [&](std::ptrdiff_t n) {
            const SweptMove& move = moves[static_cast<std::size_t>(first + n)];
            Sweep sweep(tiles, tool, settings.highest);
            constexpr double hits_only =
                4.0; // a hit is not missed by coarser steps, a scallop would be wrong
            const double step = move.cuts ? settings.step : hits_only * settings.step;
            const int looks = looks_at(machine, move, step);
            look_along(sweep, machine, move, looks, progress);
            if (settings.between_looks && move.cuts) {
                progress.check();
                sweep.look_between(
                    [&](double look) { return actual_pose(machine, move.from, move.to, look / looks); },
                    looks);
            }
            Found& of_move = found[static_cast<std::size_t>(n)];
            of_move = sweep.found(patch);
            for (int k = 0; k <= looks && buried.may_follow(of_move.bites.cutter); ++k) {
                progress.check();
                of_move.bites.cutter =
                    buried.deeper(of_move.bites.cutter,
                                  actual_pose(machine, move.from, move.to, static_cast<double>(k) / looks));
            }
        });
        for (std::ptrdiff_t n = 0; n < count; ++n) {
            const auto move = static_cast<std::size_t>(first + n);
            const Found& of_move = found[static_cast<std::size_t>(n)];
            cut.moves[move] = of_move.bites;
            for (const Left& left : moves[move].cuts ? of_move.left : std::vector<Left>{}) {
                cut.heights[left.index] = std::min(cut.heights[left.index], left.height);
            }
        }
        progress.report(static_cast<double>(first + count) / static_cast<double>(moves.size()));
    }
    return cut;
}

} // namespace millwright::toolpath
