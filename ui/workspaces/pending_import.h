// A surface of another program before it is taken: it is read and looked at before it becomes the project's,
// and what it was fitted to stays beside it afterwards.
#pragma once

#include "core/plan/import_work.h"

#include <filesystem>
#include <functional>
#include <memory>

namespace millwright::actions {

class PendingImport {
public:
    explicit PendingImport(std::function<void()> wake) : worker_(std::move(wake)) {}

    /// Begins to read `file`; a file that is pending is given up.
    void open(const std::filesystem::path& file);
    /// Makes something else of the file once it is read.
    void choose(const project::ImportChoice& choice);
    /// Gives the file up.
    void close();
    /// The surface for the project, which is `before` it; its reference stays. Nothing is pending then.
    /// Throws Defect unless there is one by the choice that is made now.
    [[nodiscard]] project::SurfaceInput take(const project::SurfaceInput& before);
    void drop_reference() { taken_.reset(); }

    /// A file is pending.
    [[nodiscard]] bool is_open() const { return !file_.empty(); }
    [[nodiscard]] const std::filesystem::path& file() const { return file_; }
    [[nodiscard]] const project::ImportChoice& choice() const { return choice_; }
    /// Of the pending file; null while it is read for the first time.
    [[nodiscard]] std::shared_ptr<const plan::ImportResult> latest() const;
    /// What can be taken now is there.
    [[nodiscard]] bool is_ready() const;
    /// What stands beside the design: of the pending file, else of what was taken last, unless that was
    /// undone. Null where there is nothing.
    [[nodiscard]] std::shared_ptr<const plan::ReferenceMesh>
    reference(const project::SurfaceInput& design) const;
    /// Whether the deviations of the reference are those of `design`.
    [[nodiscard]] bool is_measured(const project::SurfaceInput& design) const;
    [[nodiscard]] plan::Activity activity() const { return worker_.activity(); }
    void wait_idle() const { worker_.wait_idle(); }

private:
    /// What was taken into the project, and what it took the place of.
    struct Taken {
        std::shared_ptr<const plan::ReferenceMesh> reference;
        project::SurfaceInput surface, before;
    };

    std::filesystem::path file_; ///< empty: none
    project::ImportChoice choice_;
    std::unique_ptr<const Taken> taken_; ///< null: nothing
    plan::ImportWorker worker_;
};

} // namespace millwright::actions
