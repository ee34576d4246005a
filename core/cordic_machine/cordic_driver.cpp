#include "core/cordic_machine/cordic_driver.h"

#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/cordic_machine/cordic_motion.h"
#include "core/drivers/mdi_lines.h"
#include "core/gcode/interpreter.h"
#include "core/motion/planner.h"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstddef>
#include <utility>

namespace millwright::cordic_machine {

namespace {

using gcode::AxisValues;
using kinematics::AxisKind;
using kinematics::AxisPositions;

constexpr const char* program_name = "program"; // a listing has no file of its own

/// mm and degrees, as programs say them.
AxisValues values_of(const AxisPositions& position, const kinematics::MachineModel& model) {
    AxisValues values;
    for (std::size_t n = 0; n < gcode::axis_count; ++n) {
        const int index = model.axis_index(gcode::axis_letters[n]);
        if (index >= 0) {
            const bool rotary = model.axis(index).kind == AxisKind::rotary;
            values[n] = rotary ? to_degrees(position[index]) : position[index];
        }
    }
    return values;
}

void throw_first(const std::vector<Diagnostic>& found) {
    if (!found.empty()) {
        throw Error(found.front());
    }
}

} // namespace

CordicDriver::CordicDriver(AxisPositions position,
                           drivers::VirtualSpeed speed,
                           Clock& clock,
                           std::shared_ptr<const kinematics::MachineModel> model,
                           CordicDriverOptions options)
    : model_(std::move(model)), options_(std::move(options)),
      machine_(std::move(position), speed, clock, model_) {
    expects(model_ != nullptr, "the motion controller knows its machine");
}

drivers::Capabilities CordicDriver::capabilities() const {
    drivers::Capabilities able = machine_.capabilities();
    able.takes = drivers::Capabilities::Takes::text;
    able.program.single_block = false; // its blocks are set-points, not those of the listing
    able.dialect = gcode::Dialect::linuxcnc;
    return able;
}

cordic::RunReport CordicDriver::report() const {
    const std::scoped_lock lock(mutex_);
    return report_;
}

std::string CordicDriver::remark() const {
    const cordic::RunReport done = report();
    if (done.late.empty()) {
        return {};
    }
    return fmt::format("{} of {} took longer to compute at {:.6g} MHz than the motion before them lasts; "
                       "none would be late at up to {:.6g} mm/min",
                       done.late.size(),
                       counted(done.published, "set-point"),
                       1e-6 * options_.clock_hz,
                       to_mm_per_min(done.fastest.value_or(0.0))); // with late ones there are two at least
}

std::vector<Diagnostic> CordicDriver::warnings() const {
    const std::scoped_lock lock(mutex_);
    return warnings_;
}

CordicProgram CordicDriver::compiled(const program::Listing& listing,
                                     const AxisValues& start,
                                     const std::optional<program::ProgramTool>& tool) const {
    CordicProgramSettings settings = options_.program;
    settings.processor = options_.processor;
    settings.start = start;
    CordicProgramBuilder builder(program_name, settings);
    gcode::ReaderSettings reading;
    reading.any_tool = true;
    reading.start = start;
    if (options_.origin) {
        gcode::put_origin(reading, *options_.origin);
    }
    if (tool) { // the table of a processor that has none
        gcode::Tool& row = reading.tools.tools.emplace_back();
        row.number = tool->number;
        row.offset[gcode::Axis::z] = tool->length_offset;
    }
    gcode::Interpreter program(std::string_view(listing.text), program_name, std::move(reading), builder);
    program.run();
    throw_first(program.errors());
    CordicProgram made = builder.take();
    throw_first(made.faults);
    throw_first(made.unplaced);
    return made;
}

std::vector<drivers::StoredOffset> CordicDriver::stored_offsets() const {
    if (!options_.origin) {
        return machine_.stored_offsets();
    }
    std::vector<drivers::StoredOffset> offsets;
    constexpr int systems = 9;
    for (int system = 1; system <= systems; ++system) {
        AxisPositions value = AxisPositions::Zero(model_->axis_count());
        for (int n = 0; n < 3; ++n) {
            if (const int axis = model_->axis_index("XYZ"[n]); axis >= 0) {
                value[axis] = options_.origin->at()[n];
            }
        }
        offsets.push_back({drivers::work_system_name(system), value});
    }
    return offsets;
}

/// A block is executed when nothing that is left comes from it or from one before it, as in a loop.
CordicDriver::BlockMap CordicDriver::map_of(const program::Program& records,
                                            const program::Listing& listing) {
    BlockMap map;
    const auto count = static_cast<int>(listing.line_of_block.size());
    for (const program::Block& record : records.blocks) {
        map.block.push_back(record.source_line > 0 ? listing.block_at_line(record.source_line) : count - 1);
    }
    map.executed.assign(records.blocks.size() + 1, count);
    for (std::size_t n = records.blocks.size(); n-- > 0;) {
        map.executed[n] = std::min(map.executed[n + 1], std::max(map.block[n], 0));
    }
    return map;
}

drivers::DriverStatus CordicDriver::BlockMap::translated(drivers::DriverStatus status) const {
    const bool of_program =
        status.activity == drivers::Activity::program || status.activity == drivers::Activity::none;
    if (!of_program || status.block < 0 || executed.empty()) {
        return status;
    }
    const auto record = std::min(static_cast<std::size_t>(status.block), block.size() - 1);
    const auto done = std::min(static_cast<std::size_t>(status.executed_blocks), executed.size() - 1);
    std::size_t first = record;
    std::size_t last = record + 1;
    while (first > 0 && block[first - 1] == block[record]) {
        --first;
    }
    while (last < block.size() && block[last] == block[record]) {
        ++last;
    }
    status.fraction =
        (static_cast<double>(record - first) + status.fraction) / static_cast<double>(last - first);
    status.block = block[record];
    status.executed_blocks = executed[done];
    return status;
}

drivers::DriverStatus CordicDriver::status() const {
    const std::scoped_lock lock(mutex_);
    return blocks_.translated(machine_.status());
}

void CordicDriver::refuse_unfinished(const cordic::Processor& processor, const CordicProgram& made) const {
    const cordic::ProcessorState& state = processor.state();
    if (state.stop == cordic::Stop::none) {
        throw Error(fmt::format("the processor did not reach the end of the program within {} clocks",
                                options_.most_clocks),
                    program_name);
    }
    if (state.stop != cordic::Stop::halted) {
        throw Error(cordic::stop_diagnostic(state, made.code_lines, program_name));
    }
}

void CordicDriver::start(drivers::Work work) {
    expects(work.listing != nullptr, "a program has a listing");
    const drivers::DriverStatus before = machine_.status();
    if (before.state != drivers::DriverState::idle && before.state != drivers::DriverState::stopped) {
        throw Error(
            fmt::format("the machine is {} and cannot accept a program", drivers::in_words(before.state)));
    }
    const AxisValues start = values_of(before.position, *model_);
    CordicProgram made = compiled(*work.listing, start, work.program ? work.program->tool : std::nullopt);
    cordic::Processor processor(options_.processor, made.image);
    processor.run(options_.most_clocks);
    refuse_unfinished(processor, made);
    using gcode::Axis;
    const std::array<double, 3> from{start[Axis::x], start[Axis::y], start[Axis::z]};
    const cordic::RunReport report = cordic::report_of(processor, made.points, options_.clock_hz, from);
    CordicMotion motion = cordic_motion(processor, made, *model_, before.position, program_name);
    const auto records = std::make_shared<const program::Program>(std::move(motion.program));
    const auto trajectory = std::make_shared<const motion::Trajectory>(
        motion::plan_within(*records, motion.accelerations, *model_, {}, Progress(), before.position));
    const std::scoped_lock lock(mutex_);
    machine_.start({records, trajectory, nullptr, {}}); // whose blocks know their lines
    report_ = report;
    warnings_ = std::move(made.warnings);
    blocks_ = map_of(*records, *work.listing);
}

} // namespace millwright::cordic_machine
