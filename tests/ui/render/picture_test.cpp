#include "ui/render/picture.h"

#include "core/base/error.h"
#include "core/base/files.h"

#include <gtest/gtest.h>

#include <filesystem>

namespace millwright::render {
namespace {

namespace fs = std::filesystem;

/// A folder of this test alone, removed with everything in it.
class Folder {
public:
    Folder() {
        const auto* test = ::testing::UnitTest::GetInstance()->current_test_info();
        path_ =
            fs::temp_directory_path() / (std::string("millwright_") + test->test_suite_name() + test->name());
        fs::remove_all(path_);
        fs::create_directories(path_);
    }
    Folder(const Folder&) = delete;
    Folder& operator=(const Folder&) = delete;
    ~Folder() { fs::remove_all(path_); }

    [[nodiscard]] fs::path operator/(const char* name) const { return path_ / name; }

private:
    fs::path path_;
};

/// Every pixel another colour and opacity.
Picture colorful() {
    Picture picture = filled({7, 5}, Pixel{});
    std::uint8_t i = 0;
    for (Pixel& pixel : picture.pixels) {
        pixel = {i, static_cast<std::uint8_t>(255 - i), static_cast<std::uint8_t>(3 * i), 200};
        ++i;
    }
    return picture;
}

TEST(Picture, ComesBackFromItsPngFileUnchanged) {
    const Folder folder;
    write_png(colorful(), folder / "a.png");
    EXPECT_EQ(read_picture(folder / "a.png"), colorful());
}

TEST(Picture, IsAPngThatOthersRecognise) {
    EXPECT_EQ(to_png(colorful()).substr(0, 8), "\x89PNG\r\n\x1a\n");
}

TEST(Picture, KeepsTheOldFileWhenWritingFails) {
    const Folder folder;
    write_file(folder / "a.png", "old");
    EXPECT_THROW(write_png(Picture{}, folder / "a.png"), Defect);
    EXPECT_EQ(read_file(folder / "a.png"), "old");
    EXPECT_THROW(write_png(colorful(), folder / "missing" / "a.png"), Error);
    EXPECT_FALSE(fs::exists(folder / "missing"));
}

TEST(Picture, NamesTheFileThatCannotBeRead) {
    const Folder folder;
    write_file(folder / "bad.png", "this is no picture");
    try {
        static_cast<void>(read_picture(folder / "bad.png"));
        FAIL() << "a text was read as a picture";
    } catch (const Error& error) {
        EXPECT_EQ(error.diagnostic().place.file.filename(), "bad.png");
    }
    EXPECT_THROW(static_cast<void>(read_picture(folder / "none.png")), Error);
}

TEST(Picture, CannotBeReadFromACutFile) {
    const std::string png = to_png(colorful());
    EXPECT_THROW(static_cast<void>(from_image_bytes(png.substr(0, png.size() / 2), "cut.png")), Error);
    EXPECT_THROW(static_cast<void>(from_image_bytes("", "empty.png")), Error);
}

TEST(Picture, HasItsFirstPixelInTheTopLeftCorner) {
    const Picture picture = colorful();
    EXPECT_EQ(picture.at(0, 0), picture.pixels.front());
    EXPECT_EQ(picture.at(6, 4), picture.pixels.back());
    EXPECT_THROW(static_cast<void>(picture.at(7, 0)), Defect);
    EXPECT_THROW(static_cast<void>(picture.at(0, -1)), Defect);
}

TEST(PictureDifference, IsZeroForTheSamePicture) {
    EXPECT_DOUBLE_EQ(difference(colorful(), colorful()).mean, 0.0);
    EXPECT_DOUBLE_EQ(difference(colorful(), colorful()).fraction, 0.0);
}

TEST(PictureDifference, CountsPixelsAboveTheTolerance) {
    const Picture black = filled({10, 10}, {0, 0, 0, 255});
    Picture other = black;
    other.pixels[0] = {51, 0, 0, 255};
    other.pixels[1] = {2, 0, 0, 255};
    EXPECT_DOUBLE_EQ(difference(black, other).fraction, 0.02);
    EXPECT_DOUBLE_EQ(difference(black, other, 2).fraction, 0.01);
    EXPECT_NEAR(difference(black, other).mean, 53.0 / 255.0 / 300.0, 1e-15);
}

TEST(PictureDifference, RefusesPicturesOfTwoSizes) {
    const Picture a = filled({2, 3}, {});
    const Picture b = filled({3, 2}, {});
    EXPECT_THROW(static_cast<void>(difference(a, b)), Defect);
}

} // namespace
} // namespace millwright::render
