#include "core/simulation/simulator.h"

#include "core/base/error.h"
#include "core/kinematics/forward.h"
#include "core/simulation/internal/keyframes.h"
#include "core/simulation/internal/program_state.h"
#include "core/simulation/internal/stretches.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <deque>
#include <functional>
#include <map>
#include <optional>
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

} // namespace

class Simulator::Work {
public:
    Work(const SimulationInput& input, Rewind rewind, const Progress& progress)
        : input_(input), rewinds_(rewind == Rewind::by_keyframes),
          field_(std::make_unique<DexelField>(input.stock, input.resolution, input.most_bytes, progress)),
          uncut_(field_->volume()), removal_(std::make_unique<Removal>(*field_)),
          state_{KnownAxes(input.program), 0, false, 0, 0, std::nullopt} {
        for (const ToolUse& tool : input.tools) {
            auto& body = bodies_.emplace_back();
            if (tool.body) {
                body.emplace(*tool.body);
            }
            AboveCutter& above = above_.emplace_back();
            if (tool.body && tool.shank) {
                above.add(*tool.body, ToolPart::shank, *tool.shank);
            }
            if (tool.body && tool.holder) {
                above.add(*tool.body, ToolPart::holder, *tool.holder);
            }
        }
        states_.emplace(0, state_);
        if (rewinds_) {
            keyframes_.add(*field_, 0, keyframe_room());
        }
    }

    void advance_to(int block, const Progress& progress) {
        expects(block >= 0 && block <= input_.program.block_count(), "a program has the block");
        if (is_torn_ || block < block_ || next_keyframe(block) > block_) {
            expects(rewinds_ || (!is_torn_ && block >= block_), "this simulation does not go back");
            rewind(block);
        }
        is_torn_ = true;
        const int from = block_;
        done_ = 0.0;
        while (block_ < block) {
            const double begun = static_cast<double>(block_ - from) / (block - from);
            take(block_, progress, begun);
            ++block_;
            if (steps_.size() >= steps_at_a_time || (rewinds_ && steps_.size() >= steps_per_keyframe_)) {
                flush(progress, static_cast<double>(block_ - from) / (block - from));
                keep();
            }
        }
        flush(progress, 1.0);
        keep();
        is_torn_ = false;
    }

    [[nodiscard]] int block() const { return block_; }
    [[nodiscard]] const program::Program& program() const { return input_.program; }
    [[nodiscard]] const DexelField& field() const { return *field_; }
    [[nodiscard]] const Removal& removal() const { return *removal_; }
    [[nodiscard]] const Keyframes& keyframes() const { return keyframes_; }

    [[nodiscard]] Simulation found() const {
        Simulation result;
        result.first_block = state_.first_block;
        result.moves = state_.moves;
        result.skipped = state_.skipped;
        for (const auto& [n, cut] : removal_->cuts()) {
            if (n >= block_) {
                break;
            }
            const program::Block& block = block_of(n);
            ++result.cutting_moves;
            if (cut.contact) {
                result.findings.push_back(
                    {FindingKind::rapid_in_stock, n, block.source_line, cut.volume, *cut.contact});
            } else if (without_spindle_.contains(n) && block.kind == program::BlockKind::feed) {
                result.findings.push_back({FindingKind::spindle_off, n, block.source_line, cut.volume, {}});
            }
        }
        for (const ToolPart part : {ToolPart::shank, ToolPart::holder}) {
            for (const auto& [n, contact] : removal_->contacts(part)) {
                if (n < block_) {
                    result.findings.push_back(touched(n, part, contact));
                }
            }
        }
        std::stable_sort(result.findings.begin(),
                         result.findings.end(),
                         [](const Finding& a, const Finding& b) { return a.block < b.block; });
        result.cuts.insert(removal_->cuts().begin(), removal_->cuts().lower_bound(block_));
        result.stock_volume = volume(input_.stock);
        const double share = uncut_ > 0.0 ? std::min(field_->volume() / uncut_, 1.0) : 0.0;
        result.left_volume = share * result.stock_volume;
        return result;
    }

    Simulation finish() {
        Simulation result = found();
        removal_.reset();
        result.field = std::move(field_);
        return result;
    }

private:
    [[nodiscard]] std::size_t keyframe_room() const {
        return input_.most_bytes - std::min(field_->bytes(), input_.most_bytes);
    }
    /// Of the last keyframe not after `block`; -1 if there is none.
    [[nodiscard]] int next_keyframe(int block) const {
        int found = -1;
        for (std::size_t n = 0; n < keyframes_.count() && keyframes_.block(n) <= block; ++n) {
            found = keyframes_.block(n);
        }
        return found;
    }

    /// To the last keyframe before `block`, or to the stock.
    void rewind(int block) {
        const int to = next_keyframe(block);
        steps_.clear();
        if (to >= 0) {
            std::size_t n = 0;
            while (keyframes_.block(n) != to) {
                ++n;
            }
            keyframes_.restore(n, *field_);
        } else {
            *field_ = DexelField(input_.stock, input_.resolution, input_.most_bytes, Progress());
        }
        block_ = std::max(to, 0);
        state_ = states_.at(block_);
        removal_->record_from(farthest_);
        steps_since_ = 0;
    }

    /// Keeps a keyframe where one is due.
    void keep() {
        farthest_ = std::max(farthest_, block_);
        removal_->record_from(farthest_);
        const int last = keyframes_.count() > 0 ? keyframes_.block(keyframes_.count() - 1) : 0;
        if (!rewinds_) {
            return;
        }
        int thinned = 0;
        if (block_ > last && steps_since_ >= steps_per_keyframe_) {
            thinned = keyframes_.add(*field_, block_, keyframe_room());
            states_.insert_or_assign(block_, state_);
            steps_since_ = 0;
        } else {
            thinned = keyframes_.fit(keyframe_room());
        }
        for (int n = 0; n < thinned; ++n) {
            steps_per_keyframe_ *= 2;
        }
        std::erase_if(states_, [&](const auto& one) {
            return one.first != 0 && next_keyframe(one.first) != one.first;
        });
    }

    void take(int n, const Progress& progress, double done) {
        const program::Block& block = input_.program.blocks[static_cast<std::size_t>(n)];
        while (state_.next_tool < input_.tools.size() && input_.tools[state_.next_tool].first_block <= n) {
            ++state_.next_tool;
        }
        if (block.kind == program::BlockKind::spindle_on) {
            state_.spindle = true;
        } else if (block.kind == program::BlockKind::spindle_off) {
            state_.spindle = false;
        }
        if (!block.moves()) {
            return;
        }
        if (state_.known.all()) {
            follow(n, block, progress, done);
            return;
        }
        state_.known.take(block);
        state_.first_block = n + 1;
        auto& skipped = state_.skipped;
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

    void follow(int n, const program::Block& block, const Progress& progress, double done) {
        const bool rapid = block.kind == program::BlockKind::rapid;
        if (state_.next_tool == 0 || !bodies_[state_.next_tool - 1]) {
            if (!rapid) {
                throw at_line(block,
                              "this move cuts, and no tool is in the spindle",
                              "the program has to call the tool (M6) before it");
            }
            return;
        }
        const CuttingBody& body = *bodies_[state_.next_tool - 1];
        const AboveCutter& above = above_[state_.next_tool - 1];
        const auto& own = input_.tools[state_.next_tool - 1].machine;
        const kinematics::StraightForward way(
            own ? *own : input_.machine, program::position_before(input_.program, n), block.target);
        const double parts = parts_of(way);
        constexpr double most_parts = 200'000;
        if (!(parts <= most_parts)) {
            throw at_line(block, "the move goes too far to be simulated", "check its coordinates");
        }
        ++state_.moves;
        if (!state_.spindle) {
            without_spindle_.insert(n);
        }
        ToolPose last = way.at(0.0);
        for (int count = 1; count <= static_cast<int>(parts); ++count) {
            const ToolPose next = way.at(count / parts);
            const CutStep kind{.cutter = &body, .move = n, .contact_counts = rapid};
            follow_part(kind, above, {last, next}, [&] {
                if (steps_.size() >= steps_at_a_time) {
                    flush(progress, done); // one move may be longer than the memory
                }
            });
            last = next;
        }
    }

    /// A straight part of a move. Where shank or holder can reach the stock, they come before the cutter in
    /// each stretch of it. `kind`: what the steps of the cutter have in common; `added` is called now and
    /// then.
    void follow_part(const CutStep& kind,
                     const AboveCutter& above,
                     const StraightPart& way,
                     const std::function<void()>& added) {
        const std::optional<PartRange> near = above.range_near(field_->box(), way);
        if (!near) {
            add(*kind.cutter, way.from, way.to, kind);
            added();
            return;
        }
        if (near->first > 0.0) {
            add(*kind.cutter, way.from, way.at(near->first), kind);
        }
        const StraightPart inner{way.at(near->first), way.at(near->last)};
        const double count = above.stretch_count(*kind.cutter, inner);
        expect_few(count, kind.move);
        ToolPose last = inner.from;
        for (int n = 1; n <= static_cast<int>(count); ++n) {
            const ToolPose next = inner.at(n / count);
            for (const auto& [part, body] : above.bodies()) {
                add(body, last, next, {.move = kind.move, .contact_counts = true, .part = part});
            }
            add(*kind.cutter, last, next, kind);
            added();
            last = next;
        }
        if (near->last < 1.0) {
            add(*kind.cutter, inner.to, way.to, kind);
        }
        added();
    }

    void expect_few(double steps, std::int32_t move) const {
        if (!(steps <= 0.99 * most_steps_per_move)) {
            throw at_line(
                block_of(move), "the move is too long for so small a tool", "check the tool's diameter");
        }
    }

    /// The stretch of a straight move that can reach the stock. `kind`: what its steps have in common.
    void add(const CuttingBody& body, const ToolPose& from, const ToolPose& to, const CutStep& kind) {
        const toolpath::ProfileShape& shape = body.body.shape();
        const double reach = std::max(std::abs(shape.top), std::abs(shape.bottom)) + shape.radius;
        const std::optional<PartRange> range =
            range_near(field_->box(), Box3(Vec3::Constant(-reach), Vec3::Constant(reach)), from.tip, to.tip);
        if (!range) {
            return;
        }
        const auto [first, last] = *range;
        const StraightPart way{from, to};
        expect_few(step_count(body, from, to) * (last - first), kind.move);
        const std::size_t known = steps_.size();
        divide(body, way.at(first), way.at(last), kind.move, kind.contact_counts, steps_);
        for (std::size_t k = known; k < steps_.size(); ++k) {
            steps_[k].part = kind.part;
        }
    }

    [[nodiscard]] const program::Block& block_of(std::int32_t n) const {
        return input_.program.blocks[static_cast<std::size_t>(n)];
    }

    /// Shank or holder in material: when it reaches the place, and how deep that gets.
    [[nodiscard]] Finding touched(int n, ToolPart part, const Contact& contact) const {
        const program::Block& block = input_.program.blocks[static_cast<std::size_t>(n)];
        const ToolUse* use = nullptr;
        for (const ToolUse& tool : input_.tools) {
            use = tool.first_block <= n ? &tool : use;
        }
        const toolpath::Profile& body = part == ToolPart::holder ? *use->holder : *use->shank;
        const kinematics::StraightForward way(use->machine ? *use->machine : input_.machine,
                                              program::position_before(input_.program, n),
                                              block.target);
        Finding finding{part == ToolPart::holder ? FindingKind::holder_in_stock : FindingKind::shank_in_stock,
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

    /// `done` is the share of the call's blocks that have been taken.
    void flush(const Progress& progress, double done) {
        if (steps_.empty()) {
            return;
        }
        removal_->remove(steps_, progress.part(done_, std::max(done, done_)));
        done_ = std::max(done, done_);
        steps_since_ += steps_.size();
        const std::int32_t move = steps_.back().move;
        steps_.clear();
        if (const std::size_t bytes = field_->bytes(); bytes > input_.most_bytes) {
            constexpr double mega = 1e6;
            throw at_line(
                block_of(move),
                fmt::format("what is left of the stock takes {:.0f} MB of memory, and {:.0f} MB "
                            "may be used",
                            static_cast<double>(bytes) / mega,
                            static_cast<double>(input_.most_bytes) / mega),
                fmt::format("a resolution of {:.2g} mm takes less", 1.5 * field_->cell().maxCoeff()));
        }
    }

    const SimulationInput& input_;
    bool rewinds_;
    std::unique_ptr<DexelField> field_;
    double uncut_; // volume of the field, mm^3
    std::unique_ptr<Removal> removal_;
    std::deque<std::optional<CuttingBody>> bodies_; // steps point to them
    std::deque<AboveCutter> above_;
    ProgramState state_;                 // before block_
    std::map<int, ProgramState> states_; // before the blocks of the keyframes, and before block 0
    Keyframes keyframes_;
    std::set<int> without_spindle_;
    std::vector<CutStep> steps_;
    std::size_t steps_since_ = 0;           // the last keyframe
    std::size_t steps_per_keyframe_ = 2000; // a tenth of a second, with a tool of usual size
    int block_ = 0;
    int farthest_ = 0; // block that was ever cut to
    double done_ = 0.0;
    bool is_torn_ = false; // a call threw in the middle
};

namespace {

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

Simulator::Simulator(const SimulationInput& input, Rewind rewind, const Progress& progress) {
    expect_machine(input);
    work_ = std::make_unique<Work>(input, rewind, progress);
}
Simulator::~Simulator() = default;

void Simulator::advance_to(int block, const Progress& progress) {
    work_->advance_to(block, progress);
}

void Simulator::advance_to_line(int line, const Progress& progress) {
    const auto& blocks = work_->program().blocks;
    const auto beyond =
        std::ranges::find_if(blocks, [&](const program::Block& block) { return block.source_line > line; });
    advance_to(static_cast<int>(beyond - blocks.begin()), progress);
}

int Simulator::block() const {
    return work_->block();
}
const DexelField& Simulator::field() const {
    return work_->field();
}
const std::map<std::int32_t, MoveCut>& Simulator::cuts() const {
    return work_->removal().cuts();
}
std::size_t Simulator::keyframe_count() const {
    return work_->keyframes().count();
}
std::size_t Simulator::keyframe_bytes() const {
    return work_->keyframes().bytes();
}

Simulation Simulator::found() const {
    return work_->found();
}

Simulation Simulator::finish() && {
    return work_->finish();
}

} // namespace millwright::simulation
