#include "core/simulation/removal.h"

#include "core/base/error.h"
#include "core/base/parallel.h"
#include "core/simulation/internal/tile_cutter.h"

#include <algorithm>
#include <cmath>

namespace millwright::simulation {

namespace {

constexpr std::size_t steps_per_batch = 2048;

/// Smaller by `distance`, measured by the normal, along bottom, corner and flank; at most by half the radius.
toolpath::ProfileShape inset(toolpath::ProfileShape shape, double distance) {
    const double less = std::min(distance, 0.5 * shape.radius);
    const double sine = std::sin(shape.half_angle), cosine = std::cos(shape.half_angle);
    const double of_corner = std::min(less, shape.corner);
    const double rest = less - of_corner; // the corner is used up: bottom and flank meet farther in
    const double of_flat = std::min(rest * (1.0 - sine) / cosine, shape.flat);
    const double still = rest - of_flat * cosine - rest * sine; // of the flank, above 0 at a sharp tip
    constexpr double rounding = 1e-12;                          // mm
    const double raised = still > rounding && sine > 0.0 ? still / sine : 0.0;
    shape.corner -= of_corner;
    shape.flat -= of_flat;
    shape.radius -= less;
    shape.bottom += less + raised;
    shape.top -= less;
    return shape;
}

geometry::ToolPose
between(const geometry::ToolPose& from, const geometry::ToolPose& to, double turn, double f) {
    const Vec3 tip = from.tip + f * (to.tip - from.tip);
    if (turn <= 0.0) {
        return {tip, from.axis};
    }
    const Vec3 across = (to.axis - to.axis.dot(from.axis) * from.axis).normalized();
    return {tip, Vec3(std::cos(f * turn) * from.axis + std::sin(f * turn) * across).normalized()};
}

/// A tile and the steps of a batch that may reach it.
struct TileWork {
    int k = 0, i = 0, j = 0;
    std::vector<std::uint32_t> steps;
    std::vector<TileCut> cuts;
};

/// The tiles that a batch may reach, in a fixed order.
class WorkList {
public:
    explicit WorkList(const DexelField& field) : field_(field) {
        for (int k = 0; k < 3; ++k) {
            const auto [columns, rows] = field.tile_count(k);
            place_[static_cast<std::size_t>(k)].assign(
                static_cast<std::size_t>(columns) * static_cast<std::size_t>(rows), -1);
        }
    }
    void add(const Box3& bounds, std::uint32_t step) {
        const Box3& box = field_.box();
        if (!bounds.intersects(box)) {
            return;
        }
        for (int k = 0; k < 3; ++k) {
            const int u = (k + 1) % 3, v = (k + 2) % 3;
            const auto [columns, rows] = field_.tile_count(k);
            const auto [i0, i1] = range(bounds, u, columns);
            const auto [j0, j1] = range(bounds, v, rows);
            for (int j = j0; j <= j1; ++j) {
                for (int i = i0; i <= i1; ++i) {
                    auto& place = place_[static_cast<std::size_t>(k)]
                                        [static_cast<std::size_t>(j) * static_cast<std::size_t>(columns) +
                                         static_cast<std::size_t>(i)];
                    if (place < 0) {
                        place = static_cast<std::ptrdiff_t>(work.size());
                        work.push_back({k, i, j, {}, {}});
                    }
                    work[static_cast<std::size_t>(place)].steps.push_back(step);
                }
            }
        }
    }
    std::vector<TileWork> work;

private:
    [[nodiscard]] std::array<int, 2> range(const Box3& bounds, int axis, int tiles) const {
        const double side = field_.cell()[axis] * Tile::side;
        const double from = (bounds.min()[axis] - field_.box().min()[axis]) / side;
        const double to = (bounds.max()[axis] - field_.box().min()[axis]) / side;
        const double last = tiles - 1;
        return {static_cast<int>(std::clamp(std::floor(from), 0.0, last)),
                static_cast<int>(std::clamp(std::floor(to), 0.0, last))};
    }

    const DexelField& field_;
    std::array<std::vector<std::ptrdiff_t>, 3> place_;
};

} // namespace

CuttingBody::CuttingBody(const toolpath::Profile& profile)
    : body(profile.shape()), core(inset(profile.shape(), contact_depth)) {}

double step_count(const CuttingBody& cutter, const geometry::ToolPose& from, const geometry::ToolPose& to) {
    const toolpath::ProfileShape& shape = cutter.body.shape();
    const Vec3 way = to.tip - from.tip;
    const double longest = 0.5 * shape.radius; // longer steps reach too many tiles
    constexpr double least = 1e-3;             // mm
    const double highest = std::max(0.5 * (shape.top - shape.bottom), least); // so that no line is passed
    return std::max({1.0,
                     std::ceil(angle_between(from.axis, to.axis) / largest_turn),
                     std::ceil(way.norm() / longest),
                     std::ceil(std::abs(way.dot(from.axis)) / highest)});
}

void divide(const CuttingBody& cutter,
            const geometry::ToolPose& from,
            const geometry::ToolPose& to,
            std::int32_t move,
            bool contact_counts,
            std::vector<CutStep>& steps) {
    const double turn = angle_between(from.axis, to.axis);
    const double wanted = step_count(cutter, from, to);
    expects(wanted <= most_steps_per_move, "a move of a cutter is not so long");
    const int count = static_cast<int>(wanted);
    geometry::ToolPose last = from;
    for (int n = 1; n <= count; ++n) {
        const geometry::ToolPose next =
            n == count ? to : between(from, to, turn, static_cast<double>(n) / count);
        steps.push_back({&cutter, last, next, move, contact_counts});
        last = next;
    }
}

void Removal::remove(std::span<const CutStep> steps, const Progress& progress) {
    for (std::size_t done = 0; done < steps.size(); done += steps_per_batch) {
        progress.report(static_cast<double>(done) / static_cast<double>(steps.size()));
        remove_batch(steps.subspan(done, std::min(steps_per_batch, steps.size() - done)), progress);
    }
    progress.report(1.0);
}

void Removal::record_from(std::int32_t move) {
    first_recorded_ = move;
    cuts_.erase(cuts_.lower_bound(move), cuts_.end());
    for (auto* contacts : {&shank_contacts_, &holder_contacts_}) {
        contacts->erase(contacts->lower_bound(move), contacts->end());
    }
}

void Removal::remove_batch(std::span<const CutStep> steps, const Progress& progress) {
    std::vector<ReadyStep> ready;
    ready.reserve(steps.size());
    WorkList list(field_);
    for (const CutStep& step : steps) {
        ready.emplace_back(step, field_.cell());
        list.add(ready.back().bounds, static_cast<std::uint32_t>(ready.size() - 1));
    }
    parallel_for(std::ssize(list.work), 1, [&](std::ptrdiff_t n) {
        TileWork& work = list.work[static_cast<std::size_t>(n)];
        TileCutter cutter(field_, work.k, work.i, work.j);
        TileCut found;
        for (std::size_t s = 0; s < work.steps.size(); ++s) {
            constexpr std::size_t steps_per_check = 256;
            if (s % steps_per_check == 0) {
                progress.check();
            }
            if (cutter.cut(ready[work.steps[s]], found)) {
                if (!work.cuts.empty() && work.cuts.back().move == found.move &&
                    work.cuts.back().part == found.part) {
                    TileCut& last = work.cuts.back();
                    last.length += found.length;
                    last.engaged.extend(found.engaged);
                    if (found.contact && (!last.contact || found.contact->length > last.contact->length)) {
                        last.contact = found.contact;
                    }
                } else {
                    work.cuts.push_back(found);
                }
            }
        }
    });
    for (const TileWork& work : list.work) {
        const Vec3& cell = field_.cell();
        const double area = cell[(work.k + 1) % 3] * cell[(work.k + 2) % 3];
        for (const TileCut& cut : work.cuts) {
            if (cut.move < first_recorded_) {
                continue;
            }
            if (cut.part != ToolPart::cutter) {
                auto& contacts = cut.part == ToolPart::shank ? shank_contacts_ : holder_contacts_;
                const auto [known, is_new] = contacts.emplace(cut.move, *cut.contact);
                if (!is_new && cut.contact->length > known->second.length) {
                    known->second = *cut.contact;
                }
                continue;
            }
            MoveCut& sum = cuts_[cut.move];
            sum.volume += cut.length * area / 3.0;
            sum.engaged.extend(cut.engaged);
            if (cut.contact && (!sum.contact || cut.contact->length > sum.contact->length)) {
                sum.contact = cut.contact;
            }
        }
    }
}

} // namespace millwright::simulation
