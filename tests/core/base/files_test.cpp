#include "core/base/files.h"

#include "core/base/error.h"

#include <fcntl.h>
#include <gtest/gtest.h>
#include <sys/stat.h>
#include <unistd.h>

#include <array>
#include <filesystem>
#include <string>

namespace millwright {
namespace {

namespace fs = std::filesystem;

class Files : public ::testing::Test {
protected:
    Files() : folder_(fs::temp_directory_path() / ("millwright_files_" + std::to_string(::getpid()))) {
        fs::remove_all(folder_);
        fs::create_directories(folder_);
    }
    ~Files() override { fs::remove_all(folder_); }

    [[nodiscard]] fs::path in_folder(const std::string& name) const { return folder_ / name; }

    [[nodiscard]] std::ptrdiff_t file_count() const {
        return std::distance(fs::directory_iterator(folder_), fs::directory_iterator{});
    }

private:
    fs::path folder_;
};

TEST_F(Files, WhatIsWrittenReadsBackByteForByte) {
    const std::string bytes("one\r\ntwo\0three", 14);
    write_file(in_folder("a.bin"), bytes);
    EXPECT_EQ(read_file(in_folder("a.bin")), bytes);
    EXPECT_EQ(file_count(), 1);
}

TEST_F(Files, AFailedWriteLeavesTheOldFileAndNoDraft) {
    write_file(in_folder("a.txt"), "old");
    fs::create_directory(in_folder("b"));
    EXPECT_THROW(write_file(in_folder("b"), "new"), Error);
    EXPECT_THROW(write_file(in_folder("missing/a.txt"), "new"), Error);
    EXPECT_EQ(read_file(in_folder("a.txt")), "old");
    EXPECT_EQ(file_count(), 2);
}

TEST_F(Files, PiecesTakeThePlaceOfTheOldFileWhenClosedAndNotBefore) {
    write_file(in_folder("a.txt"), "old");
    {
        FileWriter given_up(in_folder("a.txt"));
        given_up.write("half");
    }
    EXPECT_EQ(read_file(in_folder("a.txt")), "old");
    FileWriter writer(in_folder("a.txt"));
    writer.write("one, ");
    writer.write("two");
    EXPECT_EQ(read_file(in_folder("a.txt")), "old");
    writer.close();
    EXPECT_EQ(read_file(in_folder("a.txt")), "one, two");
    EXPECT_EQ(file_count(), 1);
    EXPECT_THROW(FileWriter(in_folder("missing/a.txt")), Error);
}

TEST_F(Files, WhatIsNoFileIsWrittenThroughAndStays) {
    const fs::path pipe = in_folder("pipe");
    ASSERT_EQ(::mkfifo(pipe.c_str(), 0600), 0);
    const int reader = ::open(pipe.c_str(), O_RDONLY | O_NONBLOCK);
    ASSERT_GE(reader, 0);
    write_file(pipe, "through");
    std::array<char, 16> got{};
    EXPECT_EQ(::read(reader, got.data(), got.size()), 7);
    EXPECT_EQ(std::string(got.data()), "through");
    ::close(reader);
    EXPECT_TRUE(fs::is_fifo(pipe));
    fs::create_symlink("/dev/full", in_folder("full"));
    EXPECT_THROW(write_file(in_folder("full"), "nowhere"), Error);
    EXPECT_TRUE(fs::is_character_file(in_folder("full")));
    EXPECT_EQ(file_count(), 2);
}

TEST_F(Files, WritingThroughALinkKeepsTheLink) {
    write_file(in_folder("real.txt"), "old");
    fs::create_symlink("real.txt", in_folder("link.txt"));
    write_file(in_folder("link.txt"), "new");
    EXPECT_TRUE(fs::is_symlink(in_folder("link.txt")));
    EXPECT_EQ(read_file(in_folder("real.txt")), "new");
}

TEST_F(Files, ReadingNamesTheFileAndTheReason) {
    try {
        (void)read_file(in_folder("missing.json"));
        FAIL() << "no Error";
    } catch (const Error& error) {
        EXPECT_EQ(error.diagnostic().place.file, in_folder("missing.json"));
        EXPECT_NE(error.diagnostic().message.find("No such file"), std::string::npos);
    }
    EXPECT_THROW((void)read_file(in_folder("")), Error);
}

TEST_F(Files, AFolderIsMadeWithItsParentsAndNeverOverAFile) {
    make_folder(in_folder("x/y/z"));
    EXPECT_TRUE(fs::is_directory(in_folder("x/y/z")));
    EXPECT_NO_THROW(make_folder(in_folder("x/y/z")));
    write_file(in_folder("file"), "");
    EXPECT_THROW(make_folder(in_folder("file")), Error);
    EXPECT_THROW(make_folder(in_folder("file/below")), Error);
    EXPECT_THROW(make_folder(in_folder(std::string(300, 'n'))), Error) << "longer than a name may be";
}

} // namespace
} // namespace millwright
