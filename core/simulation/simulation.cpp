#include "core/simulation/simulation.h"

#include "core/base/error.h"
#include "core/kinematics/forward.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <set>
#include <utility>

namespace millwright::simulation {

namespace {

using geometry::ToolPose;

constexpr std::size_t steps_at_a_time = 16'384;

Error at_line(const program::Block& block, std::string message, std::string hint) {
    return Error(Diagnostic{{{}, block.source_line, 0, -1}, std::move(message), std::move(hint)});
}

/// How many parts of a block are straight and even within the tolerances.
double parts_of(const kinematics::StraightForward& way) {
    const kinematics::Bend bend = way.bend();
    // A chord of a curve whose second derivative is at most b is off by b / 8.
    return std::max({1.0,
                     std::ceil(std::sqrt(bend.tip / (8.0 * tip_tolerance))),
                     std::ceil(std::sqrt(bend.axis / (8.0 * axis_tolerance)))});
}

/// Which axes have been positioned by the program.
class KnownAxes {
public:
    explicit KnownAxes(const program::Program& program) {
        for (const program::Block& block : program.blocks) {
            for (int axis = 0; block.moves() && axis < static_cast<int>(program.axes.size()); ++axis) {
                if (block.named.contains(axis)) {
                    missing_.insert(axis);
                }
            }
        }
    }
    /// Whether all that the program ever positions have been.
    [[nodiscard]] bool all() const { return missing_.empty(); }
    void take(const program::Block& block) {
        std::erase_if(missing_, [&](int axis) { return block.named.contains(axis); });
    }

private:
    std::set<int> missing_;
};

class Run {
public:
    Run(const SimulationInput& input, const Progress& progress)
        : input_(input), progress_(progress), known_(input.program) {
        result_.field = std::make_unique<DexelField>(
            input.stock, input.resolution, input.most_bytes, progress.part(0.0, 0.05));
        uncut_ = result_.field->volume();
        removal_.emplace(*result_.field);
        for (const ToolUse& tool : input.tools) {
            auto& body = bodies_.emplace_back();
            if (tool.body) {
                body.emplace(*tool.body);
            }
            auto& above = uncutting_.emplace_back();
            for (const auto* part : {&tool.shank, &tool.holder}) {
                above.emplace_back();
                if (*part) {
                    above.back().emplace(**part);
                }
            }
        }
    }

    Simulation finish() {
        const int count = input_.program.block_count();
        for (int n = 0; n < count; ++n) {
            take(n);
            if (steps_.size() >= steps_at_a_time) {
                flush(static_cast<double>(n) / count);
            }
        }
        flush(1.0);
        report();
        return std::move(result_);
    }

private:
    void take(int n) {
        const program::Block& block = input_.program.blocks[static_cast<std::size_t>(n)];
        while (next_tool_ < input_.tools.size() && input_.tools[next_tool_].first_block <= n) {
            ++next_tool_;
        }
        if (block.kind == program::BlockKind::spindle_on) {
            spindle_ = true;
        } else if (block.kind == program::BlockKind::spindle_off) {
            spindle_ = false;
        }
        if (!block.moves()) {
            return;
        }
        if (known_.all()) {
            follow(n, block);
            return;
        }
        known_.take(block);
        result_.first_block = n + 1;
        auto& skipped = result_.skipped;
        skipped = skipped.value_or(SkippedStart{0, 0, block.source_line, block.source_line, 0, 0});
        if (block.kind == program::BlockKind::rapid) {
            ++skipped->rapids;
        } else {
            skipped->first_feed_line = skipped->feeds == 0 ? block.source_line : skipped->first_feed_line;
            skipped->last_feed_line = block.source_line;
            ++skipped->feeds;
        }
        skipped->last_line = block.source_line;
    }

    void follow(int n, const program::Block& block) {
        const bool rapid = block.kind == program::BlockKind::rapid;
        if (next_tool_ == 0 || !bodies_[next_tool_ - 1]) {
            if (!rapid) {
                throw at_line(block,
                              "this move cuts, and no tool is in the spindle",
                              "the program has to call the tool (M6) before it");
            }
            return;
        }
        const CuttingBody& body = *bodies_[next_tool_ - 1];
        const auto& above = uncutting_[next_tool_ - 1];
        const auto& own = input_.tools[next_tool_ - 1].machine;
        const kinematics::StraightForward way(
            own ? *own : input_.machine, program::position_before(input_.program, n), block.target);
        const double parts = parts_of(way);
        constexpr double most_parts = 200'000;
        if (!(parts <= most_parts)) {
            throw at_line(block, "the move goes too far to be simulated", "check its coordinates");
        }
        ++result_.moves;
        if (!spindle_) {
            without_spindle_.insert(n);
        }
        ToolPose last = way.at(0.0);
        for (int part = 1; part <= static_cast<int>(parts); ++part) {
            const ToolPose next = way.at(part / parts);
            add(body, last, next, n, rapid, true);
            for (std::size_t k = 0; k < above.size(); ++k) {
                if (above[k]) {
                    add(*above[k], last, next, id_of(n, k), true, false);
                }
            }
            last = next;
        }
    }

    /// The stretch of a straight move that can reach the stock.
    void add(const CuttingBody& body,
             const ToolPose& from,
             const ToolPose& to,
             int id,
             bool contact_counts,
             bool removes) {
        const toolpath::ProfileShape& shape = body.body.shape();
        const double reach = std::max(std::abs(shape.top), std::abs(shape.bottom)) + shape.radius;
        const Box3& box = result_.field->box();
        double first = 0.0, last = 1.0;
        for (int axis = 0; axis < 3; ++axis) {
            const double way = to.tip[axis] - from.tip[axis];
            const double low = box.min()[axis] - reach - from.tip[axis];
            const double high = box.max()[axis] + reach - from.tip[axis];
            if (std::abs(way) > 0.0) {
                first = std::max(first, std::min(low / way, high / way));
                last = std::min(last, std::max(low / way, high / way));
            } else if (low > 0.0 || high < 0.0) {
                return;
            }
        }
        if (!(first < last) && (to.tip - from.tip).norm() > 0.0) {
            return;
        }
        const auto at = [&](double f) {
            return ToolPose{from.tip + f * (to.tip - from.tip),
                            Vec3(from.axis + f * (to.axis - from.axis)).normalized()};
        };
        const std::size_t known = steps_.size();
        // A part of a move turns so little that the chord of its axis is even.
        divide(body, first > 0.0 ? at(first) : from, last < 1.0 ? at(last) : to, id, contact_counts, steps_);
        for (std::size_t k = known; k < steps_.size(); ++k) {
            steps_[k].removes = removes;
        }
    }

    /// Of what shank (0) and holder (1) meet on block `n`.
    [[nodiscard]] std::int32_t id_of(int n, std::size_t part) const {
        return n + static_cast<std::int32_t>(part + 1) * input_.program.block_count();
    }

    void flush(double done) {
        constexpr double filled = 0.05, cut = 0.95;
        const double to = filled + (cut - filled) * done;
        removal_->remove(steps_, progress_.part(done_, to));
        done_ = to;
        steps_.clear();
    }

    /// Shank or holder in material: when it reaches the place, and how deep that gets.
    [[nodiscard]] Finding touched(int n, bool holder, const Contact& contact) const {
        const program::Block& block = input_.program.blocks[static_cast<std::size_t>(n)];
        const ToolUse* use = nullptr;
        for (const ToolUse& tool : input_.tools) {
            use = tool.first_block <= n ? &tool : use;
        }
        const toolpath::Profile& body = holder ? *use->holder : *use->shank;
        const kinematics::StraightForward way(use->machine ? *use->machine : input_.machine,
                                              program::position_before(input_.program, n),
                                              block.target);
        Finding finding{holder ? FindingKind::holder_in_stock : FindingKind::shank_in_stock,
                        n,
                        block.source_line,
                        0.0,
                        contact};
        constexpr int moments = 400;
        bool reached = false;
        for (int k = 0; k <= moments; ++k) {
            const double t = static_cast<double>(k) / moments;
            const double depth = -toolpath::distance(body, way.at(t), contact.place);
            finding.time = !reached && depth >= 0.0 ? t : finding.time;
            reached = reached || depth >= 0.0;
            finding.depth = std::max(finding.depth, depth);
        }
        return finding;
    }

    void report() {
        const int count = input_.program.block_count();
        for (const auto& [id, cut] : removal_->cuts()) {
            const int n = id % count;
            const program::Block& block = input_.program.blocks[static_cast<std::size_t>(n)];
            if (id >= count) {
                result_.findings.push_back(touched(n, id >= 2 * count, *cut.contact));
                continue;
            }
            ++result_.cutting_moves;
            if (cut.contact) {
                result_.findings.push_back(
                    {FindingKind::rapid_in_stock, n, block.source_line, cut.volume, *cut.contact});
            } else if (without_spindle_.contains(n) && block.kind == program::BlockKind::feed) {
                result_.findings.push_back({FindingKind::spindle_off, n, block.source_line, cut.volume, {}});
            }
        }
        std::stable_sort(result_.findings.begin(),
                         result_.findings.end(),
                         [](const Finding& a, const Finding& b) { return a.block < b.block; });
        result_.stock_volume = volume(input_.stock);
        const double share = uncut_ > 0.0 ? std::min(result_.field->volume() / uncut_, 1.0) : 0.0;
        result_.left_volume = share * result_.stock_volume;
        progress_.report(1.0);
    }

    const SimulationInput& input_;
    const Progress& progress_;
    Simulation result_;
    std::optional<Removal> removal_;
    std::deque<std::optional<CuttingBody>> bodies_;                // steps point to them
    std::deque<std::deque<std::optional<CuttingBody>>> uncutting_; // shank and holder of each tool
    KnownAxes known_;
    std::set<int> without_spindle_;
    std::vector<CutStep> steps_;
    std::size_t next_tool_ = 0;
    double done_ = 0.05;
    double uncut_ = 0.0; // volume of the field, mm^3
    bool spindle_ = false;
};

void expect_machine(const SimulationInput& input) {
    const auto& axes = input.program.axes;
    bool same = static_cast<int>(axes.size()) == input.machine.axis_count();
    for (int n = 0; same && n < input.machine.axis_count(); ++n) {
        same = axes[static_cast<std::size_t>(n)].letter == input.machine.axis(n).letter;
    }
    if (!same) {
        throw Error(fmt::format("the program is not one of the machine \"{}\"", input.machine.name()));
    }
}

} // namespace

Simulation simulate(const SimulationInput& input, const Progress& progress) {
    expect_machine(input);
    return Run(input, progress).finish();
}

} // namespace millwright::simulation
