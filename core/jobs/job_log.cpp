#include "core/jobs/job_log.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/json.h"
#include "core/base/units.h"
#include "core/jobs/internal/named.h"

#include <fcntl.h>
#include <fmt/format.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <cmath>
#include <system_error>
#include <utility>

namespace millwright::jobs {

namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;
using kinematics::AxisKind;
using kinematics::AxisPositions;

constexpr std::string_view log_format_name = "millwright-job-log";
constexpr int log_format_version = 1;

std::string reason(int error_number) {
    return std::error_code(error_number, std::generic_category()).message();
}

std::string file_stem(const std::string& name) {
    constexpr std::string_view allowed = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_.";
    std::string stem;
    constexpr std::size_t longest_stem = 200; // bytes; a name may have 255, and ours have ends
    for (const char c : std::string_view(name).substr(0, longest_stem)) {
        stem += allowed.find(c) == std::string_view::npos ? '_' : c;
    }
    const bool visible = !stem.empty() && stem.front() != '.';
    return visible ? stem : "job" + stem;
}

/// Rounded to what a person reads: far below what any axis resolves.
double rounded(double value) {
    constexpr double steps = 1e6;
    return std::round(value * steps) / steps;
}

std::string one_line(const Json& value) {
    // Names of files may be no UTF-8; a log is not the place to fail about that.
    return value.dump(-1, ' ', false, Json::error_handler_t::replace);
}

constexpr std::array all_events{LogEvent::ahead,
                                LogEvent::executed,
                                LogEvent::sent,
                                LogEvent::waiting,
                                LogEvent::hold,
                                LogEvent::resume,
                                LogEvent::stop,
                                LogEvent::overrides,
                                LogEvent::single_block,
                                LogEvent::optional_stop,
                                LogEvent::own,
                                LogEvent::fault,
                                LogEvent::end};
constexpr std::array all_ends{JobEnd::done, JobEnd::stopped, JobEnd::cancelled, JobEnd::fault};

/// What is known of them.
constexpr std::string_view blocks_key(bool answers) {
    return answers ? "executed_blocks" : "sent_blocks";
}

std::vector<program::ProgramAxis> axes_from(const JsonValue& value) {
    std::vector<program::ProgramAxis> axes;
    for (const JsonValue& axis : value.items()) {
        const std::string letter = axis.at("letter").text();
        const std::string unit = axis.at("unit").text();
        if (letter.size() != 1 || (unit != "mm" && unit != "deg")) {
            axis.fail("expected one letter with mm or deg as its unit");
        }
        axes.push_back({letter.front(), unit == "deg" ? AxisKind::rotary : AxisKind::linear});
    }
    constexpr std::size_t most_axes = 9;
    if (axes.size() > most_axes) {
        value.fail("more than nine axes");
    }
    return axes;
}

LogStart start_from(const JsonValue& value) {
    value.expect_only({"record",
                       "format",
                       "version",
                       "job",
                       "project",
                       "machine",
                       "driver",
                       "program_hash",
                       "started_at",
                       "axes",
                       "blocks",
                       "planned_time_s",
                       "from_line",
                       "address",
                       "options",
                       "position_confirmed",
                       "firmware",
                       "answers"});
    if (value.at("record").text() != "start" || value.at("format").text() != log_format_name) {
        value.fail("this is not the first line of a job log");
    }
    (void)value.at("version").integer(1, log_format_version);
    LogStart start;
    start.job = value.at("job").text();
    start.project = value.at("project").text();
    start.machine = value.at("machine").text();
    start.driver = value.at("driver").text();
    start.program_hash = value.at("program_hash").text();
    start.started_at = value.at("started_at").text();
    start.axes = axes_from(value.at("axes"));
    start.blocks = value.at("blocks").integer(0);
    start.planned_time = value.at("planned_time_s").number(0.0);
    if (const auto address = value.find("address")) {
        start.address = address->text();
    }
    if (const auto options = value.find("options")) {
        start.options = options->text();
    }
    if (const auto confirmed = value.find("position_confirmed")) {
        start.position_confirmed = confirmed->text();
    }
    if (const auto firmware = value.find("firmware")) {
        start.firmware = firmware->text();
    }
    if (const auto answers = value.find("answers")) {
        start.answers = answers->flag();
    }
    if (const auto line = value.find("from_line")) {
        start.from_line = line->integer(1);
    }
    return start;
}

LogRecord record_from(const JsonValue& value, const LogStart& start) {
    value.expect_only({"record",
                       "time_s",
                       blocks_key(start.answers),
                       "line",
                       "position",
                       "end",
                       "text",
                       "allowed_blocks",
                       "position_doubt"});
    LogRecord record;
    record.event = internal::named(value.at("record"), all_events);
    record.time = value.at("time_s").number(0.0);
    record.executed_blocks = value.at(blocks_key(start.answers)).integer(0, start.blocks);
    record.line = value.at("line").integer(0);
    const std::vector<JsonValue> position = value.at("position").items(start.axes.size());
    record.position = AxisPositions::Zero(static_cast<Eigen::Index>(position.size()));
    for (std::size_t n = 0; n < position.size(); ++n) {
        const double shown = position[n].number();
        const bool rotary = start.axes[n].kind == AxisKind::rotary;
        record.position[static_cast<Eigen::Index>(n)] = rotary ? from_degrees(shown) : shown;
    }
    if (const auto end = value.find("end")) {
        record.end = internal::named(*end, all_ends);
    }
    if (const auto text = value.find("text")) {
        record.text = text->text();
    }
    if (const auto allowed = value.find("allowed_blocks")) {
        record.allowed_blocks = allowed->integer(0, start.blocks);
    }
    if (const auto doubt = value.find("position_doubt")) {
        record.position_doubt = doubt->text();
    }
    return record;
}

/// Parses one line of a file; what is wrong is reported with the line's number.
template <class Read> auto in_line(const fs::path& file, int number, std::string_view line, Read&& read) {
    try {
        return read(JsonValue::parse(line, file));
    } catch (const Error& error) {
        Diagnostic found = error.diagnostic();
        found.place.line = number;
        found.place.byte = -1;
        throw Error(std::move(found));
    }
}

} // namespace

std::string_view to_text(LogEvent event) {
    switch (event) {
    case LogEvent::ahead:
        return "ahead";
    case LogEvent::overrides:
        return "overrides";
    case LogEvent::optional_stop:
        return "optional-stop";
    case LogEvent::own:
        return "own-line";
    case LogEvent::waiting:
        return "waiting";
    case LogEvent::single_block:
        return "single-block";
    case LogEvent::executed:
        return "executed";
    case LogEvent::sent:
        return "sent";
    case LogEvent::hold:
        return "hold";
    case LogEvent::resume:
        return "resume";
    case LogEvent::stop:
        return "stop";
    case LogEvent::fault:
        return "fault";
    case LogEvent::end:
        return "end";
    }
    return "unknown";
}

JobLogError::JobLogError(std::string reason, const fs::path& file)
    : Error("cannot write the job log: " + reason, file), reason_(std::move(reason)) {}

JobLog::JobLog(const fs::path& folder, const std::string& name) {
    make_folder(folder);
    const std::string stem = file_stem(name);
    constexpr int most_logs = 9999;
    for (int number = 1; number <= most_logs && handle_ < 0; ++number) {
        file_ = folder / fmt::format("{}-{:04}.jsonl", stem, number);
        handle_ = ::open(file_.c_str(), O_WRONLY | O_CREAT | O_EXCL | O_APPEND | O_CLOEXEC, 0644);
        if (handle_ < 0 && errno != EEXIST) {
            throw JobLogError(reason(errno), file_);
        }
    }
    if (handle_ < 0) {
        throw Error(fmt::format("there are already {} job logs with this name", most_logs),
                    folder,
                    "move the old ones to another folder");
    }
    // Ends with this program, however it ends. Where a file system knows no locks, there is none.
    (void)::flock(handle_, LOCK_EX | LOCK_NB);
}

bool is_being_written(const fs::path& file) {
    const int handle = ::open(file.c_str(), O_RDONLY | O_CLOEXEC);
    if (handle < 0) {
        return false;
    }
    const bool locked = ::flock(handle, LOCK_SH | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    ::close(handle);
    return locked;
}

JobLog::~JobLog() {
    if (size_ == 0) {
        ::unlink(file_.c_str());
    } else if (room_ > size_) {
        (void)::ftruncate(handle_, size_); // gives the room back
    }
    ::close(handle_); // which also ends the lock
}

void JobLog::write(const LogStart& start) {
    axes_ = start.axes;
    answers_ = start.answers;
    Json axes = Json::array();
    for (const program::ProgramAxis& axis : start.axes) {
        axes.push_back({{"letter", std::string(1, axis.letter)},
                        {"unit", axis.kind == AxisKind::rotary ? "deg" : "mm"}});
    }
    Json line{{"record", "start"},
              {"format", log_format_name},
              {"version", log_format_version},
              {"job", start.job},
              {"project", start.project},
              {"machine", start.machine},
              {"driver", start.driver},
              {"program_hash", start.program_hash},
              {"started_at", start.started_at},
              {"axes", axes},
              {"blocks", start.blocks},
              {"planned_time_s", rounded(start.planned_time)}};
    if (!start.address.empty()) {
        line["address"] = start.address;
    }
    if (!start.options.empty()) {
        line["options"] = start.options;
    }
    if (start.from_line > 1) {
        line["from_line"] = start.from_line;
    }
    if (!start.position_confirmed.empty()) {
        line["position_confirmed"] = start.position_confirmed;
    }
    if (!start.firmware.empty()) {
        line["firmware"] = start.firmware;
    }
    if (!start.answers) {
        line["answers"] = false;
    }
    append(one_line(line), false);
}

void JobLog::write(const LogRecord& record) {
    expects(record.position.size() == std::ssize(axes_) && record.position.allFinite(),
            "a record has a finite position for each axis of the start");
    Json position = Json::array();
    for (std::size_t n = 0; n < axes_.size(); ++n) {
        const double value = record.position[static_cast<Eigen::Index>(n)];
        position.push_back(rounded(axes_[n].kind == AxisKind::rotary ? to_degrees(value) : value));
    }
    Json line{{"record", to_text(record.event)},
              {"time_s", rounded(record.time)},
              {blocks_key(answers_), record.executed_blocks},
              {"line", record.line},
              {"position", position}};
    if (record.end) {
        line["end"] = to_text(*record.end);
    }
    if (!record.text.empty()) {
        line["text"] = record.text;
    }
    if (record.event == LogEvent::ahead) {
        line["allowed_blocks"] = record.allowed_blocks;
    }
    if (!record.position_doubt.empty()) {
        line["position_doubt"] = record.position_doubt;
    }
    append(one_line(line), record.event == LogEvent::fault || record.event == LogEvent::end);
}

/// Throws JobLogError where the disk has no room for a file of `bytes`.
void JobLog::keep_room(std::int64_t bytes) {
    constexpr std::int64_t page = 4096;
    const std::int64_t wanted = (bytes + page - 1) / page * page;
    while (keeps_room_ && room_ < bytes) {
        if (::fallocate(handle_, FALLOC_FL_KEEP_SIZE, room_, wanted - room_) == 0) {
            room_ = wanted;
        } else if (errno == ENOSPC || errno == EDQUOT || errno == EFBIG || errno == EIO) {
            throw JobLogError(reason(errno), file_);
        } else if (errno != EINTR) {
            keeps_room_ = false;
        }
    }
}

/// `last`: it may take the room that was kept for it.
void JobLog::append(const std::string& line, bool last) {
    constexpr std::int64_t last_lines = 8192; // bytes
    const std::string bytes = line + "\n";
    if (!last) {
        keep_room(size_ + std::ssize(bytes) + last_lines);
    }
    std::string_view rest = bytes;
    while (!rest.empty()) {
        const ssize_t written = ::write(handle_, rest.data(), rest.size());
        if (written < 0 && errno != EINTR) {
            const int why = errno;
            if (rest.size() < bytes.size()) {
                (void)::ftruncate(handle_, size_); // where that fails, the line stays torn
                room_ = size_;
            }
            throw JobLogError(reason(why), file_);
        }
        rest.remove_prefix(static_cast<std::size_t>(std::max<ssize_t>(0, written)));
    }
    size_ += std::ssize(bytes);
}

int ReadLog::allowed_blocks() const {
    int allowed = -1;
    for (const LogRecord& record : records) {
        allowed = record.event == LogEvent::ahead ? std::max(allowed, record.allowed_blocks) : allowed;
    }
    return allowed < 0 ? start.blocks : allowed;
}

std::optional<JobEnd> ReadLog::end() const {
    return records.empty() ? std::nullopt : records.back().end;
}

ReadLog read_job_log(const fs::path& file) {
    const std::string text = read_file(file);
    std::string_view rest = text;
    ReadLog log;
    log.torn = !rest.empty() && rest.back() != '\n';
    rest = rest.substr(0, rest.rfind('\n') + 1); // everything, or nothing if there is no whole line
    if (rest.empty()) {
        throw Error("the job log has no complete line", file);
    }
    for (int number = 1; !rest.empty(); ++number) {
        const std::size_t length = rest.find('\n');
        const std::string_view line = rest.substr(0, length);
        rest.remove_prefix(length + 1);
        if (number == 1) {
            log.start = in_line(file, number, line, start_from);
            continue;
        }
        log.records.push_back(in_line(
            file, number, line, [&](const JsonValue& value) { return record_from(value, log.start); }));
    }
    return log;
}

} // namespace millwright::jobs
