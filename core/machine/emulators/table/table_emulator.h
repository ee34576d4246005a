// The other end of a coordinate stream of records: a table that goes where each record says and answers it.
// Lengths mm, angles degrees.
#pragma once

#include "core/machine/drivers/stream/record_format.h"
#include "core/machine/links/link.h"

#include <cstdint>
#include <memory>
#include <mutex>
#include <thread>
#include <vector>

namespace millwright::machine {

struct TableOptions {
    int decimals = 4;
    std::int64_t silent_from = 0; ///< from this record on (counted from 1) it answers nothing; 0: never
    std::int64_t refuses = 0;     ///< this record is answered by `error`, and not obeyed; 0: none
    bool keep = false;            ///< every position, for tests
};

class TableEmulator {
public:
    /// Stands at zero. Opens the link and serves it in a thread of its own until destroyed. Throws Error for
    /// a format or a link that cannot be.
    TableEmulator(std::unique_ptr<Link> link,
                  const RecordFormat& format,
                  const kinematics::MachineModel& model,
                  TableOptions options = {});
    TableEmulator(const TableEmulator&) = delete;
    TableEmulator& operator=(const TableEmulator&) = delete;
    ~TableEmulator();

    /// Records that were obeyed.
    [[nodiscard]] std::int64_t records() const;
    /// Lines that were no record.
    [[nodiscard]] std::int64_t bad_lines() const;
    /// Of each axis of the machine.
    [[nodiscard]] std::vector<double> position() const;
    /// After each record, if they are kept.
    [[nodiscard]] std::vector<std::vector<double>> positions() const;

private:
    void serve(const std::stop_token& stop);
    void take(const std::string& line);
    [[nodiscard]] std::string obey(const Record& record);

    std::unique_ptr<Link> link_;
    RecordFormat format_;
    RecordText text_;
    TableOptions options_;
    mutable std::mutex mutex_; ///< guards what follows
    std::int64_t seen_ = 0;
    std::int64_t records_ = 0;
    std::int64_t bad_lines_ = 0;
    std::vector<double> position_;
    std::vector<std::vector<double>> positions_;
    std::jthread thread_;
};

} // namespace millwright::machine
