// The log of one job on disk: a JSON object a line, each handed to the system before the job goes on, so that
// it survives the end of this program at any moment. Format: docs/reference/job-log.md. In the file mm and
// degrees, here mm and rad.
#pragma once

#include "core/jobs/job.h"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::jobs {

/// What the first line says.
struct LogStart {
    std::string job, project, machine, driver, program_hash, started_at;
    std::string address;                    ///< Driver::address()
    std::vector<program::ProgramAxis> axes; ///< in the order of the positions
    int blocks = 0;
    double planned_time = 0.0;
    std::string options; ///< Job::options
    int from_line = 1;   ///< of the program's file; more than 1: it was not run from its beginning
    std::string position_confirmed{}; ///< DriverStatus::position_confirmed
    std::string firmware{};           ///< Driver::firmware()
    bool answers = true;              ///< Capabilities::Reports::execution

    friend bool operator==(const LogStart&, const LogStart&) = default;
};

enum class LogEvent {
    ahead,    ///< the driver may give the controller more blocks from now on, up to LogRecord::allowed_blocks
    executed, ///<
    sent,     ///< in place of it, to a machine that does not answer
    waiting,  ///< the machine rests until a person goes on: LogRecord::text says why
    hold,
    resume,
    stop,
    overrides,
    single_block,
    optional_stop,
    own, ///< a line that is not of the program was sent, for a tool change: LogRecord::text
    fault,
    end
};

[[nodiscard]] std::string_view to_text(LogEvent event);

/// One of the other lines.
struct LogRecord {
    LogEvent event = LogEvent::executed;
    double time = 0.0;       ///< s since the start of the job
    int executed_blocks = 0; ///< completely, for certain; sent, where LogStart::answers says so
    int line = 0;            ///< of the listing, where the next block stands; 0: not known
    kinematics::AxisPositions position;
    std::optional<JobEnd> end; ///< of LogEvent::end
    std::string text;          ///< a sentence, may be empty
    int allowed_blocks = 0;    ///< of LogEvent::ahead
    /// As DriverStatus::position_doubt. What arose during the job is not in `position`, the last that was
    /// known before.
    std::string position_doubt;

    friend bool operator==(const LogRecord&, const LogRecord&) = default;
};

/// The log cannot be written.
class JobLogError : public Error {
public:
    /// `reason`: the system's.
    JobLogError(std::string reason, const std::filesystem::path& file);

    [[nodiscard]] const std::string& reason() const noexcept { return reason_; }

private:
    std::string reason_;
};

/// A log being written. Used by one thread. While other lines are written there is room on the disk for those
/// of a fault and of the end, so that a full disk does not keep these out; not where the file system keeps no
/// room.
class JobLog {
public:
    /// Makes a new file NAME-0001.jsonl (or the next free number) in `folder`, which is made where missing;
    /// everything in `name` but letters, digits, '-', '_' and '.' becomes '_'. Throws Error with the file and
    /// the system's reason. A log without a whole line is removed at the end.
    JobLog(const std::filesystem::path& folder, const std::string& name);
    JobLog(const JobLog&) = delete;
    JobLog& operator=(const JobLog&) = delete;
    ~JobLog();

    [[nodiscard]] const std::filesystem::path& file() const { return file_; }

    /// Each appends one line, the start first. Throws JobLogError if it did not get to the system whole; what
    /// did is taken back, so that another line can follow.
    void write(const LogStart& start);
    void write(const LogRecord& record);

private:
    void append(const std::string& line, bool last);
    void keep_room(std::int64_t bytes);

    std::filesystem::path file_;
    int handle_ = -1;
    std::int64_t size_ = 0; ///< bytes of whole lines
    std::int64_t room_ = 0; ///< bytes of the file that the disk has room for; at least size_ where it is kept
    bool keeps_room_ = true;
    std::vector<program::ProgramAxis> axes_;
    bool answers_ = true;
};

struct ReadLog {
    LogStart start;
    std::vector<LogRecord> records;
    bool torn = false; ///< the last line was cut off while being written; it is left out

    /// Blocks that were executed for certain, or sent, where start.answers says so.
    [[nodiscard]] int executed_blocks() const { return records.empty() ? 0 : records.back().executed_blocks; }
    /// No block from this one on was given to the controller. All, for drivers that hand a program over
    /// whole.
    [[nodiscard]] int allowed_blocks() const;
    /// Of the listing, where the first block stands that was not completely executed; 0: not known.
    [[nodiscard]] int next_line() const { return records.empty() ? 0 : records.back().line; }
    /// How the job ended; nothing if the log stops before.
    [[nodiscard]] std::optional<JobEnd> end() const;
};

/// Whether the program that writes this log still lives.
[[nodiscard]] bool is_being_written(const std::filesystem::path& file);

/// Throws Error with file and line for anything wrong in it but a torn last line.
[[nodiscard]] ReadLog read_job_log(const std::filesystem::path& file);

} // namespace millwright::jobs
