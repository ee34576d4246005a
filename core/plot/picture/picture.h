// Pictures as brightness, and how they are read from PNG, JPEG and BMP files. Formats, rules and limits:
// docs/reference/picture.md. Source of the gray rule: KMITL master's thesis 2006, forming software for wood
// and plastic.
#pragma once

#include "core/base/error.h"
#include "core/base/progress.h"

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::plot {

/// The brightest there is. 8 bits become 16 by 257, which keeps 0 and 255 at the ends.
inline constexpr std::uint16_t white = 65535;

struct Picture {
    int width = 0;
    int height = 0;
    std::vector<std::uint16_t> gray;     ///< rows from the top, each from the left; 0 black, `white` white
    std::optional<double> pixels_per_mm; ///< across, as the file says
    int file_pixels = 1;                 ///< of the file that one is the mean of, across and down

    /// 0 <= row < height, 0 <= column < width.
    [[nodiscard]] std::uint16_t at(int row, int column) const {
        return gray[static_cast<std::size_t>(row) * static_cast<std::size_t>(width) +
                    static_cast<std::size_t>(column)];
    }

    friend bool operator==(const Picture&, const Picture&) = default;
};

enum class GrayRule {
    mean,     ///< (R + G + B) / 3, the fraction cut off, as the thesis
    luminance ///< 0.2126 R + 0.7152 G + 0.0722 B, as the eye weighs them (ITU-R BT.709)
};

/// Pixels of the file, counted from its top left corner.
struct PixelRegion {
    int left = 0;
    int top = 0;
    int width = 0;  ///< 0: up to the right edge
    int height = 0; ///< 0: up to the lower edge

    friend bool operator==(const PixelRegion&, const PixelRegion&) = default;
};

struct PictureSettings {
    GrayRule gray = GrayRule::mean;
    bool invert = false; ///< dark becomes bright
    /// Brightness of what is transparent, also if the picture is inverted: that of what is not cut.
    std::uint16_t ground = white;
    std::optional<PixelRegion> region = {}; ///< not given: all of it
    /// Bands of brightness, 2 to 256, of equal width, the darkest black and the brightest white; 0: as many
    /// as the file has.
    int gray_steps = 0;
    double pixel_aspect = 1.0; ///< height of a pixel by its width, 0.05 to 20, times what the file says
    /// A region of more pixels is averaged over squares of 2, 3, ... pixels until it has no more, >= 1.
    std::int64_t most_pixels = 64'000'000;
    /// What a picture that cannot be read row by row (interlaced, progressive) may take meanwhile, bytes.
    std::int64_t most_memory = 1'000'000'000;

    friend bool operator==(const PictureSettings&, const PictureSettings&) = default;
};

struct ReadPicture {
    Picture picture;
    std::vector<Diagnostic> notices; ///< what a person should know: averaged, transparent, CMYK
};

/// Throws Error for a number of gray steps that no picture can have.
void expect_gray_steps(int steps);

/// Reads a file's bytes; which format it is they say themselves. Pixels that are not square are made so.
/// Throws Error for gray steps and an aspect out of their range, naming `file` for what is no picture, is
/// damaged or cut off, or leaves the limits; and for a region that leaves the picture. Throws Cancelled
/// through `progress`.
[[nodiscard]] ReadPicture read_picture(std::string_view bytes,
                                       const std::filesystem::path& file,
                                       const PictureSettings& settings = {},
                                       const Progress& progress = Progress());

/// Reads the file itself, looking at its bytes as they are needed. Throws Error if it cannot be read, too.
[[nodiscard]] ReadPicture read_picture_file(const std::filesystem::path& file,
                                            const PictureSettings& settings = {},
                                            const Progress& progress = Progress());

// A picture with the pixels that its file has, for people to look at: what is cut has square ones.

struct FilePixels {
    Picture picture;
    /// Of a pixel of the file as it is seen, where a square one of what is cut has 1.
    double pixel_width = 1.0, pixel_height = 1.0;
};

/// As read_picture_file(), but pixels that are not square stay so, and the aspect of `settings` changes
/// nothing.
[[nodiscard]] FilePixels read_file_pixels(const std::filesystem::path& file,
                                          const PictureSettings& settings,
                                          const Progress& progress = Progress());

// How large a picture is on the work.

/// The first of these that is given counts; without any the file's own density, else 0.26 mm per pixel as in
/// the KMITL master's thesis of 2006.
struct PictureSize {
    std::optional<double> width = {};         ///< of the picture, or of its region, mm
    std::optional<double> dots_per_inch = {}; ///< pixels of the file
    std::optional<double> pixel = {};         ///< width of a pixel of the file, mm

    friend bool operator==(const PictureSize&, const PictureSize&) = default;
};

/// Width of a pixel of `picture`, mm; one that is the mean of several of its file is as wide as they are.
/// Throws Error for a size that is not above 0 and finite.
[[nodiscard]] double pixel_pitch(const PictureSize& size, const Picture& picture);

// Gray pictures as PNG files: what previews are saved as.

/// Rows from the top, each from the left.
struct GrayImage {
    int width = 0;
    int height = 0;
    std::vector<std::uint8_t> pixels; ///< 0 black, 255 white

    friend bool operator==(const GrayImage&, const GrayImage&) = default;
};

/// The bytes of a PNG of 8 bits per pixel. Throws Defect unless there are as many pixels as the size says, at
/// least one.
[[nodiscard]] std::string png_bytes(const GrayImage& image);

} // namespace millwright::plot
