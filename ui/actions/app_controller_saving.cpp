// The part of AppController that writes files of a person's own, and never over what another program has put
// there meanwhile: saving the project, writing its program, leaving what is unsaved.
#include "core/base/error.h"
#include "core/base/files.h"
#include "core/jobs/job.h"
#include "core/project/project_file.h"
#include "ui/actions/app_controller.h"

#include <sys/stat.h>

#include <system_error>
#include <utility>

namespace millwright::actions {

namespace {

namespace fs = std::filesystem;

fs::path whole_path(const fs::path& file) {
    return fs::absolute(file).lexically_normal();
}

bool is_same_file(const fs::path& a, const fs::path& b) {
    std::error_code missing;
    return a == b || fs::equivalent(a, b, missing);
}

/// Whether another program has written there since `known` did. What is gone can be written again.
bool is_foreign(const KnownFile& known) {
    std::error_code missing;
    if (!fs::is_regular_file(known.file, missing)) {
        return false;
    }
    try {
        return jobs::program_hash(read_file(known.file)) != known.hash;
    } catch (const Error&) {
        return true;
    }
}

} // namespace

void AppController::save(const fs::path& file) {
    const fs::path whole = whole_path(file);
    if (is_same_file(whole, document().file) && is_foreign({whole, document().hash})) {
        view_state_.file_prompt = FilePrompt::none;
        view_state_.replacing = Replacing{ReplacedFile::project, whole};
        return;
    }
    put_project(whole);
}

void AppController::put_project(const fs::path& whole) {
    const auto leaving = std::exchange(leaving_, std::nullopt); // a failure ends the leaving, too
    const std::string text = project::write_project(history_.current(), whole);
    Document& now = document();
    now.file = whole;
    now.saved = history_.current();
    now.hash = jobs::program_hash(text);
    view_state_.file_prompt = FilePrompt::none;
    tell(view_state_, widgets::Severity::good, "Saved.", whole.string());
    remember(whole);
    if (leaving) {
        leaving->then(*this);
    }
}

void AppController::write_program() {
    view_state_.dialogs.gouges = !look().gouge_warning().empty();
    if (!view_state_.dialogs.gouges) {
        write_gouging_program();
    }
}

void AppController::write_gouging_program() {
    view_state_.dialogs.gouges = false;
    const auto& last = document().program;
    if (!last) {
        view_state_.file_prompt = FilePrompt::write_program;
    } else if (is_foreign(*last)) {
        view_state_.replacing = Replacing{ReplacedFile::program, last->file};
    } else {
        write_program(fs::path(last->file));
    }
}

void AppController::write_program(const fs::path& file) {
    const FrameState now = look();
    const auto listing = now.listing();
    if (!listing) {
        throw Error("there is no program yet");
    }
    if (!now.program_is_final()) { // the project has changed since the file was asked for
        throw Error("the program is still being computed", {}, "write it again when it is there");
    }
    const fs::path whole = whole_path(file);
    write_file(whole, listing->text);
    document().program = KnownFile{whole, jobs::program_hash(listing->text)};
    view_state_.file_prompt = FilePrompt::none;
    tell(view_state_, widgets::Severity::good, "G-code written.", whole.string());
}

void AppController::replace() {
    const auto asked = std::exchange(view_state_.replacing, std::nullopt);
    expects(asked.has_value(), "it is asked whether a file is replaced");
    if (asked->what == ReplacedFile::project) {
        put_project(asked->file);
    } else {
        write_program(asked->file);
    }
}

void AppController::reload() {
    view_state_.replacing.reset();
    leaving_.reset();
    open(fs::path(document().file));
}

void AppController::write_elsewhere() {
    const auto asked = std::exchange(view_state_.replacing, std::nullopt);
    expects(asked.has_value(), "it is asked whether a file is replaced");
    view_state_.file_prompt =
        asked->what == ReplacedFile::project ? FilePrompt::save_as : FilePrompt::write_program;
}

void AppController::keep_file() {
    view_state_.replacing.reset();
    leaving_.reset();
}

void AppController::leave(std::string to, ActionQueue::Request then) {
    if (changed()) {
        view_state_.file_prompt = FilePrompt::none; // what it led to is asked about now
        leaving_ = Leaving{std::move(to), std::move(then)};
    } else {
        then(*this);
    }
}

void AppController::save_and_leave() {
    if (document().file.empty()) {
        view_state_.file_prompt = FilePrompt::save_as;
    } else {
        save(fs::path(document().file));
    }
}

void AppController::discard_and_leave() {
    if (const auto leaving = std::exchange(leaving_, std::nullopt)) {
        leaving->then(*this);
    }
}

void AppController::stay() {
    leaving_.reset();
}

Document AppController::document_of(const project::UnsavedWork& work) {
    Document made{.file = work.file, .saved = {}, .hash = {}, .program = {}};
    try {
        const std::string text = work.file.empty() ? std::string() : read_file(work.file);
        made.saved = work.file.empty() ? project::Project{} : project::project_from_text(text, work.file);
        struct stat now {};
        if (::stat(work.file.c_str(), &now) == 0 && now.st_mtime <= work.time_s) {
            made.hash = jobs::program_hash(text);
        }
    } catch (const Error&) {
        made.saved = {};
    }
    return made;
}

} // namespace millwright::actions
