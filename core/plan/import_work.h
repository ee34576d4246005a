// Bringing a surface of another program into a project, in the background: first the file is read, then what
// a person chooses of it is made, as often as the choice changes.
#pragma once

#include "core/base/error.h"
#include "core/plan/pipeline.h"
#include "core/plan/reference_mesh.h"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <optional>

namespace millwright::plan {

/// What is known of a file by now. Immutable once published.
struct ImportResult {
    std::filesystem::path file;
    std::shared_ptr<const project::ImportSource> source;      ///< null where the file could not be read
    project::ImportChoice choice;                             ///< that `surface` was made by
    std::shared_ptr<const project::ImportedSurface> surface;  ///< null: nothing is chosen yet, or it failed
    std::shared_ptr<const geometry::Surface> patches;         ///< of `surface`, with it
    std::shared_ptr<const std::vector<geometry::Trim>> trims; ///< the same
    std::shared_ptr<const ReferenceMesh> reference;           ///< null where the file could not be read
    std::optional<Diagnostic> failure;
    std::uint64_t revision = 0; ///< grows with every publication
};

/// Whether something of the file is chosen: a mesh always is, and points, a face only by its number or if it
/// is alone.
[[nodiscard]] bool is_chosen(const project::ImportSource& source, const project::ImportChoice& choice);

/// One file at a time, on a thread of its own. Called from the owner's thread; every member but wait_idle
/// returns at once.
class ImportWorker {
public:
    /// `wake` is called from the worker whenever something new can be looked at.
    explicit ImportWorker(std::function<void()> wake);
    ImportWorker(const ImportWorker&) = delete;
    ImportWorker& operator=(const ImportWorker&) = delete;
    ~ImportWorker();

    /// Reads the file and makes what `choice` says of it. What was known of another file is forgotten.
    void open(const std::filesystem::path& file, const project::ImportChoice& choice);
    /// Makes something else of the file that was read last. Throws Defect where none was.
    void make(const project::ImportChoice& choice);
    /// Stops what runs and forgets the file.
    void close();

    /// Null while the file is read.
    [[nodiscard]] std::shared_ptr<const ImportResult> latest() const;
    [[nodiscard]] Activity activity() const;
    void wait_idle() const;

private:
    class Worker;
    std::unique_ptr<Worker> worker_;
};

} // namespace millwright::plan
