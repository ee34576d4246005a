#include "core/plot/picture/picture.h"

#include "core/base/error.h"
#include "core/base/file_snapshot.h"
#include "core/plot/picture/internal/checks.h"
#include "core/plot/picture/internal/row_sink.h"

#include <fmt/format.h>
#include <png.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>
#include <utility>

namespace millwright::plot {

namespace {

// How a JPEG or PNG picture was held by the camera that took it: Exif 2.3, tag 0x0112; of PNG in the chunk
// eXIf (PNG specification, third edition).

struct PictureTurn {
    int orientation = 1; ///< 1 to 8, as Exif has it; 1: as it is stored in the file
    int width = 0;       ///< of the file's pixels; 0: not found
    int height = 0;
};

/// Numbers in either order of bytes; beyond the end there are zeros.
class Numbers {
public:
    Numbers(std::string_view bytes, bool little) : bytes_(bytes), little_(little) {}

    [[nodiscard]] std::uint32_t two(std::size_t at) const {
        return little_ ? byte(at) | byte(at + 1) << 8U : byte(at) << 8U | byte(at + 1);
    }
    [[nodiscard]] std::uint32_t four(std::size_t at) const {
        return little_ ? two(at) | two(at + 2) << 16U : two(at) << 16U | two(at + 2);
    }

private:
    [[nodiscard]] std::uint32_t byte(std::size_t at) const {
        return at < bytes_.size() ? static_cast<unsigned char>(bytes_[at]) : 0U;
    }

    std::string_view bytes_;
    bool little_;
};

/// In the TIFF that an Exif segment holds.
int orientation_in(std::string_view tiff) {
    const bool little = tiff.starts_with(std::string_view("II*\0", 4));
    if (!little && !tiff.starts_with(std::string_view("MM\0*", 4))) {
        return 1;
    }
    const Numbers number(tiff, little);
    const std::size_t directory = number.four(4);
    const std::uint32_t entries = directory < tiff.size() ? number.two(directory) : 0;
    constexpr std::size_t entry_size = 12;
    for (std::size_t n = 0; n < entries; ++n) {
        const std::size_t entry = directory + 2 + n * entry_size;
        if (entry + entry_size > tiff.size()) {
            break;
        }
        constexpr std::uint32_t orientation_tag = 0x0112;
        constexpr std::uint32_t highest = 8;
        const std::uint32_t value = number.two(entry + 8);
        if (number.two(entry) == orientation_tag && value >= 1 && value <= highest) {
            return static_cast<int>(value);
        }
    }
    return 1;
}

/// The file's pixel that is seen at (x, y); the file has width x height pixels.
std::pair<int, int> in_file(int x, int y, int orientation, int width, int height) {
    switch (orientation) {
    case 2:
        return {width - 1 - x, y};
    case 3:
        return {width - 1 - x, height - 1 - y};
    case 4:
        return {x, height - 1 - y};
    case 5:
        return {y, x};
    case 6:
        return {y, height - 1 - x};
    case 7:
        return {width - 1 - y, height - 1 - x};
    case 8:
        return {width - 1 - y, x};
    default:
        return {x, y};
    }
}

/// Turned by a quarter, so that width and height change places.
bool lies(int orientation) {
    constexpr int first = 5;
    return orientation >= first;
}

/// Of a whole file's bytes. What is no Exif that can be read counts as none.
PictureTurn jpeg_turn(std::string_view bytes) {
    constexpr std::uint32_t exif_marker = 0xE1;
    constexpr std::uint32_t scan_marker = 0xDA;
    const std::string_view exif("Exif\0\0", 6);
    const Numbers number(bytes, false);
    PictureTurn turn;
    std::size_t at = 2; // behind the start of the picture
    while (at + 4 <= bytes.size() && static_cast<unsigned char>(bytes[at]) == 0xFF) {
        const std::uint32_t marker = number.two(at) & 0xFFU;
        const std::size_t length = number.two(at + 2);
        if (marker == scan_marker || length < 2) {
            break;
        }
        const std::string_view segment = bytes.substr(at + 4, length - 2);
        if (marker == exif_marker && segment.starts_with(exif)) {
            turn.orientation = orientation_in(segment.substr(exif.size()));
        }
        const bool frame =
            marker >= 0xC0 && marker <= 0xCF && marker != 0xC4 && marker != 0xC8 && marker != 0xCC;
        if (frame) {
            turn.height = static_cast<int>(number.two(at + 5));
            turn.width = static_cast<int>(number.two(at + 7));
        }
        at += 2 + length;
    }
    return turn;
}

PictureTurn png_turn(std::string_view bytes) {
    const Numbers number(bytes, false);
    PictureTurn turn;
    constexpr std::size_t around = 12;                       // a chunk's length, type and check sum
    for (std::size_t at = 8; at + around <= bytes.size();) { // behind the signature
        const std::size_t length = number.four(at);
        const std::string_view type = bytes.substr(at + 4, 4);
        if (length > bytes.size() - at - around || type == "IEND") {
            break;
        }
        if (type == "IHDR") {
            turn.width = static_cast<int>(number.four(at + 8));
            turn.height = static_cast<int>(number.four(at + around));
        } else if (type == "eXIf") {
            turn.orientation = orientation_in(bytes.substr(at + 8, length));
        }
        at += length + around;
    }
    return turn;
}

/// Pixels of the file, for a region of the picture as people see it.
PixelRegion region_in_file(PixelRegion seen, const PictureTurn& turn) {
    const bool sideways = lies(turn.orientation);
    seen =
        internal::up_to_edge(seen, sideways ? turn.height : turn.width, sideways ? turn.width : turn.height);
    const auto [x0, y0] = in_file(seen.left, seen.top, turn.orientation, turn.width, turn.height);
    const auto [x1, y1] = in_file(
        seen.left + seen.width - 1, seen.top + seen.height - 1, turn.orientation, turn.width, turn.height);
    return {std::min(x0, x1),
            std::min(y0, y1),
            sideways ? seen.height : seen.width,
            sideways ? seen.width : seen.height};
}

/// As people see it.
Picture turned(const Picture& picture, int orientation) {
    Picture seen;
    seen.width = lies(orientation) ? picture.height : picture.width;
    seen.height = lies(orientation) ? picture.width : picture.height;
    seen.pixels_per_mm = picture.pixels_per_mm;
    seen.file_pixels = picture.file_pixels;
    seen.gray.reserve(picture.gray.size());
    for (int y = 0; y < seen.height; ++y) {
        for (int x = 0; x < seen.width; ++x) {
            const auto [column, row] = in_file(x, y, orientation, picture.width, picture.height);
            seen.gray.push_back(picture.at(row, column));
        }
    }
    return seen;
}

using internal::PixelShape;

/// Cameras lay their pictures down as they were held, and say so.
ReadPicture read_turned(std::string_view bytes,
                        const std::filesystem::path& file,
                        PictureSettings settings,
                        const Progress& progress,
                        PixelShape& shape,
                        const PictureTurn& turn,
                        void (*read_rows)(std::string_view bytes, internal::RowSink& sink)) {
    if (settings.region && turn.orientation != 1) {
        settings.region = region_in_file(*settings.region, turn);
    }
    internal::RowSink sink(settings, file, progress);
    read_rows(bytes, sink);
    ReadPicture read = sink.end(shape);
    if (turn.orientation != 1) {
        read.picture = turned(read.picture, turn.orientation);
    }
    if (lies(turn.orientation)) {
        std::swap(shape.width, shape.height);
    }
    return read;
}

ReadPicture read_rows_of(std::string_view bytes,
                         const std::filesystem::path& file,
                         const PictureSettings& settings,
                         const Progress& progress,
                         PixelShape& shape) {
    if (bytes.starts_with("\xff\xd8")) {
        return read_turned(
            bytes, file, settings, progress, shape, jpeg_turn(bytes), internal::read_jpeg_rows);
    }
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) {
        return read_turned(bytes, file, settings, progress, shape, png_turn(bytes), internal::read_png_rows);
    }
    internal::RowSink sink(settings, file, progress);
    if (bytes.starts_with("BM")) {
        internal::read_bmp_rows(bytes, sink);
    } else if (bytes.starts_with("P5") || bytes.starts_with("P6")) {
        internal::read_pnm_rows(bytes, sink);
    } else {
        sink.fail(bytes.empty() ? "the file is empty" : "the picture format is not supported",
                  "use a PNG, JPEG, BMP, PGM or PPM file");
    }
    return sink.end(shape);
}

/// Every band becomes one brightness.
void make_steps(Picture& picture, int steps) {
    constexpr unsigned values = white + 1U;
    const auto count = static_cast<unsigned>(steps);
    for (std::uint16_t& gray : picture.gray) {
        const unsigned band = gray * count / values;
        gray = static_cast<std::uint16_t>(band * white / (count - 1));
    }
}

void expect_in_range(const PictureSettings& settings) {
    constexpr double flattest = 0.05, highest = 20.0;
    expect_gray_steps(settings.gray_steps);
    if (!(settings.pixel_aspect >= flattest && settings.pixel_aspect <= highest)) {
        throw Error(fmt::format("a pixel is {} times as high as wide, but must be {} to {} times",
                                settings.pixel_aspect,
                                flattest,
                                highest));
    }
}

} // namespace

void expect_gray_steps(int steps) {
    constexpr int most_steps = 256;
    if (steps != 0 && (steps < 2 || steps > most_steps)) {
        throw Error(fmt::format("{} gray levels are not possible", steps),
                    {},
                    fmt::format("use 2 to {}, or 0 for the picture as it is", most_steps));
    }
}

ReadPicture read_picture(std::string_view bytes,
                         const std::filesystem::path& file,
                         const PictureSettings& settings,
                         const Progress& progress) {
    expect_in_range(settings);
    PixelShape shape;
    ReadPicture read = read_rows_of(bytes, file, settings, progress, shape);
    const int rows = std::max(1, static_cast<int>(std::lround(read.picture.height * settings.pixel_aspect)));
    if (rows != read.picture.height) {
        read.picture = internal::with_rows(read.picture, rows);
    }
    if (settings.gray_steps > 0) {
        make_steps(read.picture, settings.gray_steps);
    }
    return read;
}

ReadPicture read_picture_file(const std::filesystem::path& file,
                              const PictureSettings& settings,
                              const Progress& progress) {
    const FileSnapshot bytes(file, progress);
    return read_picture(bytes.text(), file, settings, progress);
}

FilePixels read_file_pixels(const std::filesystem::path& file,
                            const PictureSettings& settings,
                            const Progress& progress) {
    expect_in_range(settings);
    const FileSnapshot bytes(file, progress);
    PixelShape shape{.stays = true};
    Picture picture = read_rows_of(bytes.text(), file, settings, progress, shape).picture;
    if (settings.gray_steps > 0) {
        make_steps(picture, settings.gray_steps);
    }
    return {.picture = std::move(picture), .pixel_width = shape.width, .pixel_height = shape.height};
}

double pixel_pitch(const PictureSize& size, const Picture& picture) {
    constexpr double mm_per_inch = 25.4;
    constexpr double thesis_pixel = 0.26;
    if (size.width) {
        internal::check_above_zero("the width", *size.width);
        return *size.width / picture.width;
    }
    if (size.dots_per_inch) {
        internal::check_above_zero("the number of pixels per inch", *size.dots_per_inch);
        return picture.file_pixels * mm_per_inch / *size.dots_per_inch;
    }
    if (size.pixel) {
        internal::check_above_zero("the pixel width", *size.pixel);
        return picture.file_pixels * *size.pixel;
    }
    return picture.pixels_per_mm ? 1.0 / *picture.pixels_per_mm : picture.file_pixels * thesis_pixel;
}

std::string png_bytes(const GrayImage& image) {
    expects(image.width > 0 && image.height > 0 &&
                image.pixels.size() ==
                    static_cast<std::size_t>(image.width) * static_cast<std::size_t>(image.height),
            "an image has as many pixels as its size says");
    png_image head = {};
    head.version = PNG_IMAGE_VERSION;
    head.width = static_cast<png_uint_32>(image.width);
    head.height = static_cast<png_uint_32>(image.height);
    head.format = PNG_FORMAT_GRAY;
    png_alloc_size_t size = PNG_IMAGE_PNG_SIZE_MAX(head);
    std::string bytes(size, '\0');
    const int done =
        png_image_write_to_memory(&head, bytes.data(), &size, 0, image.pixels.data(), 0, nullptr);
    expects(done != 0, "a picture in memory becomes a PNG");
    bytes.resize(size);
    return bytes;
}

} // namespace millwright::plot
