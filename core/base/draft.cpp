#include "core/base/draft.h"

#include "core/base/error.h"
#include "core/base/internal/write_all.h"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/random.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <cerrno>
#include <cstdio>
#include <deque>
#include <mutex>
#include <set>
#include <string>
#include <system_error>
#include <utility>

namespace millwright {

namespace fs = std::filesystem;

namespace {

constexpr std::string_view draft_begin = ".millwright-";
constexpr std::string_view draft_end = ".draft";
constexpr std::size_t random_letters = 16;

[[noreturn]] void fail_to_write(const fs::path& file, int error_number) {
    throw Error("cannot write: " + std::error_code(error_number, std::generic_category()).message(), file);
}

/// Short, so that any name that a file may have has room for its draft.
fs::path random_name(const fs::path& folder) {
    constexpr std::string_view letters = "abcdefghijklmnopqrstuvwxyz234567"; // 5 bits each
    std::array<unsigned char, random_letters> random{};
    if (::getrandom(random.data(), random.size(), 0) != static_cast<ssize_t>(random.size())) {
        fail_to_write(folder, errno);
    }
    std::string name(draft_begin);
    for (const unsigned char byte : random) {
        name += letters[byte % letters.size()];
    }
    return folder / name.append(draft_end);
}

bool is_draft_name(const std::string& name) {
    return name.size() == draft_begin.size() + random_letters + draft_end.size() &&
           name.starts_with(draft_begin) && name.ends_with(draft_end);
}

/// Of our user, and of no program that still runs.
void remove_if_abandoned(const fs::path& draft) {
    const int handle = ::open(draft.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (handle < 0) {
        return;
    }
    struct stat found {};
    if (::fstat(handle, &found) == 0 && S_ISREG(found.st_mode) && found.st_uid == ::geteuid() &&
        ::flock(handle, LOCK_EX | LOCK_NB) == 0) {
        ::unlink(draft.c_str());
    }
    ::close(handle);
}

/// Once for each folder: a program that runs removes its own.
void remove_abandoned(const fs::path& folder) {
    static std::mutex mutex;
    static std::set<fs::path> seen;
    {
        const std::scoped_lock lock(mutex);
        if (!seen.insert(folder).second) {
            return;
        }
    }
    std::error_code failure;
    for (fs::directory_iterator entry(folder, failure), end; !failure && entry != end;
         entry.increment(failure)) {
        if (is_draft_name(entry->path().filename().string())) {
            remove_if_abandoned(entry->path());
        }
    }
}

/// Whether somebody may have put the link there who is neither the user, nor root, nor the folder's owner.
bool is_planted(const fs::path& link) {
    struct stat of_link {};
    struct stat of_folder {};
    if (::lstat(link.c_str(), &of_link) != 0 || ::stat(link.parent_path().c_str(), &of_folder) != 0) {
        return false;
    }
    constexpr mode_t others_write = S_IWGRP | S_IWOTH;
    return (of_folder.st_mode & others_write) != 0 && of_link.st_uid != 0 && of_link.st_uid != ::geteuid() &&
           of_link.st_uid != of_folder.st_uid;
}

/// Throws Error for such a link on the way to `target`, at its end, or behind another link.
void refuse_planted_links(const fs::path& target) {
    constexpr int most_links = 40; // as the kernel
    const fs::path whole = fs::absolute(target);
    std::deque<fs::path> rest(whole.begin(), whole.end());
    fs::path at;
    std::error_code none;
    for (int links = 0; !rest.empty() && links <= most_links;) {
        const fs::path part = std::exchange(rest.front(), {});
        rest.pop_front();
        if (part.empty() || part == ".") {
            continue;
        }
        if (part == "..") {
            at = at.parent_path();
            continue;
        }
        const fs::path next = part.is_absolute() ? part : at / part;
        if (!fs::is_symlink(fs::symlink_status(next, none))) {
            at = next;
            continue;
        }
        if (is_planted(next)) {
            throw Error("cannot write: " + next.string() +
                            " is a link of another user in a folder that others can write to",
                        target);
        }
        const fs::path to = fs::read_symlink(next, none);
        rest.insert(rest.begin(), to.begin(), to.end());
        ++links;
    }
}

/// Behind the link, if it is one.
fs::path resolved(const fs::path& target) {
    refuse_planted_links(target);
    std::error_code failure;
    if (!fs::is_symlink(fs::symlink_status(target, failure))) {
        return target;
    }
    fs::path real = fs::weakly_canonical(target, failure);
    if (failure) {
        fail_to_write(target, failure.value());
    }
    return real;
}

} // namespace

Draft::Draft(const fs::path& target, Privacy privacy) : target_(resolved(target)), privacy_(privacy) {
    struct stat old {};
    replaces_ = ::stat(target_.c_str(), &old) == 0;
    if (replaces_ && S_ISDIR(old.st_mode)) {
        fail_to_write(target_, EISDIR);
    }
    constexpr mode_t anybody_writes = S_IWUSR | S_IWGRP | S_IWOTH;
    if (replaces_ && (old.st_mode & anybody_writes) == 0) {
        throw Error("cannot write: the file is write-protected", target_, "use another name");
    }
    if (replaces_ && ::faccessat(AT_FDCWD, target_.c_str(), W_OK, AT_EACCESS) != 0) {
        fail();
    }
    make();
}

Draft::~Draft() {
    close();
    if (!place_.empty()) {
        ::unlink(place_.c_str());
    }
    if (!old_.empty()) {
        ::unlink(old_.c_str());
    }
}

void Draft::make() {
    const fs::path folder = target_.has_parent_path() ? target_.parent_path() : fs::path(".");
    remove_abandoned(folder);
    while (handle_ < 0) {
        fs::path place = random_name(folder);
        handle_ = ::open(place.c_str(),
                         O_RDWR | O_CREAT | O_EXCL | O_NOFOLLOW | O_CLOEXEC,
                         replaces_ || privacy_ == Privacy::own ? 0600 : 0666); // less what the umask takes
        if (handle_ < 0 && errno != EEXIST) {
            fail();
        }
        if (handle_ < 0) {
            continue;
        }
        place_ = std::move(place);
        (void)::flock(handle_, LOCK_EX); // without locks on this file system none is taken for abandoned
        struct stat made {};
        if (::fstat(handle_, &made) == 0 && made.st_nlink == 0) { // until then it looked abandoned
            ::close(std::exchange(handle_, -1));
            place_.clear();
        }
    }
}

void Draft::write(std::string_view bytes) {
    if (!internal::write_all(handle_, bytes)) {
        fail();
    }
}

/// Owner before mode, which a change of owner may narrow.
void Draft::take_rights() {
    struct stat old {};
    struct stat own {};
    if (replaces_ && ::stat(target_.c_str(), &old) == 0 && ::fstat(handle_, &own) == 0) {
        const bool same = old.st_uid == own.st_uid && old.st_gid == own.st_gid;
        owner_is_lost_ = !same && ::fchown(handle_, old.st_uid, old.st_gid) != 0;
        const mode_t kept = privacy_ == Privacy::own ? 0700U : 0777U;
        if (::fchmod(handle_, old.st_mode & kept) != 0) {
            fail();
        }
    }
    if (::fsync(handle_) != 0) {
        fail();
    }
}

void Draft::finish() {
    take_rights();
    if (owner_is_lost_) {
        copy_into_place();
    } else if (::rename(place_.c_str(), target_.c_str()) != 0) {
        fail();
    } else {
        place_.clear();
    }
    close();
}

/// One that a person finds, and that no program takes for abandoned.
void Draft::take_visible_name() {
    constexpr int most = 1000;
    for (int n = 1; n <= most; ++n) {
        fs::path name = target_;
        name += n == 1 ? std::string(".new") : ".new-" + std::to_string(n);
        if (::renameat2(AT_FDCWD, place_.c_str(), AT_FDCWD, name.c_str(), RENAME_NOREPLACE) == 0) {
            place_ = std::move(name);
            return;
        }
        if (errno != EEXIST) {
            return; // a file system without it
        }
    }
}

/// A file that others own and we may write keeps its owner only so. Everything is in the draft by then, and
/// stays there if we are killed before all of it is copied.
void Draft::copy_into_place() {
    take_visible_name();
    const int to = ::open(target_.c_str(), O_WRONLY | O_NOFOLLOW | O_CLOEXEC);
    if (to < 0) {
        fail();
    }
    std::array<char, 65536> buffer{};
    off_t at = 0;
    bool good = true;
    for (ssize_t count = 1; good && count > 0;) {
        count = ::pread(handle_, buffer.data(), buffer.size(), at);
        good = count >= 0 && ::pwrite(to, buffer.data(), static_cast<std::size_t>(count), at) == count;
        at += good ? count : 0;
    }
    good = good && ::ftruncate(to, at) == 0 && ::fsync(to) == 0;
    const int why = errno;
    if (::close(to) != 0 || !good) {
        errno = good ? errno : why;
        fail();
    }
}

void Draft::exchange() {
    take_rights();
    if (owner_is_lost_) {
        throw Error("cannot write: the file belongs to another user", target_, "choose another folder");
    }
    if (!replaces_) {
        if (::renameat2(AT_FDCWD, place_.c_str(), AT_FDCWD, target_.c_str(), RENAME_NOREPLACE) != 0 &&
            (errno == EEXIST || ::rename(place_.c_str(), target_.c_str()) != 0)) {
            fail();
        }
    } else if (::renameat2(AT_FDCWD, place_.c_str(), AT_FDCWD, target_.c_str(), RENAME_EXCHANGE) == 0) {
        old_ = place_;
    } else { // not on every file system; the old file never leaves its place before the new one takes it
        fs::path aside = random_name(target_.has_parent_path() ? target_.parent_path() : fs::path("."));
        std::error_code failure;
        if (::link(target_.c_str(), aside.c_str()) != 0 && !fs::copy_file(target_, aside, failure)) {
            fail();
        }
        old_ = std::move(aside);
        if (::rename(place_.c_str(), target_.c_str()) != 0) {
            const int why = errno;
            ::unlink(old_.c_str());
            old_.clear();
            errno = why;
            fail();
        }
    }
    place_.clear();
    close();
}

void Draft::put_back() {
    if (!place_.empty()) { // it never took its place
        return;
    }
    if (old_.empty() ? ::unlink(target_.c_str()) != 0 : ::rename(old_.c_str(), target_.c_str()) != 0) {
        fail();
    }
    old_.clear();
}

/// What was to last has been synchronised before.
void Draft::close() {
    if (handle_ >= 0) {
        ::close(std::exchange(handle_, -1));
    }
}

void Draft::fail() const {
    fail_to_write(target_, errno);
}

} // namespace millwright
