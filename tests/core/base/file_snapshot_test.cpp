#include "core/base/file_snapshot.h"

#include "core/base/error.h"
#include "core/base/files.h"

#include <gtest/gtest.h>
#include <unistd.h>

#include <fstream>
#include <string>

namespace millwright {
namespace {

namespace fs = std::filesystem;

class FileSnapshotTest : public ::testing::Test {
protected:
    void SetUp() override { fs::create_directories(folder_); }
    void TearDown() override { fs::remove_all(folder_); }
    fs::path folder_ = fs::temp_directory_path() / ("millwright_snapshot_" + std::to_string(::getpid()));
};

TEST_F(FileSnapshotTest, HoldsTheBytesOfTheFile) {
    const std::string bytes = std::string(3'000'000, 'x').append("\0end\n", 5);
    write_file(folder_ / "a", bytes);
    EXPECT_EQ(FileSnapshot(folder_ / "a").text(), bytes);
}

TEST_F(FileSnapshotTest, StaysAsItWasWhenTheFileIsCutAndWrittenAnew) {
    const std::string bytes(100'000, 'a');
    write_file(folder_ / "a", bytes);
    const FileSnapshot snapshot(folder_ / "a");
    std::ofstream(folder_ / "a", std::ios::trunc) << "b";
    EXPECT_EQ(snapshot.text(), bytes);
    fs::remove(folder_ / "a");
    EXPECT_EQ(snapshot.text(), bytes);
}

TEST_F(FileSnapshotTest, LeavesNothingBehindInTheTemporaryFolder) {
    write_file(folder_ / "a", "abc");
    const auto count = [] {
        return std::count_if(fs::directory_iterator(fs::temp_directory_path()), {}, [](const auto& entry) {
            return entry.path().filename().string().starts_with("millwright-");
        });
    };
    const auto before = count();
    const FileSnapshot snapshot(folder_ / "a");
    EXPECT_EQ(count(), before);
}

TEST_F(FileSnapshotTest, OfAnEmptyFileIsEmpty) {
    write_file(folder_ / "a", "");
    EXPECT_TRUE(FileSnapshot(folder_ / "a").text().empty());
    EXPECT_TRUE(FileSnapshot().text().empty());
}

TEST_F(FileSnapshotTest, SaysWhatCannotBeOpened) {
    EXPECT_THROW(FileSnapshot(folder_ / "missing"), Error);
    EXPECT_THROW(FileSnapshot snapshot(folder_), Error);
}

TEST_F(FileSnapshotTest, CanBeCancelled) {
    write_file(folder_ / "a", "abc");
    std::stop_source stop;
    stop.request_stop();
    EXPECT_THROW(FileSnapshot(folder_ / "a", Progress({}, stop.get_token())), Cancelled);
}

} // namespace
} // namespace millwright
