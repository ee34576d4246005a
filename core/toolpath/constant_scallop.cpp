#include "core/toolpath/constant_scallop.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/parallel.h"
#include "core/toolpath/internal/contact_point.h"
#include "core/toolpath/internal/groove_track.h"
#include "core/toolpath/trimmed_path.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>
#include <vector>

namespace millwright::toolpath {

namespace {

bool done(const Across& track) {
    return std::ranges::all_of(track, [](double across) { return across >= 1.0; });
}

/// The ridge between two grooves: where it is, as a share of the way from one to the other, and how high.
struct Ridge {
    double share = 0.5;
    double height = 0.0;
};

/// Both heights grow with the square of the distance from their groove: from those at one place follows where
/// they meet.
Ridge ridge_from(double share, double height_a, double height_b) {
    if (!std::isfinite(height_a) || !std::isfinite(height_b)) {
        return {0.5, std::max(height_a, height_b)};
    }
    const double a = std::sqrt(std::max(height_a, 0.0)) / share;
    const double b = std::sqrt(std::max(height_b, 0.0)) / (1.0 - share);
    return a + b > 0.0 ? Ridge{std::clamp(b / (a + b), 0.05, 0.95), square(a * b / (a + b))} : Ridge{};
}

/// Where a track may bend, as numbers of its nodes. More bends than these lead, where they are nearer to each
/// other than the tracks are, to tracks with teeth.
std::vector<std::size_t> bends_of(std::size_t nodes) {
    constexpr std::size_t most = 20;
    const std::size_t moves = nodes - 1;
    const std::size_t count = std::min(moves, most);
    std::vector<std::size_t> bends;
    for (std::size_t n = 0; n <= count; ++n) {
        bends.push_back(n * moves / count);
    }
    return bends;
}

int columns_per_node(std::size_t nodes) {
    constexpr int fine = 400;
    const int moves = static_cast<int>(nodes) - 1;
    return std::max(2, (fine + moves - 1) / moves);
}

/// Lays each track as far from the one before as leaves the height: measures the ridge between them on every
/// column of a raster, and moves the bends until it is nowhere higher and, as far as they allow, not much
/// lower.
class Stepper {
public:
    Stepper(const Covering& of, double height, std::size_t nodes)
        : of_(of), height_(height), bends_(bends_of(nodes)), per_node_(columns_per_node(nodes)),
          nodes_(nodes, 0.0), groove_(of, nodes_, per_node_, true), shares_(groove_.columns(), 0.5) {
        for (const std::size_t bend : bends_) {
            steps_.push_back(groove_.first_step(of, column_of(bend), height));
        }
    }

    [[nodiscard]] const Across& track() const { return nodes_; }

    /// From the track to the next, on which the tool goes `forward` with the parameter along.
    void advance(bool forward) {
        for (int round = 0;; ++round) {
            Across next = stepped();
            GrooveTrack groove(of_, next, per_node_, forward);
            const std::vector<double> ratios = ratios_at_bends(groove);
            if (round == most_rounds || good(ratios, next, round)) {
                groove_ = std::move(groove);
                nodes_ = std::move(next);
                return;
            }
            correct(ratios, round);
        }
    }

private:
    static constexpr int growing_rounds = 6; ///< after these the steps become only shorter
    static constexpr int most_rounds = 30;
    static constexpr double aim = 0.98; ///< of the wanted height
    static constexpr double low = 0.93; ///< a ridge that is lower may be higher

    [[nodiscard]] std::size_t column_of(std::size_t node) const {
        return node * static_cast<std::size_t>(per_node_);
    }

    [[nodiscard]] Across stepped() const {
        Across next(nodes_.size());
        const auto at_bend = [&](std::size_t n) { return std::min(1.0, nodes_[bends_[n]] + steps_[n]); };
        for (std::size_t n = 0; n + 1 < bends_.size(); ++n) {
            const auto moves = static_cast<double>(bends_[n + 1] - bends_[n]);
            for (std::size_t node = bends_[n]; node <= bends_[n + 1]; ++node) {
                next[node] = mix(at_bend(n), at_bend(n + 1), static_cast<double>(node - bends_[n]) / moves);
            }
        }
        return next;
    }

    /// By which factor the square of each bend's step is too large: the worst of the columns up to the bends
    /// beside it.
    [[nodiscard]] std::vector<double> ratios_at_bends(const GrooveTrack& next) {
        std::vector<double> of_columns(shares_.size());
        constexpr std::ptrdiff_t chunk = 32;
        parallel_for(std::ssize(of_columns), chunk, [&](std::ptrdiff_t n) {
            of_columns[static_cast<std::size_t>(n)] = ratio_at(next, static_cast<std::size_t>(n));
        });
        std::vector<double> found(bends_.size());
        for (std::size_t n = 0; n < found.size(); ++n) {
            const std::size_t first = n == 0 ? 0 : column_of(bends_[n - 1]) + 1;
            const std::size_t end = n + 1 == found.size() ? of_columns.size() : column_of(bends_[n + 1]);
            found[n] = *std::max_element(of_columns.data() + first, of_columns.data() + end);
        }
        return found;
    }

    [[nodiscard]] double ratio_at(const GrooveTrack& next, std::size_t column) {
        if (next.across(column) <= groove_.across(column)) {
            return 0.0; // this part is done
        }
        const double gap = groove_.distance(next.contact(column), column);
        const double most = of_.tool.cutter->shape().radius;
        const double least = std::min(2.0 * height_, most);
        return std::max(std::min(ridge_at(next, column) / height_, square(gap / least)), square(gap / most));
    }

    /// Looked for where it was found last, twice.
    [[nodiscard]] double ridge_at(const GrooveTrack& next, std::size_t column) {
        Ridge ridge{.share = shares_[column]};
        for (int look = 0; look < 2; ++look) {
            const double across = mix(groove_.across(column), next.across(column), ridge.share);
            const Vec2 uv =
                place_with_normal(of_.patch, of_.outline, uv_of(of_.direction, next.along(column), across));
            const PathPoint point = contact_point(of_.patch, uv, of_.flipped);
            ridge = ridge_from(ridge.share,
                               groove_.height(point.contact, point.normal, column),
                               next.height(point.contact, point.normal, column));
        }
        shares_[column] = ridge.share;
        return ridge.height;
    }

    [[nodiscard]] bool good(const std::vector<double>& ratios, const Across& next, int round) const {
        for (std::size_t n = 0; n < ratios.size(); ++n) {
            const bool may_grow = next[bends_[n]] < 1.0 && round < growing_rounds;
            if (ratios[n] > 1.0 || (may_grow && ratios[n] < low)) {
                return false;
            }
        }
        return true;
    }

    void correct(const std::vector<double>& ratios, int round) {
        constexpr double shortest = 0.5;
        const double longest = round < growing_rounds ? 4.0 : 1.0;
        for (std::size_t n = 0; n < steps_.size(); ++n) {
            const double factor = std::clamp(std::sqrt(aim / std::max(ratios[n], 1e-3)), shortest, longest);
            steps_[n] = std::min(steps_[n] * factor, 1.0 - nodes_[bends_[n]]);
        }
    }

    const Covering& of_;
    double height_;
    std::vector<std::size_t> bends_;
    int per_node_; ///< columns
    Across nodes_; ///< of the track
    GrooveTrack groove_;
    std::vector<double> steps_;  ///< from there across, of each bend
    std::vector<double> shares_; ///< where the ridge was found last, of each column
};

/// Numbers of nodes of a track, the first and the last.
using Stretch = std::pair<int, int>;

/// Where the surface is not yet done by the track before, and up to the node where it is.
std::vector<Stretch> to_do(const Across& before) {
    std::vector<Stretch> found;
    const int last = static_cast<int>(before.size()) - 1;
    for (int n = 0; n <= last; ++n) {
        if (before[static_cast<std::size_t>(n)] < 1.0) {
            const Stretch around{std::max(0, n - 1), std::min(last, n + 1)};
            if (!found.empty() && found.back().second >= around.first) {
                found.back().second = around.second;
            } else {
                found.push_back(around);
            }
        }
    }
    return found;
}

/// What is written down of the tracks.
class TrackWriter {
public:
    explicit TrackWriter(const Covering& of) : of_(of) { path_.direction = of.direction; }

    void add(const Across& track, std::vector<Stretch> stretches, bool forward) {
        if (!forward) {
            std::ranges::reverse(stretches);
        }
        for (const auto& [first, last] : stretches) {
            add_stretch(track, forward ? first : last, forward ? last : first);
        }
        ++track_;
        points_ = 0;
    }
    [[nodiscard]] Toolpath take() { return std::move(path_); }

private:
    void add_stretch(const Across& track, int from, int to) {
        const int step = from < to ? 1 : -1;
        for (int node = from; node != to + step; node += step) {
            const double along = static_cast<double>(node) / static_cast<double>(std::ssize(track) - 1);
            PathPoint point =
                point_to_trim(of_.patch,
                              of_.outline,
                              uv_of(of_.direction, along, track[static_cast<std::size_t>(node)]),
                              of_.flipped);
            point.origin = origin_at(of_.direction, track_, points_++, point.origin.uv);
            point.reached_by = node != from           ? MoveKind::track
                               : path_.points.empty() ? MoveKind::start
                                                      : MoveKind::cross;
            path_.points.push_back(point);
        }
    }

    const Covering& of_;
    Toolpath path_;
    int track_ = 0;
    int points_ = 0; ///< of the track
};

} // namespace

ConstantScallop::ConstantScallop(double height) : height_(height) {
    expects(height > 0.0 && std::isfinite(height), "a scallop has a height");
}

Toolpath ConstantScallop::contacts(const Covering& of, const Progress& progress) const {
    if (!of.tool.cutter) {
        throw Error("a point tool leaves no scallops, so the spacing of constant-scallop tracks is undefined",
                    {},
                    "choose a cutter, or another strategy");
    }
    const int nodes = of.grid.nodes_per_track(of.direction);
    Stepper stepper(of, height_, static_cast<std::size_t>(nodes));
    TrackWriter writer(of);
    writer.add(stepper.track(), {{0, nodes - 1}}, true);
    for (int n = 1; !done(stepper.track()); ++n) {
        progress.check();
        progress.report(*std::ranges::min_element(stepper.track()));
        if (n >= most_tracks) {
            throw Error(fmt::format("a scallop height of {:.6g} mm would need more than {} tracks",
                                    height_,
                                    most_tracks),
                        {},
                        "allow a larger scallop height, or use a larger cutter");
        }
        const bool forward = n % 2 == 0;
        const std::vector<Stretch> stretches = to_do(stepper.track());
        stepper.advance(forward);
        writer.add(stepper.track(), stretches, forward);
    }
    progress.report(1.0);
    return writer.take();
}

} // namespace millwright::toolpath
