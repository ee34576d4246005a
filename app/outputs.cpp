#include "app/outputs.h"

#include "core/base/error.h"
#include "core/base/files.h"

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
    if (fs::is_directory(place)) {
        throw Error("cannot write: Is a directory", place);
    }
    std::error_code failure;
    if (!source.empty() && fs::equivalent(place, source, failure)) {
        throw Error("would be written over, and is read", place, "choose another folder");
    }
}

} // namespace

OutputFolder::OutputFolder(const fs::path& folder) {
    for (fs::path place = fs::absolute(folder).lexically_normal(); !fs::exists(place);
         place = place.parent_path()) {
        if (place.has_filename()) { // not for the slash at the end
            made_.push_back(place);
        }
    }
    make_folder(folder);
}

OutputFolder::~OutputFolder() {
    for (const fs::path& place : made_) {
        std::error_code not_empty;
        fs::remove(place, not_empty);
    }
}

void write_outputs(const fs::path& folder, const std::vector<OutputFile>& files, const fs::path& source) {
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
