#include "core/plan/import_work.h"

#include "core/base/published.h"
#include "core/plan/internal/background.h"
#include "core/plan/internal/failure.h"
#include "core/project/part_trims.h"
#include "core/project/surface.h"

#include <fmt/format.h>

#include <utility>

namespace millwright::plan {

namespace {

std::string file_name(const std::filesystem::path& file) {
    return file.filename().string();
}

} // namespace

class ImportWorker::Worker {
public:
    explicit Worker(std::function<void()> wake) : wake_(std::move(wake)), background_(wake_) {}

    void open(const std::filesystem::path& file, const project::ImportChoice& choice) {
        close();
        background_.replace([=, this](const Progress& progress) {
            ImportResult found;
            found.file = file;
            found.choice = choice;
            found.failure = failure_of([&] {
                progress.report(0.0, fmt::format("Reading {}", file_name(file)));
                found.source = std::make_shared<const project::ImportSource>(
                    project::read_source(file, progress.part(0.0, 0.5)));
                make(found, progress.part(0.5, 1.0));
            });
            publish(std::move(found), progress);
        });
    }

    void make(const project::ImportChoice& choice) {
        const auto last = latest();
        expects(last && last->source, "a file was read");
        background_.replace([=, this](const Progress& progress) {
            ImportResult found;
            found.file = last->file;
            found.source = last->source;
            found.choice = choice;
            found.failure = failure_of([&] { make(found, progress); });
            publish(std::move(found), progress);
        });
    }

    void close() {
        background_.clear(); // first: what runs publishes nothing any more
        published_.clear();
    }

    [[nodiscard]] std::shared_ptr<const ImportResult> latest() const { return published_.latest(); }
    [[nodiscard]] Activity activity() const { return background_.activity(); }
    void wait_idle() const { background_.wait_idle(); }

private:
    /// Where the choice cannot be made the file is looked at all the same.
    static void make(ImportResult& found, const Progress& progress) {
        progress.report(0.0, fmt::format("Importing {}", file_name(found.file)));
        const auto look = [&] {
            found.reference = std::make_shared<const ReferenceMesh>(
                reference_mesh(*found.source, found.choice, found.surface.get(), progress));
        };
        try {
            if (is_chosen(*found.source, found.choice)) {
                found.surface = std::make_shared<const project::ImportedSurface>(
                    project::import_of(*found.source, found.choice, progress.part(0.0, 0.9)));
                const project::SurfaceInput& surface = found.surface->surface;
                found.patches = std::make_shared<const geometry::Surface>(project::surface_of(surface));
                found.trims =
                    std::make_shared<const std::vector<geometry::Trim>>(project::part_trims(surface));
            }
        } catch (const Error&) {
            look();
            throw;
        }
        look();
    }

    void publish(ImportResult found, const Progress& progress) {
        published_.publish(std::move(found), progress); // if it was not closed in the meantime
        wake_();
    }

    std::function<void()> wake_;
    Published<ImportResult> published_;
    Background background_; // last: its thread ends before the rest goes
};

bool is_chosen(const project::ImportSource& source, const project::ImportChoice& choice) {
    return source.mesh || source.points || choice.face > 0 || !choice.joined.empty() ||
           (source.model && source.model->faces.size() == 1);
}

ImportWorker::ImportWorker(std::function<void()> wake) : worker_(std::make_unique<Worker>(std::move(wake))) {}

ImportWorker::~ImportWorker() = default;

void ImportWorker::open(const std::filesystem::path& file, const project::ImportChoice& choice) {
    worker_->open(file, choice);
}

void ImportWorker::make(const project::ImportChoice& choice) {
    worker_->make(choice);
}

void ImportWorker::close() {
    worker_->close();
}

std::shared_ptr<const ImportResult> ImportWorker::latest() const {
    return worker_->latest();
}

Activity ImportWorker::activity() const {
    return worker_->activity();
}

void ImportWorker::wait_idle() const {
    worker_->wait_idle();
}

} // namespace millwright::plan
