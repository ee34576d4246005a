#include "ui/workspaces/pending_import.h"

namespace millwright::actions {

void PendingImport::open(const std::filesystem::path& file) {
    file_ = file;
    choice_ = {};
    worker_.open(file_, choice_);
}

void PendingImport::choose(const project::ImportChoice& choice) {
    const auto now = latest();
    if (!now || !now->source || choice == choice_) {
        return;
    }
    choice_ = choice;
    worker_.make(choice_);
}

void PendingImport::close() {
    worker_.close();
    file_.clear();
}

project::SurfaceInput PendingImport::take(const project::SurfaceInput& before) {
    expects(is_ready(), "there is a surface to be taken");
    const auto now = latest();
    taken_ = std::make_unique<const Taken>(Taken{now->reference, now->surface->surface, before});
    close();
    return taken_->surface;
}

std::shared_ptr<const plan::ImportResult> PendingImport::latest() const {
    return is_open() ? worker_.latest() : nullptr;
}

bool PendingImport::is_ready() const {
    const auto now = latest();
    return now && now->surface && now->choice == choice_;
}

std::shared_ptr<const plan::ReferenceMesh>
PendingImport::reference(const project::SurfaceInput& design) const {
    if (is_open()) {
        const auto now = latest();
        return now ? now->reference : nullptr;
    }
    return taken_ && !(design == taken_->before) ? taken_->reference : nullptr;
}

bool PendingImport::is_measured(const project::SurfaceInput& design) const {
    return is_open() || (taken_ && design.patches == taken_->surface.patches &&
                         design.face == taken_->surface.face && design.joined == taken_->surface.joined);
}

} // namespace millwright::actions
