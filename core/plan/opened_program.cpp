#include "core/plan/opened_program.h"

#include "core/base/published.h"
#include "core/plan/internal/background.h"
#include "core/plan/internal/program_reading.h"

#include <fstream>
#include <system_error>
#include <utility>

namespace millwright::plan {

namespace {

namespace fs = std::filesystem;

/// Throws Error with the system's reason.
void expect_readable(const fs::path& file) {
    std::error_code failure;
    if (fs::is_directory(file, failure)) {
        throw Error("is a folder", file);
    }
    const std::ifstream stream(file, std::ios::binary);
    if (!stream) {
        throw Error(fs::exists(file, failure) ? "cannot be read" : "there is no such file", file);
    }
}

} // namespace

ProgramText::ProgramText(FileSnapshot bytes, const Progress& progress)
    : bytes_(std::move(bytes)), lines_(bytes_.text(), progress) {}

ProgramText::ProgramText(std::shared_ptr<const program::Listing> listing, const Progress& progress)
    : listing_(std::move(listing)), lines_(listing_->text, progress) {}

std::map<int, const Diagnostic*> OpenedProgram::errors_by_line() const {
    std::map<int, const Diagnostic*> found;
    for (const auto* list : {&errors, &faults}) {
        for (const Diagnostic& error : *list) {
            if (error.place.line > 0 && error.place.file == file) {
                found.emplace(error.place.line, &error);
            }
        }
    }
    return found;
}

class ProgramReader::Worker {
public:
    explicit Worker(std::function<void()> wake) : wake_(std::move(wake)), background_(wake_) {}

    void open(OpenedProgram start, fs::path assets) {
        publish(start);
        background_.replace([this, start = std::move(start), assets = std::move(assets)](
                                const Progress& progress) mutable { read(start, assets, progress); });
    }
    void cancel() { background_.clear(); }
    void close() {
        background_.clear();
        background_.wait_idle();
        published_.clear();
    }

    [[nodiscard]] std::shared_ptr<const OpenedProgram> latest() const { return published_.latest(); }
    [[nodiscard]] Activity activity() const { return background_.activity(); }
    void wait_idle() const { background_.wait_idle(); }

private:
    void publish(const OpenedProgram& now) {
        published_.publish(now);
        wake_();
    }

    void read(OpenedProgram& now, const fs::path& assets, const Progress& progress) {
        try {
            load_text(now, progress.part(0.0, 0.1));
            ProgramReading(now, now.file.parent_path(), assets, [&] {
                publish(now);
            }).read(progress.part(0.1, 1.0));
        } catch (const Cancelled&) {
            now.cancelled = true;
        } catch (const Error& error) {
            now.errors.push_back(error.diagnostic());
        }
        now.finished = true;
        publish(now);
    }

    static void load_text(OpenedProgram& now, const Progress& progress) {
        progress.report(0.0, "Opening " + now.file.filename().string());
        FileSnapshot bytes(now.file, progress.part(0.0, 0.7));
        now.text = std::make_shared<const ProgramText>(std::move(bytes), progress.part(0.7, 1.0));
    }

    std::function<void()> wake_;
    Published<OpenedProgram> published_;
    Background background_; // last: its thread uses what stands before it
};

ProgramReader::ProgramReader(std::function<void()> wake)
    : worker_(std::make_unique<Worker>(std::move(wake))) {}

ProgramReader::~ProgramReader() = default;

void ProgramReader::open(const fs::path& file, ReadingChoice choice, fs::path assets) {
    expect_readable(file);
    OpenedProgram start;
    start.file = fs::absolute(file).lexically_normal();
    start.choice = std::move(choice);
    worker_->close();
    worker_->open(std::move(start), std::move(assets));
}

void ProgramReader::cancel() {
    worker_->cancel();
}

void ProgramReader::close() {
    worker_->close();
}

std::shared_ptr<const OpenedProgram> ProgramReader::latest() const {
    return worker_->latest();
}

Activity ProgramReader::activity() const {
    return worker_->activity();
}

void ProgramReader::wait_idle() const {
    worker_->wait_idle();
}

} // namespace millwright::plan
