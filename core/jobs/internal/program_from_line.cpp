#include "core/jobs/internal/program_from_line.h"

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/kinematics/forward.h"
#include "core/kinematics/inverse.h"
#include "core/posts/writer.h"
#include "core/program/program_settings.h"
#include "core/program/retract.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::jobs::internal {

namespace {

using kinematics::AxisPositions;
using kinematics::MachineModel;
using program::AxisSet;
using program::Block;
using program::BlockKind;
using program::Listing;
using program::Program;

[[noreturn]] void refuse(const Job& job, int line, std::string why, std::string hint = {}) {
    throw Error(Diagnostic{{job.project, line, 0, -1}, std::move(why), std::move(hint)});
}

/// The first block at `line` or below.
int first_block(const Job& job, int line) {
    const Listing& listing = *job.listing;
    if (line < 1 || line > listing.line_count()) {
        refuse(job, line, fmt::format("the program has only {}", counted(listing.line_count(), "line")));
    }
    const auto found = std::ranges::lower_bound(listing.line_of_block, line);
    if (found == listing.line_of_block.end()) {
        refuse(job, line, "the program has no blocks from this line on");
    }
    return static_cast<int>(found - listing.line_of_block.begin());
}

void check_room_above(const Job& job, int line, int block) {
    if (job.listing->line_of_block[static_cast<std::size_t>(block)] <= approach_lines) {
        refuse(job,
               line,
               fmt::format("line {} is one of the first {} lines, which are needed for the approach",
                           line,
                           approach_lines),
               "run the program from the beginning");
    }
}

/// The way of the tool to where a block begins: off the part, across, down, and along its axis.
class Approach {
public:
    Approach(const Job& job, int block, int line, const RunFromSettings& settings)
        : job_(job), machine_(*job.machine), retract_(program::retract_axis(machine_)), block_(block),
          line_(line), settings_(settings), begin_(program::position_before(*job.program, block)) {
        result_.machine = job.program->machine;
        result_.axes = job.program->axes;
        result_.start = job.program->start;
        result_.tool = job.program->tool;
    }

    Program make() {
        const double safe = safe_position();
        AxisPositions off = result_.start;
        off[retract_.axis] = safe;
        move(off, AxisSet::only(retract_.axis), 0.0);
        AxisPositions above = above_the_part(safe);
        AxisPositions across = above;
        across[retract_.axis] = safe;
        move(across, AxisSet::all(machine_.axis_count()), 0.0);
        switch_on();
        move(above, AxisSet::all(machine_.axis_count()), feed());
        move(begin_, AxisSet::all(machine_.axis_count()), plunge_feed());
        return std::move(result_);
    }

private:
    const Job& job_;
    const MachineModel& machine_;
    program::RetractAxis retract_;
    int block_, line_;
    const RunFromSettings& settings_;
    AxisPositions begin_;
    Program result_;

    [[nodiscard]] double height(const AxisPositions& position) const {
        return retract_.sense * position[retract_.axis];
    }

    /// As wanted, else the highest to which the blocks before have gone rapidly, else the limit.
    [[nodiscard]] double safe_position() const {
        std::optional<double> safe = settings_.clearance;
        for (int n = 0; n < block_ && !settings_.clearance; ++n) {
            const Block& block = job_.program->blocks[static_cast<std::size_t>(n)];
            const bool higher = !safe || height(block.target) > retract_.sense * *safe;
            if (block.kind == BlockKind::rapid && higher) {
                safe = block.target[retract_.axis];
            }
        }
        const double position = safe ? *safe : program::safe_position(machine_, {});
        if (!(retract_.sense * position >= height(begin_))) {
            const char letter = machine_.axis(retract_.axis).letter;
            refuse(job_,
                   line_,
                   fmt::format("the clearance {}{:.3f} is below {}{:.3f}, the start of this line",
                               letter,
                               position,
                               letter,
                               begin_[retract_.axis]),
                   "specify a clearance");
        }
        return position;
    }

    /// As far along the tool's axis as programs come in by themselves, if that is not above the clearance.
    [[nodiscard]] AxisPositions above_the_part(double safe) const {
        const double lift = program::ProgramSettings{}.approach_clearance;
        const geometry::ToolPose pose = kinematics::forward(machine_, begin_);
        const AxisPositions lifted = kinematics::with_tip_at(machine_, begin_, pose.tip + lift * pose.axis);
        const double room = retract_.sense * safe - height(begin_);
        const double rise = height(lifted) - height(begin_);
        const double part = rise > room ? room / rise : 1.0;
        return begin_ + part * (lifted - begin_);
    }

    Block& add(BlockKind kind) {
        const AxisPositions here = program::position_before(result_, result_.block_count());
        Block& block = result_.blocks.emplace_back();
        block.kind = kind;
        block.target = here;
        return block;
    }

    /// A feed of 0 is a rapid. A way of no length is left out.
    void move(const AxisPositions& target, AxisSet named, double feed) {
        const AxisPositions here = program::position_before(result_, result_.block_count());
        const double way =
            (kinematics::forward(machine_, target).tip - kinematics::forward(machine_, here).tip).norm();
        constexpr std::size_t to_a_known_place = 2; // moves: the machine stands anywhere before
        if (result_.blocks.size() >= to_a_known_place && (target - here).cwiseAbs().maxCoeff() <= 0.0) {
            return;
        }
        Block& block = add(feed > 0.0 ? BlockKind::feed : BlockKind::rapid);
        block.role = program::MoveRole::approach;
        block.target = target;
        block.named = named;
        block.feed = feed;
        block.duration = feed > 0.0 ? way / feed : 0.0;
    }

    /// Spindle and coolant as the blocks before have left them.
    void switch_on() {
        double rpm = 0.0;
        bool coolant = false;
        for (int n = 0; n < block_; ++n) {
            const Block& block = job_.program->blocks[static_cast<std::size_t>(n)];
            rpm = block.kind == BlockKind::spindle_on    ? block.spindle_rpm
                  : block.kind == BlockKind::spindle_off ? 0.0
                                                         : rpm;
            coolant =
                block.kind == BlockKind::coolant_on || (block.kind != BlockKind::coolant_off && coolant);
        }
        if (std::abs(rpm) > 0.0) {
            add(BlockKind::spindle_on).spindle_rpm = rpm;
            add(BlockKind::dwell).duration = settings_.spindle_time;
        }
        if (coolant) {
            add(BlockKind::coolant_on);
        }
    }

    /// Of the next feed; where there is none, the value does not matter.
    [[nodiscard]] double feed() const {
        const auto& blocks = job_.program->blocks;
        const auto next = std::find_if(blocks.begin() + block_, blocks.end(), [](const Block& block) {
            return block.kind == BlockKind::feed && block.feed > 0.0;
        });
        return next == blocks.end() ? program::ProgramSettings{}.plunge_feed : next->feed;
    }

    [[nodiscard]] double plunge_feed() const {
        double slowest = std::min(feed(), program::ProgramSettings{}.plunge_feed);
        const AxisPositions* from = &job_.program->start;
        for (const Block& block : job_.program->blocks) {
            const bool plunges =
                block.feed > 0.0 && (block.role == program::MoveRole::plunge || goes_down(*from, block));
            slowest = plunges ? std::min(slowest, block.feed) : slowest;
            from = block.target.size() > 0 ? &block.target : from;
        }
        return slowest;
    }

    /// Along the axis that pulls the tool off the part, alone: how files that are read plunge.
    [[nodiscard]] bool goes_down(const AxisPositions& from, const Block& block) const {
        if (block.kind != BlockKind::feed || block.target.size() != from.size()) {
            return false;
        }
        AxisPositions way = block.target - from;
        const bool down = retract_.sense * way[retract_.axis] < 0.0;
        way[retract_.axis] = 0.0;
        return down && !(way.cwiseAbs().maxCoeff() > 0.0);
    }
};

/// The words of the approach alone, a line each: what stands on top of every program would take the room. But
/// the tool's length stays in force.
Listing words_of(const Program& approach) {
    Listing words = posts::write_gcode(approach, {});
    const int head = words.line_of_block.front() - 1;
    words.text.erase(0, words.line_starts[static_cast<std::size_t>(head)]);
    if (approach.tool) {
        words.text.insert(0, fmt::format("G43 H{} ", approach.tool->number));
    }
    for (int& line : words.line_of_block) {
        line -= head;
    }
    return words;
}

/// Above `line` the words of the approach, and empty lines; from there on the lines of `whole`.
Listing joined(const Program& approach, const Listing& whole, int block) {
    Listing words = words_of(approach);
    const auto taken = std::ranges::count(words.text, '\n');
    const int last = whole.line_of_block[static_cast<std::size_t>(block)];
    expects(taken <= approach_lines, "an approach fits above the line");
    Listing result;
    result.text = words.text + std::string(static_cast<std::size_t>(last - 1 - taken), '\n') +
                  whole.text.substr(whole.line_starts[static_cast<std::size_t>(last) - 1]);
    result.line_of_block = words.line_of_block;
    result.line_of_block.insert(
        result.line_of_block.end(), whole.line_of_block.begin() + block, whole.line_of_block.end());
    result.line_starts.push_back(0);
    for (std::size_t n = 0; n < result.text.size(); ++n) {
        if (result.text[n] == '\n') {
            result.line_starts.push_back(n + 1);
        }
    }
    return result;
}

} // namespace

Job program_from_line(const Job& job, int line, const RunFromSettings& settings) {
    expects(job.listing != nullptr && job.program != nullptr && job.machine != nullptr,
            "a job with a program has its listing and a machine");
    const int block = first_block(job, line);
    check_room_above(job, line, block);
    Program program = Approach(job, block, line, settings).make();
    Listing listing = joined(program, *job.listing, block);
    program.blocks.insert(
        program.blocks.end(), job.program->blocks.begin() + block, job.program->blocks.end());
    Job result = job;
    result.program = std::make_shared<const Program>(std::move(program));
    result.listing = std::make_shared<const Listing>(std::move(listing));
    result.from_line = line;
    result.hash = job.hash.empty() ? program_hash(job.listing->text) : job.hash;
    return result;
}

} // namespace millwright::jobs::internal
