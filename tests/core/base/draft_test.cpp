#include "core/base/draft.h"

#include "core/base/error.h"
#include "core/base/file_snapshot.h"
#include "core/base/files.h"
#include "core/base/json.h"

#include <gtest/gtest.h>
#include <sys/stat.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <csignal>
#include <filesystem>
#include <string>
#include <vector>

namespace millwright {
namespace {

namespace fs = std::filesystem;

class DraftTest : public ::testing::Test {
protected:
    DraftTest() : folder_(fs::temp_directory_path() / ("millwright_draft_" + std::to_string(::getpid()))) {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    ~DraftTest() override { fs::remove_all(folder_); }

    [[nodiscard]] std::vector<std::string> names(const fs::path& folder) const {
        std::vector<std::string> found;
        for (const auto& entry : fs::directory_iterator(folder)) {
            found.push_back(entry.path().filename().string());
        }
        std::sort(found.begin(), found.end());
        return found;
    }
    [[nodiscard]] static std::string refusal(const fs::path& file) {
        try {
            write_file(file, "new");
        } catch (const Error& error) {
            return error.what();
        }
        return {};
    }
    [[nodiscard]] static mode_t mode_of(const fs::path& file) {
        struct stat found {};
        return ::stat(file.c_str(), &found) == 0 ? found.st_mode & 07777U : 0;
    }

    fs::path folder_;
};

TEST_F(DraftTest, TwoOfOneFileDoNotMeet) {
    Draft first(folder_ / "a");
    Draft second(folder_ / "a");
    first.write("first");
    second.write("second");
    second.finish();
    first.finish();
    EXPECT_EQ(read_file(folder_ / "a"), "first");
    EXPECT_EQ(names(folder_), std::vector<std::string>{"a"});
}

TEST_F(DraftTest, AWriteProtectedFileIsRefusedAlsoForRoot) {
    write_file(folder_ / "a", "old");
    fs::permissions(folder_ / "a", fs::perms(0444));
    EXPECT_NE(refusal(folder_ / "a").find("write-protected"), std::string::npos);
    EXPECT_EQ(read_file(folder_ / "a"), "old");
    EXPECT_EQ(names(folder_), std::vector<std::string>{"a"});
}

TEST_F(DraftTest, TheModeOfTheOldFileStaysAndThatOfANewOneIsByTheUmask) {
    write_file(folder_ / "a", "old");
    fs::permissions(folder_ / "a", fs::perms(0640));
    write_file(folder_ / "a", "new");
    EXPECT_EQ(mode_of(folder_ / "a"), 0640U);
    const mode_t before = ::umask(027);
    write_file(folder_ / "b", "new");
    ::umask(before);
    EXPECT_EQ(mode_of(folder_ / "b"), 0640U);
    write_file(folder_ / "c", "new", Privacy::own);
    EXPECT_EQ(mode_of(folder_ / "c"), 0600U);
}

TEST_F(DraftTest, AFileKeepsItsOwner) {
    if (::geteuid() != 0) {
        GTEST_SKIP() << "only root can give files away";
    }
    write_file(folder_ / "a", "old");
    constexpr uid_t somebody = 12345;
    ASSERT_EQ(::chown((folder_ / "a").c_str(), somebody, somebody), 0);
    write_file(folder_ / "a", "new");
    struct stat found {};
    ASSERT_EQ(::stat((folder_ / "a").c_str(), &found), 0);
    EXPECT_EQ(found.st_uid, somebody);
    EXPECT_EQ(found.st_gid, somebody);
}

/// In a child, which can become another user.
template <class Work> int as_user(uid_t user, const Work& work) {
    const pid_t child = ::fork();
    if (child == 0) {
        ::_exit(::setgid(user) == 0 && ::setuid(user) == 0 ? work() : 99);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

TEST_F(DraftTest, AFileOfAnotherThatMayBeWrittenKeepsItsOwnerAndOneThatMayNotIsRefused) {
    if (::geteuid() != 0) {
        GTEST_SKIP() << "only root can become another user";
    }
    constexpr uid_t somebody = 12345;
    constexpr uid_t other = 12346;
    fs::permissions(folder_, fs::perms(0777));
    for (const auto& [name, mode] : {std::pair("open", 0666), std::pair("closed", 0644)}) {
        write_file(folder_ / name, "old and longer");
        ASSERT_EQ(::chown((folder_ / name).c_str(), somebody, somebody), 0);
        fs::permissions(folder_ / name, fs::perms(mode));
    }
    EXPECT_EQ(as_user(other, [&] { return refusal(folder_ / "open").empty() ? 0 : 1; }), 0);
    EXPECT_EQ(as_user(other, [&] { return refusal(folder_ / "closed").empty() ? 0 : 1; }), 1);
    EXPECT_EQ(read_file(folder_ / "open"), "new");
    EXPECT_EQ(read_file(folder_ / "closed"), "old and longer");
    struct stat found {};
    ASSERT_EQ(::stat((folder_ / "open").c_str(), &found), 0);
    EXPECT_EQ(found.st_uid, somebody);
    EXPECT_EQ(names(folder_).size(), 2U);
}

TEST_F(DraftTest, ALinkOfAStrangerInAnOpenFolderIsNotFollowed) {
    if (::geteuid() != 0) {
        GTEST_SKIP() << "only root can give links away";
    }
    constexpr uid_t stranger = 12345;
    fs::create_directory(folder_ / "home");
    write_file(folder_ / "home/secret", "old");
    fs::create_directory(folder_ / "open");
    fs::create_symlink(folder_ / "home/secret", folder_ / "open/out");
    fs::create_symlink("../home", folder_ / "open/folder");
    fs::create_symlink(folder_ / "open/out", folder_ / "ours"); // behind it lies that of the stranger
    for (const char* const link : {"open/out", "open/folder"}) {
        ASSERT_EQ(::lchown((folder_ / link).c_str(), stranger, stranger), 0);
    }
    for (const unsigned mode : {01777U, 0777U, 02775U}) {
        ASSERT_EQ(::chmod((folder_ / "open").c_str(), mode), 0);
        for (const char* const name : {"open/out", "open/folder/secret", "open/folder/new", "ours"}) {
            EXPECT_NE(refusal(folder_ / name).find("link of another user"), std::string::npos)
                << name << mode;
        }
    }
    EXPECT_EQ(read_file(folder_ / "home/secret"), "old");
    ASSERT_EQ(::chown((folder_ / "open").c_str(), stranger, stranger), 0); // who owns the folder may
    write_file(folder_ / "open/out", "new");
    EXPECT_EQ(read_file(folder_ / "home/secret"), "new");
    ASSERT_EQ(::chown((folder_ / "open").c_str(), 0, 0), 0);
    ASSERT_EQ(::chmod((folder_ / "open").c_str(), 0755), 0); // where no one else can write it is no trap
    write_file(folder_ / "open/folder/secret", "newer");
    EXPECT_EQ(read_file(folder_ / "home/secret"), "newer");
}

TEST_F(DraftTest, OfAKilledProgramIsRemovedByTheNextAndThatOfALivingOneIsNot) {
    fs::create_directory(folder_ / "new");
    const pid_t child = ::fork();
    if (child == 0) {
        Draft left(folder_ / "new/a");
        left.write("half");
        ::raise(SIGKILL);
    }
    int status = 0;
    ::waitpid(child, &status, 0);
    ASSERT_EQ(names(folder_ / "new").size(), 1U);
    {
        const Draft living(folder_ / "new/b");
        EXPECT_EQ(names(folder_ / "new").size(), 1U) << "the one that was left is gone";
        const int found = as_user(::geteuid(), [&] { // another program, which looks for itself
            const Draft next(folder_ / "new/../new/c");
            return static_cast<int>(std::distance(fs::directory_iterator(folder_ / "new"), {}));
        });
        EXPECT_EQ(found, 2) << "the living one, and its own";
    }
    EXPECT_TRUE(names(folder_ / "new").empty());
}

TEST_F(DraftTest, TheLongestNameHasRoom) {
    const std::string name(255, 'n');
    write_file(folder_ / name, "new");
    EXPECT_EQ(read_file(folder_ / name), "new");
}

TEST_F(DraftTest, LinksInALoopAreAnError) {
    fs::create_symlink("b", folder_ / "a");
    fs::create_symlink("a", folder_ / "b");
    EXPECT_NE(refusal(folder_ / "a").find("Too many levels"), std::string::npos);
    EXPECT_THROW((void)read_file(folder_ / "a"), Error);
}

TEST_F(DraftTest, AnExchangeIsTakenBack) {
    write_file(folder_ / "a", "old");
    {
        Draft replaced(folder_ / "a");
        Draft added(folder_ / "b");
        for (Draft* const draft : {&replaced, &added}) {
            draft->write("new");
            draft->exchange();
        }
        EXPECT_EQ(read_file(folder_ / "a"), "new");
        replaced.put_back();
        added.put_back();
    }
    EXPECT_EQ(read_file(folder_ / "a"), "old");
    EXPECT_EQ(names(folder_), std::vector<std::string>{"a"});
    {
        Draft replaced(folder_ / "a");
        replaced.write("new");
        replaced.exchange();
    }
    EXPECT_EQ(read_file(folder_ / "a"), "new");
    EXPECT_EQ(names(folder_), std::vector<std::string>{"a"});
}

TEST_F(DraftTest, ReadersHaveABoundThatTheyName) {
    const auto fault_of = [](const auto& read) {
        try {
            read();
        } catch (const Error& error) {
            return std::string(error.what());
        }
        return std::string();
    };
    const fs::path sparse = folder_ / "sparse";
    write_file(sparse, "");
    fs::resize_file(sparse, std::uintmax_t{4} << 30U);
    for (const fs::path& file : {sparse, fs::path("/dev/zero")}) {
        EXPECT_NE(fault_of([&] { (void)read_file(file); }).find("larger than 1 GiB"), std::string::npos);
        EXPECT_NE(
            fault_of([&] { (void)FileSnapshot(file, Progress(), 3U << 20U); }).find("larger than 3 MiB"),
            std::string::npos);
    }
    EXPECT_NE(fault_of([&] { (void)FileSnapshot(sparse); }).find("larger than 2 GiB"), std::string::npos);
    std::string many = "[0";
    for (int n = 0; n < 4'000'000; ++n) {
        many += ",0";
    }
    EXPECT_NE(
        fault_of([&] { (void)JsonValue::parse(many + "]", "many.json"); }).find("more than 4000000 values"),
        std::string::npos);
}

} // namespace
} // namespace millwright
