// A table that plans its own moves: each record gives it a target, a speed and an acceleration, one record
// per move, as `t x y z a s` in the KMITL master's thesis of 2006 (forming software for wood and plastic).
// Programs of straight moves are sent block by block. Format: docs/reference/coordinate-stream.md. Lengths
// mm, times s.
#pragma once

#include "core/drivers/session_driver.h"
#include "core/drivers/stream/record_format.h"

#include <memory>

namespace millwright::drivers {

namespace records {
class RecordSession;
} // namespace records

struct RecordsOptions {
    RecordFormat format = {}; ///< {s} is the speed of the move, {a} its acceleration
    int decimals = 4;         ///< of everything, 0 to 9
    bool known = true;        ///< where the table stands; else that is assumed until it went somewhere
};

/// One record is under way at a time, so hold and stop are obeyed where it ends. What is claimed to be
/// executed is what was answered; without answers, what the table had the time for, from rest to rest. Any
/// other answer, or none in time, is an alarm, and nothing more is sent. Spindle and coolant are a person's.
class RecordsDriver final : public SessionDriver {
public:
    /// The table stands at `position`; it does not report that. `clock` must outlive it. Throws Error for
    /// options out of range, and for a machine with rotary axes.
    RecordsDriver(std::unique_ptr<links::Link> link,
                  const Clock& clock,
                  std::shared_ptr<const kinematics::MachineModel> model,
                  kinematics::AxisPositions position,
                  const RecordsOptions& options = {});
    RecordsDriver(const RecordsDriver&) = delete;
    RecordsDriver& operator=(const RecordsDriver&) = delete;
    ~RecordsDriver() override;

    [[nodiscard]] std::string name() const override { return "records"; }
    [[nodiscard]] Capabilities capabilities() const override;
    /// Throws Error for a text without the program that was made of it, too.
    void start(Work work) override;
    void set_optional_stop(bool on) override;
    void set_single_block(bool on) override;
    /// Also in an alarm, after which nothing begins before it.
    void stands_at(const kinematics::AxisPositions& position) override;

private:
    [[nodiscard]] records::RecordSession& talk() const;
};

} // namespace millwright::drivers
