#include "app/outputs.h"

#include "core/base/error.h"
#include "core/base/files.h"

#include <unistd.h>

#include <algorithm>
#include <system_error>

namespace millwright::app {

namespace fs = std::filesystem;

namespace {

fs::path beside(const fs::path& folder, const OutputFile& file) {
    return folder / ("." + file.name + ".new");
}

void remove_drafts(const fs::path& folder, const std::vector<OutputFile>& files) {
    for (const OutputFile& file : files) {
        std::error_code ignored;
        fs::remove(beside(folder, file), ignored);
    }
}

void expect_replaceable(const fs::path& place, const fs::path& source) {
    std::error_code failure;
    if (fs::is_directory(place, failure)) {
        throw Error("cannot write: Is a directory", place);
    }
    if (!source.empty() && fs::equivalent(place, source, failure)) {
        throw Error("would be written over, and is read", place, "choose another folder");
    }
}

/// As typed, but without "..": a link before it is followed, and what is missing before it is not made.
fs::path without_ups(const fs::path& folder) {
    if (std::ranges::find(folder, "..") == folder.end()) {
        return folder;
    }
    std::error_code failure;
    const fs::path place = fs::weakly_canonical(folder, failure);
    return failure ? folder : place;
}

} // namespace

OutputFolder::OutputFolder(const fs::path& folder) {
    const fs::path wanted = without_ups(folder);
    std::error_code unknown; // where a folder may not be entered: making it says so
    for (fs::path place = fs::absolute(wanted, unknown).lexically_normal();
         !place.empty() && !fs::exists(place, unknown);
         place = place.parent_path()) {
        if (place.has_filename() && !unknown) { // not for the slash at the end
            made_.push_back(place);
        }
    }
    try {
        make_folder(wanted);
    } catch (const Error&) {
        remove_empty();
        throw;
    }
}

OutputFolder::~OutputFolder() {
    remove_empty();
}

void OutputFolder::remove_empty() const {
    for (const fs::path& place : made_) {
        ::rmdir(place.c_str()); // nothing but an empty folder, whatever bears its name by now
    }
}

void write_outputs(const fs::path& typed, const std::vector<OutputFile>& files, const fs::path& source) {
    const fs::path folder = without_ups(typed);
    make_folder(folder);
    try {
        for (const OutputFile& file : files) {
            expect_replaceable(folder / file.name, source);
            write_file(beside(folder, file), file.bytes);
        }
    } catch (const Error&) {
        remove_drafts(folder, files);
        throw;
    }
    for (const OutputFile& file : files) {
        std::error_code failure;
        fs::rename(beside(folder, file), folder / file.name, failure);
        if (failure) {
            remove_drafts(folder, files);
            throw Error("cannot write: " + failure.message(), folder / file.name);
        }
    }
}

} // namespace millwright::app
