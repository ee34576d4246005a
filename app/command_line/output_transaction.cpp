#include "app/command_line/output_transaction.h"

#include "app/command_line/kept_outputs.h"
#include "core/base/draft.h"
#include "core/base/error.h"
#include "core/base/files.h"

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <memory>
#include <set>
#include <system_error>
#include <thread>
#include <utility>

namespace millwright::app {

namespace fs = std::filesystem;

namespace {

/// One program at a time in a folder; the system ends the lock however the program ends.
class OutputLock {
public:
    explicit OutputLock(const fs::path& folder) : handle_(::open(folder.c_str(), O_RDONLY | O_CLOEXEC)) {
        constexpr auto glance = std::chrono::milliseconds(20);
        constexpr auto patience = std::chrono::seconds(10);
        const auto end = std::chrono::steady_clock::now() + patience;
        // Where a file system knows no locks, there is none.
        while (handle_ >= 0 && ::flock(handle_, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK) {
            if (std::chrono::steady_clock::now() > end) {
                ::close(handle_);
                throw Error("another program is writing to this folder", folder);
            }
            std::this_thread::sleep_for(glance);
        }
    }
    OutputLock(const OutputLock&) = delete;
    OutputLock& operator=(const OutputLock&) = delete;
    ~OutputLock() {
        if (handle_ >= 0) {
            ::close(handle_);
        }
    }

private:
    int handle_;
};

void expect_replaceable(const fs::path& place, const fs::path& source) {
    std::error_code failure;
    if (fs::is_directory(place, failure)) {
        throw Error("cannot write: Is a directory", place);
    }
    if (!source.empty() && fs::equivalent(place, source, failure)) {
        throw Error("would be overwritten, but is an input file", place, "choose another folder");
    }
}

/// Of files that are to stay when others take their place; taken back unless stay() is called.
class SecondNames {
public:
    SecondNames() = default;
    SecondNames(const SecondNames&) = delete;
    SecondNames& operator=(const SecondNames&) = delete;
    ~SecondNames() {
        for (const auto& [file, name, was_written] : names_) {
            std::error_code ignored;
            fs::remove(name, ignored);
        }
    }

    void add(const fs::path& file, bool was_written) {
        const fs::path name = kept_name(file);
        if (!named_twice(file, name)) {
            throw Error("cannot be kept as " + name.filename().string(), file, "choose another folder");
        }
        names_.push_back({file, name, was_written});
    }
    void stay() {
        for (const auto& [file, name, was_written] : names_) {
            say_kept(file, name, was_written);
        }
        names_.clear();
    }

private:
    struct Named {
        fs::path file, name;
        bool was_written = false; ///< a command has written it once
    };
    std::vector<Named> names_;
};

/// Files in `folder` of older sets of the same kind, but for those with which a file of `set` was written as
/// it is.
std::vector<fs::path> unfitting_of_kind(const fs::path& folder,
                                        const OutputSet& set,
                                        const std::vector<fs::path>& places,
                                        const WrittenFiles& written) {
    std::vector<fs::path> found = written.of_kind(set.kind, folder);
    std::set<fs::path> fitting;
    for (std::size_t n = 0; n < places.size(); ++n) {
        if (written.had_bytes(places[n], set.files[n].bytes)) {
            const std::vector<fs::path> with = written.written_with(places[n]);
            fitting.insert(with.begin(), with.end());
        }
    }
    std::erase_if(found, [&](const fs::path& file) { return fitting.contains(file); });
    return found;
}

/// Files of other sets that would no longer fit what is in the folder once `set` is written there, and those
/// that are to be absent.
std::set<fs::path> unfitting(const fs::path& folder,
                             const OutputSet& set,
                             const std::vector<fs::path>& places,
                             const WrittenFiles& written) {
    std::set<fs::path> found;
    const auto add_rest = [&](const fs::path& place) {
        for (fs::path& other : written.written_with(place)) {
            found.insert(std::move(other));
        }
    };
    for (std::size_t n = 0; n < places.size(); ++n) {
        if (written.had_other_bytes(places[n], set.files[n].bytes)) {
            add_rest(places[n]);
        }
    }
    for (fs::path& other : unfitting_of_kind(folder, set, places, written)) {
        found.insert(std::move(other));
    }
    for (const std::string& name : set.absent) {
        std::error_code missing;
        if (fs::is_regular_file(folder / name, missing)) {
            add_rest(folder / name);
            found.insert(lasting_path(folder / name));
        }
    }
    for (const fs::path& place : places) {
        found.erase(lasting_path(place));
    }
    return found;
}

/// One that no command has written as it is gets another name.
void take_away(const fs::path& file, const WrittenFiles& written) {
    std::error_code failure;
    if (!fs::is_regular_file(file, failure)) {
        return;
    }
    if (written.holds(file)) {
        if (fs::remove(file, failure)) {
            say_taken_away(file);
        }
        return;
    }
    const fs::path name = kept_name(file);
    fs::rename(file, name, failure);
    if (!failure) {
        say_kept(file, name, written.knows(file));
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

bool has_bytes(const fs::path& file, const std::string& bytes) {
    std::error_code missing;
    try {
        return fs::is_regular_file(file, missing) && read_file(file) == bytes;
    } catch (const Error&) {
        return false;
    }
}

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

void expect_inputs_kept(const fs::path& typed,
                        const std::vector<std::string>& names,
                        std::string_view kind,
                        const std::vector<fs::path>& inputs) {
    const fs::path folder = without_ups(typed);
    const WrittenFiles written;
    std::vector<fs::path> removed = written.of_kind(kind, folder);
    for (const std::string& name : names) {
        for (const fs::path& input : inputs) {
            expect_replaceable(folder / name, input);
        }
        for (fs::path& other : written.written_with(folder / name)) {
            removed.push_back(std::move(other));
        }
    }
    for (const fs::path& input : inputs) {
        const auto is_input = [&](const fs::path& file) {
            std::error_code missing;
            return fs::equivalent(file, input, missing);
        };
        if (std::ranges::any_of(removed, is_input)) {
            throw Error("would be removed, but is an input file", input, "choose another folder");
        }
    }
}

void write_outputs(const fs::path& typed, const OutputSet& set, const fs::path& source) {
    const fs::path folder = without_ups(typed);
    make_folder(folder);
    const OutputLock lock(folder);
    std::vector<std::unique_ptr<Draft>> drafts;
    std::vector<fs::path> places;
    for (const OutputFile& file : set.files) {
        expect_replaceable(folder / file.name, source);
        drafts.push_back(std::make_unique<Draft>(folder / file.name));
        drafts.back()->write(file.bytes);
        places.push_back(drafts.back()->target());
    }
    WrittenFiles written;
    std::set<fs::path> others = unfitting(folder, set, places, written);
    std::erase_if(others, [&](const fs::path& other) {
        std::error_code missing;
        return !source.empty() && fs::equivalent(other, source, missing);
    });
    SecondNames kept; // before any file loses its own: we may be killed at any time
    for (std::size_t n = 0; n < places.size(); ++n) {
        std::error_code missing;
        if (fs::exists(places[n], missing) && !written.holds(places[n]) &&
            !has_bytes(places[n], set.files[n].bytes)) {
            kept.add(places[n], written.knows(places[n]));
        }
    }
    try {
        for (const auto& draft : drafts) {
            draft->exchange();
        }
    } catch (const Error&) {
        for (const auto& draft : drafts) {
            draft->put_back();
        }
        throw;
    }
    kept.stay();
    for (const fs::path& other : others) {
        take_away(other, written);
    }
    written.add_set(places, set.kind);
}

} // namespace millwright::app
