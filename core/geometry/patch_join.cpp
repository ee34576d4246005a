#include "core/geometry/patch_join.h"

#include "core/base/error.h"
#include "core/geometry/patch_refinement.h"

#include <Eigen/QR>
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <optional>
#include <utility>

namespace millwright::geometry {

namespace {

bool is_along_v(Side side) {
    return side == Side::u_start || side == Side::u_end;
}

/// Index of the k-th control point along the side, `depth` rows away from it.
std::size_t index_on(const ControlNet& net, Side side, int k, int depth) {
    switch (side) {
    case Side::u_start:
        return net.index(depth, k);
    case Side::u_end:
        return net.index(net.rows - 1 - depth, k);
    case Side::v_start:
        return net.index(k, depth);
    case Side::v_end:
        break;
    }
    return net.index(k, net.columns - 1 - depth);
}

int count_along(const ControlNet& net, Side side) {
    return is_along_v(side) ? net.columns : net.rows;
}

int degree_across(const ControlNet& net, Side side) {
    return (is_along_v(side) ? net.rows : net.columns) - 1;
}

/// Until both sides of every seam have the same degree.
std::vector<ControlNet> with_equal_degrees(const std::vector<BezierPatch>& patches,
                                           const std::vector<Seam>& seams) {
    std::vector<Vec2> degrees;
    for (const BezierPatch& patch : patches) {
        degrees.emplace_back(patch.degree_u(), patch.degree_v());
    }
    const auto along = [&](const PatchSide& side) -> double& {
        return degrees[static_cast<std::size_t>(side.patch)][is_along_v(side.side) ? 1 : 0];
    };
    for (bool changed = true; changed;) {
        changed = false;
        for (const Seam& seam : seams) {
            const double most = std::max(along(seam.a), along(seam.b));
            changed = changed || along(seam.a) < most || along(seam.b) < most;
            along(seam.a) = along(seam.b) = most;
        }
    }
    std::vector<ControlNet> nets;
    for (std::size_t n = 0; n < patches.size(); ++n) {
        nets.push_back(
            elevated(patches[n], static_cast<int>(degrees[n].x()), static_cast<int>(degrees[n].y())).net());
    }
    return nets;
}

/// The control points of a seam: edge and next row on both sides, as numbers among all of them.
struct SeamRows {
    std::vector<std::array<std::size_t, 4>> points; ///< a's next row, a's edge, b's edge, b's next row
    double across_a = 1.0, across_b = 1.0;          ///< degrees
};

class Net {
public:
    explicit Net(std::vector<ControlNet> nets) : nets_(std::move(nets)) {
        for (const ControlNet& net : nets_) {
            first_.push_back(count_);
            count_ += net.points.size();
        }
    }
    [[nodiscard]] const Vec3& point(std::size_t n) const {
        const std::size_t patch = patch_of(n);
        return nets_[patch].points[n - first_[patch]];
    }
    void move(std::size_t n, const Vec3& by) {
        const std::size_t patch = patch_of(n);
        nets_[patch].points[n - first_[patch]] += by;
    }
    [[nodiscard]] std::size_t count() const { return count_; }
    [[nodiscard]] const std::vector<ControlNet>& nets() const { return nets_; }

    [[nodiscard]] SeamRows rows_of(const Seam& seam) const {
        const ControlNet& a = nets_[static_cast<std::size_t>(seam.a.patch)];
        const ControlNet& b = nets_[static_cast<std::size_t>(seam.b.patch)];
        const std::size_t from_a = first_[static_cast<std::size_t>(seam.a.patch)];
        const std::size_t from_b = first_[static_cast<std::size_t>(seam.b.patch)];
        SeamRows rows;
        rows.across_a = degree_across(a, seam.a.side);
        rows.across_b = degree_across(b, seam.b.side);
        const int count = count_along(a, seam.a.side);
        for (int k = 0; k < count; ++k) {
            const int of_b = seam.reversed ? count - 1 - k : k;
            rows.points.push_back({from_a + index_on(a, seam.a.side, k, 1),
                                   from_a + index_on(a, seam.a.side, k, 0),
                                   from_b + index_on(b, seam.b.side, of_b, 0),
                                   from_b + index_on(b, seam.b.side, of_b, 1)});
        }
        return rows;
    }

private:
    [[nodiscard]] std::size_t patch_of(std::size_t n) const {
        return static_cast<std::size_t>(std::ranges::upper_bound(first_, n) - first_.begin()) - 1;
    }

    std::vector<ControlNet> nets_;
    std::vector<std::size_t> first_;
    std::size_t count_ = 0;
};

/// Of the derivative across b to that across a, as the nets have it; nothing where they fold back.
std::optional<double> ratio_of(const Net& net, const SeamRows& rows) {
    double product = 0.0;
    double squared = 0.0;
    for (const auto& [before, a, b, behind] : rows.points) {
        const Vec3 out_of_a = rows.across_a * (net.point(a) - net.point(before));
        const Vec3 into_b = rows.across_b * (net.point(behind) - net.point(b));
        product += out_of_a.dot(into_b);
        squared += out_of_a.squaredNorm();
    }
    return product > 0.0 ? std::optional(product / squared) : std::nullopt;
}

bool are_joined(const std::vector<Seam>& seams, int a, int b) {
    return std::ranges::any_of(seams, [&](const Seam& seam) {
        return (seam.a.patch == a && seam.b.patch == b) || (seam.a.patch == b && seam.b.patch == a);
    });
}

/// Where four patches meet, whether the seam `t` goes on from `s`: 1 in the same sense, -1 against it, 0 not.
int goes_on(const std::vector<Seam>& seams, const Seam& s, const Seam& t) {
    const auto is_of_s = [&](const PatchSide& side) {
        return side.patch == s.a.patch || side.patch == s.b.patch;
    };
    if (is_of_s(t.a) || is_of_s(t.b)) {
        return 0;
    }
    if (are_joined(seams, s.a.patch, t.a.patch) && are_joined(seams, s.b.patch, t.b.patch)) {
        return 1;
    }
    return are_joined(seams, s.a.patch, t.b.patch) && are_joined(seams, s.b.patch, t.a.patch) ? -1 : 0;
}

/// Seams that go on from each other need the same ratio: else only nets without a tangent at the corner would
/// fit. Geometric means over such seams.
std::vector<double> common_ratios(const std::vector<Seam>& seams, const std::vector<double>& own) {
    std::vector<int> sense(seams.size(), 0); // against the first of its group; 0: in none yet
    std::vector<double> common(own.size(), 1.0);
    for (std::size_t first = 0; first < seams.size(); ++first) {
        if (sense[first] != 0) {
            continue;
        }
        std::vector<std::size_t> group{first};
        sense[first] = 1;
        double sum = 0.0;
        for (std::size_t g = 0; g < group.size(); ++g) {
            sum += sense[group[g]] * std::log(own[group[g]]);
            for (std::size_t n = 0; n < seams.size(); ++n) {
                const int next = sense[n] == 0 ? goes_on(seams, seams[group[g]], seams[n]) : 0;
                if (next != 0) {
                    sense[n] = next * sense[group[g]];
                    group.push_back(n);
                }
            }
        }
        for (const std::size_t n : group) {
            common[n] = std::exp(sense[n] * sum / static_cast<double>(group.size()));
        }
    }
    return common;
}

/// sum of `factor` times control point = 0.
using Condition = std::vector<std::pair<std::size_t, double>>;

std::vector<Condition> conditions_of(const Net& net, const std::vector<Seam>& seams, Continuity continuity) {
    std::vector<SeamRows> rows;
    std::vector<double> ratios;
    for (const Seam& seam : seams) {
        rows.push_back(net.rows_of(seam));
        const std::optional<double> ratio = ratio_of(net, rows.back());
        if (!ratio && continuity == Continuity::tangent) {
            throw Error(fmt::format("patches {} and {} fold back on each other at their seam",
                                    seam.a.patch,
                                    seam.b.patch),
                        {},
                        "join them by position only");
        }
        ratios.push_back(ratio.value_or(1.0));
    }
    ratios = common_ratios(seams, ratios);
    std::vector<Condition> conditions;
    for (std::size_t n = 0; n < rows.size(); ++n) {
        const double out = ratios[n] * rows[n].across_a;
        const double in = rows[n].across_b;
        for (const auto& [before, a, b, behind] : rows[n].points) {
            conditions.push_back({{a, 1.0}, {b, -1.0}});
            if (continuity == Continuity::tangent) {
                conditions.push_back({{behind, in}, {b, -in}, {a, -out}, {before, out}});
            }
        }
    }
    return conditions;
}

/// The least movement of the points in `conditions` that fulfils them, a row each.
Eigen::MatrixXd least_movement(const Net& net,
                               const std::vector<Condition>& conditions,
                               const std::map<std::size_t, Eigen::Index>& columns) {
    const auto rows = static_cast<Eigen::Index>(conditions.size());
    Eigen::MatrixXd matrix = Eigen::MatrixXd::Zero(rows, static_cast<Eigen::Index>(columns.size()));
    Eigen::MatrixXd missing = Eigen::MatrixXd::Zero(rows, 3);
    for (Eigen::Index row = 0; row < rows; ++row) {
        for (const auto& [point, factor] : conditions[static_cast<std::size_t>(row)]) {
            matrix(row, columns.at(point)) += factor;
            missing.row(row) -= factor * net.point(point).transpose();
        }
    }
    return matrix.completeOrthogonalDecomposition().solve(missing);
}

} // namespace

Joined
joined(const std::vector<BezierPatch>& patches, const std::vector<Seam>& seams, Continuity continuity) {
    if (std::ranges::any_of(patches, &BezierPatch::rational)) {
        throw Error("a patch has weights, but only patches without weights can be joined",
                    {},
                    "fit a patch to it during import");
    }
    Net net(with_equal_degrees(patches, seams));
    const std::vector<Condition> conditions = conditions_of(net, seams, continuity);
    if (std::ssize(conditions) > most_join_conditions) {
        throw Error(fmt::format("{} conditions between the patches exceed the limit of {} at once",
                                conditions.size(),
                                most_join_conditions));
    }
    std::map<std::size_t, Eigen::Index> columns;
    for (const Condition& condition : conditions) {
        for (const auto& [point, factor] : condition) {
            columns.try_emplace(point, static_cast<Eigen::Index>(columns.size()));
        }
    }
    Joined result;
    if (!conditions.empty()) {
        const Eigen::MatrixXd movement = least_movement(net, conditions, columns);
        for (const auto& [point, column] : columns) {
            net.move(point, movement.row(column).transpose());
            result.largest_move = std::max(result.largest_move, movement.row(column).norm());
        }
        result.rms_move = movement.norm() / std::sqrt(static_cast<double>(net.count()));
    }
    for (const ControlNet& moved : net.nets()) {
        result.patches.emplace_back(moved);
    }
    return result;
}

} // namespace millwright::geometry
