#include "core/plot/picture/internal/exif.h"

#include "core/plot/picture/internal/row_sink.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <utility>

namespace millwright::plot::internal {

namespace {

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

} // namespace

bool lies(int orientation) {
    constexpr int first = 5;
    return orientation >= first;
}

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

PixelRegion region_in_file(PixelRegion seen, const PictureTurn& turn) {
    const bool sideways = lies(turn.orientation);
    seen = up_to_edge(seen, sideways ? turn.height : turn.width, sideways ? turn.width : turn.height);
    const auto [x0, y0] = in_file(seen.left, seen.top, turn.orientation, turn.width, turn.height);
    const auto [x1, y1] = in_file(
        seen.left + seen.width - 1, seen.top + seen.height - 1, turn.orientation, turn.width, turn.height);
    return {std::min(x0, x1),
            std::min(y0, y1),
            sideways ? seen.height : seen.width,
            sideways ? seen.width : seen.height};
}

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

} // namespace millwright::plot::internal
