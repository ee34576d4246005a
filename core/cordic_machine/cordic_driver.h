// The CORDIC processor with a motion controller behind it, as a machine: a program's text is compiled, the
// processor computes its set-points and commands clock by clock, and a virtual machine moves along them. What
// the processor cannot do is refused before anything moves: docs/reference/cordic.md#compiler.
#pragma once

#include "core/base/clock.h"
#include "core/base/error.h"
#include "core/cordic/run_report.h"
#include "core/cordic_machine/cordic_program.h"
#include "core/drivers/driver.h"
#include "core/drivers/virtual_machine/virtual_machine.h"
#include "core/gcode_programs/work_origin.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

namespace millwright::cordic_machine {

struct CordicDriverOptions {
    CordicProgramSettings program; ///< but for the start and the processor
    cordic::ProcessorSettings processor;
    double clock_hz = 8e6; ///< for the report: which set-points would come late
    std::int64_t most_clocks = cordic::usual_most_clocks; ///< a program that takes more is refused
    /// Where the zero of programs lies on the machine; not given: not known, so that none may depend on it.
    std::optional<gcode::WorkOrigin> origin{};
};

class CordicDriver final : public drivers::Driver {
public:
    /// Stands at `position`, disconnected. `clock` must outlive it. Throws Error for a speed out of range.
    CordicDriver(kinematics::AxisPositions position,
                 drivers::VirtualSpeed speed,
                 Clock& clock,
                 std::shared_ptr<const kinematics::MachineModel> model,
                 CordicDriverOptions options = {});

    [[nodiscard]] std::string name() const override { return "cordic"; }
    /// Blocks are those of the work's listing.
    [[nodiscard]] drivers::DriverStatus status() const override;
    [[nodiscard]] drivers::Capabilities capabilities() const override;
    /// What the processor did for the last program.
    [[nodiscard]] cordic::RunReport report() const;
    /// Of set-points of the last program that came late, in a sentence; empty where none did.
    [[nodiscard]] std::string remark() const;

    /// What the last program asks for and the processor does otherwise, by line.
    [[nodiscard]] std::vector<Diagnostic> warnings() const;

    void connect() override { machine_.connect(); }
    /// Uses the listing alone. Throws Error with line and column for what the processor cannot do, for what
    /// depends on where the work lies while that is not given, and if it stops before the end of the program.
    void start(drivers::Work work) override;
    void hold() override { machine_.hold(); }
    void resume() override { machine_.resume(); }
    void stop() override { machine_.stop(); }
    void emergency_stop() override { machine_.emergency_stop(); }
    void reset() override { machine_.reset(); }
    void close() noexcept override { machine_.close(); }
    void set_overrides(const drivers::Overrides& wanted) override { machine_.set_overrides(wanted); }
    void set_optional_stop(bool on) override { machine_.set_optional_stop(on); }
    void jog(const drivers::Jog& jog) override { machine_.jog(jog); }
    void stop_jog() override { machine_.stop_jog(); }
    void home() override { machine_.home(); }
    int command(const std::string& lines) override { return machine_.command(lines); }
    /// The origin, of every work system; without one what was set by hand.
    [[nodiscard]] std::vector<drivers::StoredOffset> stored_offsets() const override;
    [[nodiscard]] drivers::Console* console() override { return machine_.console(); }

private:
    /// The blocks of the listing behind the records that are executed.
    struct BlockMap {
        std::vector<int> block;    ///< of each record: -1 above the first
        std::vector<int> executed; ///< for certain, before each record and after the last

        [[nodiscard]] drivers::DriverStatus translated(drivers::DriverStatus status) const;
    };

    /// `tool`: whose length the listing calls; nullopt: any has the length 0.
    [[nodiscard]] CordicProgram compiled(const program::Listing& listing,
                                         const gcode::AxisValues& start,
                                         const std::optional<program::ProgramTool>& tool) const;
    /// Throws Error with the place unless the processor has halted.
    void refuse_unfinished(const cordic::Processor& processor, const CordicProgram& made) const;
    [[nodiscard]] static BlockMap map_of(const program::Program& records, const program::Listing& listing);

    std::shared_ptr<const kinematics::MachineModel> model_;
    CordicDriverOptions options_;
    drivers::VirtualMachine machine_;
    mutable std::mutex mutex_; ///< guards what follows
    cordic::RunReport report_;
    std::vector<Diagnostic> warnings_;
    BlockMap blocks_;
};

} // namespace millwright::cordic_machine
