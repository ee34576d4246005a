// Where the decoders put their rows: brightness by the rule, the region, averaging.
#pragma once

#include "core/plot/picture/picture.h"

#include <string>

namespace millwright::plot::internal {

// Pixels that are not as wide as high, as those of scanners and old screens.

/// The picture with another number of rows, >= 1, that take the same height: each is the mean of those that
/// it covers.
[[nodiscard]] Picture with_rows(const Picture& picture, int rows);

/// What the bytes of a row are. Samples of 16 bits are in the machine's own order.
struct RowFormat {
    int channels = 3; ///< 1 gray, 2 gray and opacity, 3 RGB, 4 RGB and opacity
    int bits = 8;     ///< 8 or 16, of a sample
};

/// The region of a picture of this size, where a width or height of 0 goes up to its edge.
[[nodiscard]] PixelRegion up_to_edge(PixelRegion region, int width, int height);

/// Of a pixel, where a square one has 1.
struct PixelShape {
    bool stays = false; ///< else it is made square
    double width = 1.0, height = 1.0;
};

class RowSink {
public:
    RowSink(const PictureSettings& settings, const std::filesystem::path& file, const Progress& progress)
        : settings_(settings), file_(file), progress_(progress) {}

    /// Once, before the first row. Throws Error for a size or region that cannot be.
    void begin(std::int64_t width, std::int64_t height, RowFormat format);
    /// As the file says; what cannot be is passed over.
    void set_pixels_per_mm(double across, double down);
    /// Where the file says only how many pixels across are as long as how many down.
    void set_pixel_shape(double across, double down);

    /// Row `y` from the top; rows come in order, upward or downward. Throws Cancelled.
    void row(int y, const unsigned char* samples);
    /// Row `y` and all below are not wanted.
    [[nodiscard]] bool over_at(int y) const { return y >= region_.top + region_.height; }

    void notice(std::string message, std::string hint = {});
    [[noreturn]] void fail(std::string message, std::string hint = {}) const;
    /// Throws Error if `bytes` that `what` needs in memory at once are too many.
    void allow_memory(std::int64_t bytes, const std::string& what) const;

    /// The picture, when all rows came. Its pixels are made square unless `shape` stays, which gets their
    /// width and height then.
    [[nodiscard]] ReadPicture end(PixelShape& shape);

private:
    void add_to_block(int line);
    void flush_block();
    void square_pixels(PixelShape& shape);

    const PictureSettings& settings_;
    const std::filesystem::path& file_;
    const Progress& progress_;
    RowFormat format_;
    PixelRegion region_;
    int square_ = 1; ///< side of the squares that are averaged
    bool transparent_ = false;
    double height_of_width_ = 1.0;    ///< of a pixel of the file
    std::vector<std::uint16_t> line_; ///< brightness of a row of the region
    std::vector<std::uint64_t> sums_; ///< of the row of squares that is being read
    int sums_row_ = -1;
    int sums_lines_ = 0;
    int lines_ = 0;
    ReadPicture read_;
};

/// Each reads the format that its name says.
void read_png_rows(std::string_view bytes, RowSink& sink);
void read_jpeg_rows(std::string_view bytes, RowSink& sink);
void read_bmp_rows(std::string_view bytes, RowSink& sink);
/// `bytes` begin with P5 or P6.
void read_pnm_rows(std::string_view bytes, RowSink& sink);

} // namespace millwright::plot::internal
