#include "core/grid/internal/level_stack.h"

#include "core/base/error.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <span>
#include <utility>

namespace millwright::grid {

namespace {

/// Where target k of `targets` lies among `sources`.
struct LinePlace {
    int first;    ///< source at or before it
    double share; ///< of the next one
};

LinePlace place(int k, int sources, int targets) {
    const auto cells = static_cast<long>(sources) - 1;
    const auto target_cells = static_cast<long>(targets) - 1;
    const long scaled = k * cells;
    const long whole = scaled / target_cells;
    return {static_cast<int>(whole),
            static_cast<double>(scaled - whole * target_cells) / static_cast<double>(target_cells)};
}

} // namespace

void LineMap::append(int first, std::span<const double> weights) {
    first_.push_back(first);
    weights_.insert(weights_.end(), weights.begin(), weights.end());
    begin_.push_back(weights_.size());
}

LineMap LineMap::interpolation(int sources, int targets) {
    expects(sources >= 2 && targets >= 2, "values on a line have two ends");
    LineMap map;
    map.sources_ = sources;
    for (int k = 0; k < targets; ++k) {
        const LinePlace at = place(k, sources, targets);
        if (at.share > 0.0) {
            map.append(at.first, std::array{1.0 - at.share, at.share});
        } else {
            map.append(at.first, std::array{1.0});
        }
    }
    return map;
}

LineMap LineMap::means(int sources, int targets) {
    expects(sources >= targets, "there are no more means than values");
    const LineMap back = interpolation(targets, sources);
    LineMap map;
    map.sources_ = sources;
    for (int k = 0; k < targets; ++k) {
        int first = 0;
        double sum = 0.0;
        std::vector<double> weights;
        for (int source = 0; source < sources; ++source) {
            const Sum terms = back.at(source);
            const int term = k - terms.first;
            if (term < 0 || term >= std::ssize(terms.weights)) {
                continue;
            }
            const double measure = source == 0 || source == sources - 1 ? 0.5 : 1.0;
            if (weights.empty()) {
                first = source;
            }
            weights.push_back(measure * terms.weights[static_cast<std::size_t>(term)]);
            sum += weights.back();
        }
        for (double& weight : weights) {
            weight /= sum;
        }
        map.append(first, weights);
    }
    return map;
}

std::size_t LineMap::bytes() const {
    return first_.size() * sizeof(int) + begin_.size() * sizeof(std::size_t) +
           weights_.size() * sizeof(double);
}

namespace {

constexpr int sweeps_before = 2;
constexpr int sweeps_after = 2;
constexpr int sweeps_on_coarsest = 20;
constexpr int fewest_halved = 4;              // nodes in one direction
constexpr int most_correction_halvings = 8;   // of a correction
constexpr double most_growth = 10.0;          // of a norm by a correction; sweeps smooth out most of it
constexpr std::size_t bytes_finest = 56;      // a node: itself, weight, residual, kept
constexpr std::size_t bytes_coarse = 56 + 72; // ... right side, begun with its weight and slope, change

int coarser(int nodes) {
    return nodes >= fewest_halved ? nodes / 2 + 1 : nodes;
}

IndexDensity coarser(const MultigridLevel& level, int rows, int columns) {
    return {level.density().xi * (rows - 1) / (level.rows() - 1),
            level.density().eta * (columns - 1) / (level.columns() - 1)};
}

double largest(const NodeArray& residual) {
    double found = 0.0;
    for (const Vec2& r : residual.nodes) {
        const double here = (std::abs(r.x()) + std::abs(r.y())) / 2.0;
        if (!std::isfinite(here)) { // kept, so that no maximum over the other nodes hides it
            return here;
        }
        found = std::max(found, here);
    }
    return found;
}

void transfer_nodes(const ArrayMap& map, const NodeArray& from, NodeArray& to) {
    transfer<Vec2>(map, from.nodes, Vec2::Zero(), [&to](std::size_t k, const Vec2& p) { to.nodes[k] = p; });
}

} // namespace

LevelStack::LevelStack(NodeArray start,
                       WeightPtr weight,
                       const IndexDensity& density,
                       const LevelRules& rules)
    : rules_(rules), weight_(std::move(weight)) {
    levels_.emplace_back(start.rows, start.columns, density, rules, weight_);
    levels_.front().nodes = std::move(start);
    for (;;) {
        const MultigridLevel& fine_level = levels_.back();
        residuals_.emplace_back(fine_level.rows(), fine_level.columns());
        kept_.emplace_back(fine_level.rows(), fine_level.columns());
        const int rows = coarser(fine_level.rows());
        const int columns = coarser(fine_level.columns());
        if (rows == fine_level.rows() && columns == fine_level.columns()) {
            return;
        }
        sample_.push_back({LineMap::interpolation(fine_level.rows(), rows),
                           LineMap::interpolation(fine_level.columns(), columns)});
        means_.push_back(
            {LineMap::means(fine_level.rows(), rows), LineMap::means(fine_level.columns(), columns)});
        back_.push_back({LineMap::interpolation(rows, fine_level.rows()),
                         LineMap::interpolation(columns, fine_level.columns())});
        change_.emplace_back(rows, columns);
        levels_.emplace_back(rows, columns, coarser(fine_level, rows, columns), rules, nullptr);
    }
}

double LevelStack::norm() {
    if (!levels_.front().ask_weight()) {
        return std::numeric_limits<double>::quiet_NaN();
    }
    levels_.front().residual(residuals_.front());
    return largest(residuals_.front());
}

void LevelStack::come_up() {
    if (levels_.size() < 2) {
        return;
    }
    const MultigridLevel& coarse_level = levels_[1];
    NodeArray start(coarse_level.rows(), coarse_level.columns());
    transfer_nodes(sample_[0], nodes(), start);
    LevelStack below(start, weight_, coarse_level.density(), rules_);
    if (!below.sound()) {
        return;
    }
    below.come_up();
    const double before = norm();
    if (!std::isfinite(before) || !below.cycle()) {
        return;
    }
    kept_[0].nodes = nodes().nodes;
    for (std::size_t k = 0; k < start.nodes.size(); ++k) {
        change_[0].nodes[k] = below.nodes().nodes[k] - start.nodes[k];
    }
    if (!takes(0, 1.0, before)) {
        nodes().nodes = kept_[0].nodes;
    }
}

bool LevelStack::cycle_from(std::size_t level) {
    MultigridLevel& here = levels_[level];
    const bool coarsest = level + 1 == levels_.size();
    bool finite = true;
    for (int k = 0; finite && k < (coarsest ? sweeps_on_coarsest : sweeps_before); ++k) {
        finite = here.smooth();
    }
    if (coarsest || !finite) {
        return finite;
    }
    if (!here.ask_weight()) {
        return false;
    }
    here.residual(residuals_[level]);
    if (descend(level)) {
        if (!cycle_from(level + 1)) {
            return false;
        }
        correct(level);
    }
    for (int k = 0; finite && k < sweeps_after; ++k) {
        finite = here.smooth();
    }
    return finite;
}

/// Sets the problem of the next level: there R = R (what was sampled) + the mean of what is left here. False
/// if what was sampled is folded.
bool LevelStack::descend(std::size_t level) {
    const MultigridLevel& fine_level = levels_[level];
    MultigridLevel& coarse_level = levels_[level + 1];
    transfer_nodes(sample_[level], fine_level.nodes, coarse_level.nodes);
    transfer<double>(
        means_[level], fine_level.w, 0.0, [&](std::size_t k, double w) { coarse_level.w[k] = w; });
    if (!coarse_level.sound()) {
        return false;
    }
    coarse_level.begin();
    change_[level].nodes = coarse_level.nodes.nodes;
    NodeArray& f = coarse_level.right_side;
    std::ranges::fill(f.nodes, Vec2::Zero());
    coarse_level.residual(residuals_[level + 1]); // -R of what was sampled
    transfer<Vec2>(means_[level], residuals_[level].nodes, Vec2::Zero(), [&](std::size_t k, const Vec2& r) {
        f.nodes[k] = r - residuals_[level + 1].nodes[k];
    });
    return true;
}

/// Adds the longest of the halved corrections that can be taken, or none.
void LevelStack::correct(std::size_t level) {
    NodeArray& change = change_[level];
    for (std::size_t k = 0; k < change.nodes.size(); ++k) {
        change.nodes[k] = levels_[level + 1].nodes.nodes[k] - change.nodes[k];
    }
    const double before = largest(residuals_[level]);
    kept_[level].nodes = levels_[level].nodes.nodes;
    double factor = 1.0;
    for (int halving = 0; halving < most_correction_halvings; ++halving, factor /= 2.0) {
        if (takes(level, factor, most_growth * before)) {
            return;
        }
    }
    levels_[level].nodes.nodes = kept_[level].nodes;
}

/// Puts the nodes of `level` where they were kept plus `factor` times the change of the next level.
bool LevelStack::takes(std::size_t level, double factor, double largest_residual) {
    MultigridLevel& fine_level = levels_[level];
    transfer<Vec2>(back_[level], change_[level].nodes, Vec2::Zero(), [&](std::size_t k, const Vec2& p) {
        fine_level.nodes.nodes[k] = kept_[level].nodes[k] + factor * p;
    });
    if (!fine_level.sound() || !fine_level.ask_weight()) {
        return false;
    }
    fine_level.residual(residuals_[level]);
    return largest(residuals_[level]) <= largest_residual;
}

std::size_t LevelStack::memory_bytes(int rows, int columns) {
    const auto nodes = [](int r, int c) { return static_cast<std::size_t>(r) * static_cast<std::size_t>(c); };
    std::size_t bytes = nodes(rows, columns) * bytes_finest;
    for (;;) {
        const int coarse_rows = coarser(rows);
        const int coarse_columns = coarser(columns);
        if (coarse_rows == rows && coarse_columns == columns) {
            return bytes;
        }
        rows = coarse_rows;
        columns = coarse_columns;
        bytes += nodes(rows, columns) * bytes_coarse;
    }
}

} // namespace millwright::grid
