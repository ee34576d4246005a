// The log of one job on disk: a JSON object a line, each handed to the system before the job goes on, so that
// it survives the end of this program at any moment. Format: docs/reference/job-log.md.
#pragma once

#include "core/kinematics/machine_model.h"

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::machine {

/// One line. Positions in the file are mm and degrees, here mm and rad.
struct LogRecord {
    double time = 0.0; ///< s since the start of the job
    std::string event; ///< start, executed, hold, resume, stop, fault, end
    int executed_blocks = 0;
    int line = 0; ///< of the listing, of the last executed block; 0: none
    kinematics::AxisPositions position;
    std::string text; ///< reason or sentence
};

/// What the first line says.
struct LogStart {
    std::string job, project, machine, driver, program_hash, started_at;
    std::string axes; ///< letters, in the order of the positions
    int blocks = 0;
    double planned_time = 0.0;
};

class JobLog {
public:
    /// Makes a new file NAME-0001.jsonl (or the next free number) in `folder`, which is made where missing.
    /// Throws Error with the file and the system's reason.
    JobLog(const std::filesystem::path& folder, const std::string& name);
    JobLog(const JobLog&) = delete;
    JobLog& operator=(const JobLog&) = delete;
    ~JobLog();

    [[nodiscard]] const std::filesystem::path& file() const { return file_; }

    /// Each appends one line. Throws Error if it did not get to the system whole.
    void write(const LogStart& start, const kinematics::MachineModel& machine);
    void write(const LogRecord& record);

private:
    void append(std::string line);

    std::filesystem::path file_;
    int handle_ = -1;
    std::vector<kinematics::MachineAxis> axes_;
};

struct ReadLog {
    LogStart start;
    std::vector<LogRecord> records;
    bool torn = false; ///< the last line was cut off while being written; it is left out
    /// Blocks that were executed for certain.
    [[nodiscard]] int executed_blocks() const;
    /// Whether the log tells how the job ended.
    [[nodiscard]] bool ended() const;
};

/// Throws Error with file and line for anything wrong in it but a torn last line.
[[nodiscard]] ReadLog read_job_log(const std::filesystem::path& file);

} // namespace millwright::machine
