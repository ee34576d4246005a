// The other end of records: a table that goes where each one says and answers it, at once or when it is
// there. Lengths mm.
#pragma once

#include "core/drivers/stream/record_format.h"
#include "core/emulators/emulator.h"

#include <cstdint>
#include <deque>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::emulators {

struct TableOptions {
    int decimals = 4;
    std::int64_t silent_from = 0; ///< from this record on (counted from 1) it answers nothing; 0: never
    std::int64_t refuses = 0;     ///< this record is answered by `error`, and not obeyed; 0: none
    std::int64_t doubles = 0;     ///< this record is answered twice; 0: none
    bool takes_time = false;      ///< moves at the speed that {s} says, and answers when it is there
    bool keep = false;            ///< every position, for tests
};

/// Begins at zero.
class TableEmulator final : public Emulator {
public:
    /// Throws Error for a format that cannot be.
    TableEmulator(const drivers::RecordFormat& format,
                  const kinematics::MachineModel& model,
                  const TableOptions& options = {});

    void receive(std::string_view bytes) override;
    [[nodiscard]] bool full() const override { return due_.size() >= most_due; }
    void advance(double seconds) override;
    [[nodiscard]] std::string take_output() override;
    [[nodiscard]] bool moving() const override { return !due_.empty(); }
    /// Stands where it is, and refuses everything until it is switched on again.
    void raise_alarm() override;
    /// Keeps its position and forgets everything else.
    void power_cycle() override;

    /// Records that were obeyed.
    [[nodiscard]] std::int64_t records() const { return records_; }
    /// Lines that were no record.
    [[nodiscard]] std::int64_t bad_lines() const { return bad_lines_; }
    /// Of each axis of the machine.
    [[nodiscard]] const std::vector<double>& position() const { return position_; }
    /// After each record, if they are kept.
    [[nodiscard]] const std::vector<std::vector<double>>& positions() const { return positions_; }

private:
    static constexpr std::size_t most_due = 10'000; ///< records that wait
    void take(const std::string& line);
    [[nodiscard]] double time_of(const drivers::Record& record) const;
    void obey();
    void answer(const std::string& text, std::int64_t record);

    struct Due {
        drivers::Record record;
        std::int64_t number = 0;
    };

    drivers::RecordFormat format_;
    drivers::RecordText text_;
    TableOptions options_;
    std::string inbox_, outbox_;
    bool alarm_ = false;
    std::deque<Due> due_;   ///< the first is on its way
    double way_left_ = 0.0; ///< s until it is there
    std::int64_t seen_ = 0;
    std::int64_t records_ = 0;
    std::int64_t bad_lines_ = 0;
    std::vector<double> position_;
    std::vector<std::vector<double>> positions_;
};

} // namespace millwright::emulators
