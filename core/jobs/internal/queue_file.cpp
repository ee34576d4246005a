#include "core/jobs/internal/queue_file.h"

#include "core/base/error.h"
#include "core/base/json.h"
#include "core/jobs/internal/named.h"

#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <sys/file.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <set>
#include <system_error>

namespace millwright::jobs::internal {

FileLock::FileLock(const std::filesystem::path& file) {
    std::filesystem::path lock = file;
    lock += ".lock";
    handle_ = ::open(lock.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0644);
    if (handle_ < 0) {
        throw Error("cannot be locked: " + std::error_code(errno, std::generic_category()).message(), lock);
    }
    if (::flock(handle_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
        ::close(handle_);
        throw Error(
            "is in use by another instance of Millwright", file, "wait until it has finished, or close it");
    }
}

FileLock::~FileLock() {
    ::close(handle_);
}

namespace {

using Json = nlohmann::ordered_json;

constexpr std::string_view format_name = "millwright-job-queue";
constexpr int format_version = 1;
constexpr std::array all_states{QueueState::waiting, QueueState::running, QueueState::done, QueueState::held};
constexpr std::array all_ends{JobEnd::done, JobEnd::stopped, JobEnd::cancelled, JobEnd::fault};

QueuedJob job_from(const JsonValue& value) {
    value.expect_only(
        {"id", "job", "project", "program_hash", "blocks", "from_line", "state", "end", "text", "log"});
    QueuedJob job;
    job.id = QueuedJobId{value.at("id").integer(1)};
    job.name = value.at("job").text();
    job.project = value.at("project").text();
    job.hash = value.at("program_hash").text();
    job.blocks = value.at("blocks").integer(0);
    job.from_line = value.at("from_line").integer(1);
    job.state = named(value.at("state"), all_states);
    if (const auto end = value.find("end")) {
        job.end = named(*end, all_ends);
    }
    if (const auto text = value.find("text")) {
        job.sentence = text->text();
    }
    if (const auto log = value.find("log")) {
        job.log_file = log->text();
    }
    job.has_program = false;
    return job;
}

Json json_of(const QueuedJob& job) {
    Json value{{"id", static_cast<int>(job.id)},
               {"job", job.name},
               {"project", job.project},
               {"program_hash", job.hash},
               {"blocks", job.blocks},
               {"from_line", job.from_line},
               {"state", to_text(job.state)}};
    if (job.end) {
        value["end"] = to_text(*job.end);
    }
    if (!job.sentence.empty()) {
        value["text"] = job.sentence;
    }
    if (!job.log_file.empty()) {
        value["log"] = job.log_file.string();
    }
    return value;
}

/// A job that was running when the program ended: only its log knows how far it came.
void hold_interrupted(QueuedJob& job) {
    if (job.state == QueueState::running) {
        job.state = QueueState::held;
        job.sentence =
            "Millwright ended while the job was running: its log shows what was confirmed as executed.";
    }
}

} // namespace

std::string queue_text(const std::vector<QueuedJob>& jobs) {
    Json all = Json::array();
    for (const QueuedJob& job : jobs) {
        all.push_back(json_of(job));
    }
    const Json whole{{"format", format_name}, {"version", format_version}, {"jobs", all}};
    return whole.dump(2, ' ', false, Json::error_handler_t::replace) + "\n";
}

std::vector<QueuedJob> read_queue(const std::filesystem::path& file) {
    const JsonValue whole = JsonValue::read(file);
    whole.expect_only({"format", "version", "jobs"});
    if (whole.at("format").text() != format_name) {
        whole.at("format").fail("this is not a job queue");
    }
    (void)whole.at("version").integer(1, format_version);
    std::vector<QueuedJob> jobs;
    std::set<QueuedJobId> ids;
    for (const JsonValue& value : whole.at("jobs").items()) {
        jobs.push_back(job_from(value));
        if (!ids.insert(jobs.back().id).second) {
            value.at("id").fail("this id occurs twice");
        }
        hold_interrupted(jobs.back());
    }
    return jobs;
}

} // namespace millwright::jobs::internal
