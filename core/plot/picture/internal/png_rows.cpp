// PNG by libpng, row by row.
#include "core/plot/picture/internal/row_sink.h"

#include <fmt/format.h>
#include <png.h>

#include <bit>
#include <csetjmp>
#include <cstring>

namespace millwright::plot::internal {
namespace {

/// libpng reports errors by longjmp: each member that calls it jumps back to itself, over no object that
/// would have to be destroyed.
class PngReader {
public:
    PngReader(std::string_view bytes, RowSink& sink) : bytes_(bytes), sink_(sink) {
        png_ = png_create_read_struct(PNG_LIBPNG_VER_STRING, this, on_error, on_warning);
        info_ = png_ == nullptr ? nullptr : png_create_info_struct(png_);
        expects(info_ != nullptr, "libpng is the one it was compiled for");
    }
    PngReader(const PngReader&) = delete;
    PngReader& operator=(const PngReader&) = delete;
    ~PngReader() { png_destroy_read_struct(&png_, &info_, nullptr); }

    void read() {
        if (!begin()) {
            fail("its header");
        }
        const auto height = static_cast<int>(png_get_image_height(png_, info_));
        const int passes = passes_;
        sink_.begin(png_get_image_width(png_, info_), height, format());
        if (in_metres_) {
            sink_.set_pixels_per_mm(across_ / 1000.0, down_ / 1000.0);
        } else {
            sink_.set_pixel_shape(across_, down_);
        }
        const std::size_t stride = png_get_rowbytes(png_, info_);
        if (passes > 1) {
            read_interlaced(height, stride, passes);
            return;
        }
        std::vector<png_byte> row(stride);
        for (int y = 0; y < height && !sink_.over_at(y); ++y) {
            read_row(row.data(), y);
            sink_.row(y, row.data());
        }
    }

private:
    static void on_error(png_structp png, png_const_charp text) {
        auto& self = *static_cast<PngReader*>(png_get_error_ptr(png));
        std::strncpy(self.text_, text, sizeof(self.text_) - 1);
        std::longjmp(self.back_, 1); // NOLINT(modernize-avoid-setjmp-longjmp,cert-err52-cpp)
    }
    // Warnings are about colour profiles and text, which are not used here; damaged data is an error.
    static void on_warning(png_structp, png_const_charp) {}

    static void give(png_structp png, png_bytep to, std::size_t count) {
        auto& self = *static_cast<PngReader*>(png_get_io_ptr(png));
        if (count > self.bytes_.size() - self.at_) {
            self.cut_ = true;
            png_error(png, "the file ends there");
        }
        std::memcpy(to, self.bytes_.data() + self.at_, count);
        self.at_ += count;
    }

    [[nodiscard]] RowFormat format() const {
        return {png_get_channels(png_, info_), png_get_bit_depth(png_, info_)};
    }

    bool begin() {
        if (setjmp(back_) != 0) { // NOLINT(cert-err52-cpp)
            return false;
        }
        png_set_read_fn(png_, this, give);
        png_read_info(png_, info_);
        png_set_expand(png_);
        if (std::endian::native == std::endian::little) {
            png_set_swap(png_);
        }
        int unit = PNG_RESOLUTION_UNKNOWN;
        if (png_get_pHYs(png_, info_, &across_, &down_, &unit) != 0) {
            in_metres_ = unit == PNG_RESOLUTION_METER;
        }
        passes_ = png_set_interlace_handling(png_);
        png_read_update_info(png_, info_);
        return true;
    }

    bool read_row_into(png_bytep row) {
        if (setjmp(back_) != 0) { // NOLINT(cert-err52-cpp)
            return false;
        }
        png_read_row(png_, row, nullptr);
        return true;
    }

    void read_row(png_bytep row, int y) {
        if (!read_row_into(row)) {
            fail(fmt::format("row {}", y + 1));
        }
    }

    void read_interlaced(int height, std::size_t stride, int passes) {
        const std::size_t size = stride * static_cast<std::size_t>(height);
        sink_.allow_memory(static_cast<std::int64_t>(size), "an interlaced PNG");
        std::vector<png_byte> rows(size);
        for (int pass = 0; pass < passes; ++pass) {
            for (int y = 0; y < height; ++y) {
                read_row(rows.data() + stride * static_cast<std::size_t>(y), y);
            }
        }
        for (int y = 0; y < height; ++y) {
            sink_.row(y, rows.data() + stride * static_cast<std::size_t>(y));
        }
    }

    [[noreturn]] void fail(const std::string& where) const {
        if (cut_) {
            sink_.fail(fmt::format(
                "the PNG ends too early, after {} bytes: {} is incomplete", bytes_.size(), where));
        }
        sink_.fail(fmt::format("the PNG is damaged at {}: {} (byte {})", where, text_, at_));
    }

    std::string_view bytes_;
    std::size_t at_ = 0;
    RowSink& sink_;
    png_structp png_ = nullptr;
    png_infop info_ = nullptr;
    std::jmp_buf back_ = {};
    char text_[160] = {};
    int passes_ = 1;
    bool cut_ = false;       ///< more was asked for than there is
    png_uint_32 across_ = 0; ///< pixels per metre, or of any unit; 0: not said
    png_uint_32 down_ = 0;   ///< the same of rows
    bool in_metres_ = false;
};

} // namespace

void read_png_rows(std::string_view bytes, RowSink& sink) {
    PngReader(bytes, sink).read();
}

} // namespace millwright::plot::internal
