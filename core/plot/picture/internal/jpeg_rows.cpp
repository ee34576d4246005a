// JPEG by libjpeg-turbo, row by row.
#include "core/plot/picture/internal/row_sink.h"

#include <fmt/format.h>
#include <jerror.h>
#include <jpeglib.h>

#include <csetjmp>
#include <cstdio> // jpeglib.h needs it before

namespace millwright::plot::internal {
namespace {

constexpr int most_scans = 200; // a progressive file of thousands of them is made to waste time

/// libjpeg's errors leave by longjmp: each member that calls it jumps back to itself, over no object that
/// would have to be destroyed.
class JpegReader {
public:
    JpegReader(std::string_view bytes, RowSink& sink) : bytes_(bytes), sink_(sink) {
        jpeg_.err = jpeg_std_error(&errors_);
        jpeg_.client_data = this;
        errors_.error_exit = on_error;
        errors_.emit_message = on_message;
        progress_.progress_monitor = on_progress;
    }
    JpegReader(const JpegReader&) = delete;
    JpegReader& operator=(const JpegReader&) = delete;
    ~JpegReader() { jpeg_destroy_decompress(&jpeg_); }

    void read() {
        if (!read_head()) {
            fail("its header");
        }
        if (jpeg_has_multiple_scans(&jpeg_) != 0) {
            sink_.allow_memory(coefficient_bytes(), "a progressive JPEG");
        }
        const bool inks = jpeg_.out_color_space == JCS_CMYK;
        const int channels = jpeg_.out_color_space == JCS_GRAYSCALE ? 1 : 3;
        sink_.begin(jpeg_.image_width, jpeg_.image_height, {channels, 8});
        say_density();
        if (inks) {
            sink_.notice("four inks (CMYK) are converted without a colour profile");
        }
        if (!start()) {
            fail("its first rows");
        }
        const auto height = static_cast<int>(jpeg_.output_height);
        std::vector<JSAMPLE> row(std::size_t{jpeg_.output_width} *
                                 static_cast<std::size_t>(jpeg_.output_components));
        for (int y = 0; y < height && !sink_.over_at(y); ++y) {
            if (!read_row(row.data())) {
                fail(fmt::format("row {}", y + 1));
            }
            if (inks) {
                mix_inks(row);
            }
            sink_.row(y, row.data());
        }
    }

private:
    static JpegReader& of(j_common_ptr jpeg) { return *static_cast<JpegReader*>(jpeg->client_data); }

    [[noreturn]] static void leave(JpegReader& self) {
        self.errors_.format_message(reinterpret_cast<j_common_ptr>(&self.jpeg_), self.text_);
        std::longjmp(self.back_, 1); // NOLINT(modernize-avoid-setjmp-longjmp,cert-err52-cpp)
    }
    static void on_error(j_common_ptr jpeg) { leave(of(jpeg)); }
    // libjpeg warns of damaged data and goes on in gray. A machine must not cut that.
    static void on_message(j_common_ptr jpeg, int level) {
        const bool harmless =
            jpeg->err->msg_code == JWRN_EXTRANEOUS_DATA || jpeg->err->msg_code == JWRN_ADOBE_XFORM;
        if (level < 0 && !harmless) {
            leave(of(jpeg));
        }
    }
    static void on_progress(j_common_ptr jpeg) {
        JpegReader& self = of(jpeg);
        if (self.jpeg_.input_scan_number > most_scans) {
            std::snprintf(self.text_, sizeof(self.text_), "more than %d scans", most_scans);
            std::longjmp(self.back_, 1); // NOLINT(modernize-avoid-setjmp-longjmp,cert-err52-cpp)
        }
    }

    bool read_head() {
        if (setjmp(back_) != 0) { // NOLINT(cert-err52-cpp)
            return false;
        }
        jpeg_create_decompress(&jpeg_);
        jpeg_.client_data = this;
        jpeg_.progress = &progress_;
        jpeg_mem_src(&jpeg_, reinterpret_cast<const unsigned char*>(bytes_.data()), bytes_.size());
        jpeg_read_header(&jpeg_, TRUE);
        switch (jpeg_.jpeg_color_space) {
        case JCS_GRAYSCALE:
            jpeg_.out_color_space = JCS_GRAYSCALE;
            break;
        case JCS_CMYK:
        case JCS_YCCK:
            jpeg_.out_color_space = JCS_CMYK;
            break;
        default:
            jpeg_.out_color_space = JCS_RGB;
            break;
        }
        return true;
    }

    bool start() {
        if (setjmp(back_) != 0) { // NOLINT(cert-err52-cpp)
            return false;
        }
        jpeg_start_decompress(&jpeg_);
        return true;
    }

    bool read_row(JSAMPROW row) {
        if (setjmp(back_) != 0) { // NOLINT(cert-err52-cpp)
            return false;
        }
        jpeg_read_scanlines(&jpeg_, &row, 1);
        return true;
    }

    [[nodiscard]] std::int64_t coefficient_bytes() const {
        std::int64_t bytes = 0;
        for (int n = 0; n < jpeg_.num_components; ++n) {
            const jpeg_component_info& component = jpeg_.comp_info[n];
            bytes += std::int64_t{component.width_in_blocks} * component.height_in_blocks *
                     static_cast<std::int64_t>(sizeof(JBLOCK));
        }
        return bytes;
    }

    void say_density() {
        constexpr double mm_per_inch = 25.4;
        constexpr double mm_per_cm = 10.0;
        if (jpeg_.density_unit == 1) {
            sink_.set_pixels_per_mm(jpeg_.X_density / mm_per_inch, jpeg_.Y_density / mm_per_inch);
        } else if (jpeg_.density_unit == 2) {
            sink_.set_pixels_per_mm(jpeg_.X_density / mm_per_cm, jpeg_.Y_density / mm_per_cm);
        } else {
            sink_.set_pixel_shape(jpeg_.X_density, jpeg_.Y_density);
        }
    }

    /// Four samples per pixel become three in place. Adobe's files have 255 for no ink, others 0.
    void mix_inks(std::vector<JSAMPLE>& row) const {
        constexpr int most = MAXJSAMPLE;
        const bool inverted = jpeg_.saw_Adobe_marker != 0;
        for (std::size_t n = 0; 4 * n < row.size(); ++n) {
            const auto bare = [&](std::size_t ink) {
                const int sample = row[4 * n + ink];
                return inverted ? sample : most - sample;
            };
            const int black = bare(3);
            for (std::size_t color = 0; color < 3; ++color) {
                row[3 * n + color] = static_cast<JSAMPLE>((bare(color) * black + most / 2) / most);
            }
        }
    }

    [[noreturn]] void fail(const std::string& where) const {
        sink_.fail(fmt::format("the JPEG cannot be read at {}: {}", where, text_));
    }

    std::string_view bytes_;
    RowSink& sink_;
    jpeg_decompress_struct jpeg_ = {};
    jpeg_error_mgr errors_ = {};
    jpeg_progress_mgr progress_ = {};
    std::jmp_buf back_ = {};
    char text_[JMSG_LENGTH_MAX] = {};
};

} // namespace

void read_jpeg_rows(std::string_view bytes, RowSink& sink) {
    JpegReader(bytes, sink).read();
}

} // namespace millwright::plot::internal
