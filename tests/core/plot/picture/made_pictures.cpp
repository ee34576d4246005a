#include "tests/core/plot/picture/made_pictures.h"

#include <jpeglib.h>
#include <png.h>

#include <cstdio> // jpeglib.h needs it before
#include <cstdlib>
#include <random>

namespace millwright::plot {

Samples noise(int width, int height, int channels, int bits) {
    std::mt19937 random(81);
    std::uniform_int_distribution<int> value(0, (1 << bits) - 1);
    Samples samples{width, height, channels, {}};
    for (int n = 0; n < width * height * channels; ++n) {
        samples.values.push_back(static_cast<std::uint16_t>(value(random)));
    }
    return samples;
}

namespace {

/// The samples of a row as PNG packs them: big end first, less than 8 bits from the high end.
std::vector<png_byte> packed_row(const Samples& samples, int row, int bits) {
    const int count = samples.width * samples.channels;
    std::vector<png_byte> bytes(static_cast<std::size_t>((count * bits + 7) / 8));
    for (int n = 0; n < count; ++n) {
        const std::uint32_t value = samples.values[static_cast<std::size_t>(row * count + n)];
        const auto bit = static_cast<std::size_t>(n * bits);
        if (bits == 16) {
            bytes[bit / 8] = static_cast<png_byte>(value >> 8U);
            bytes[bit / 8 + 1] = static_cast<png_byte>(value);
        } else {
            bytes[bit / 8] =
                static_cast<png_byte>(bytes[bit / 8] | value << (8U - static_cast<unsigned>(bits) - bit % 8));
        }
    }
    return bytes;
}

int color_type(const Samples& samples, const PngKind& kind) {
    constexpr int types[] = {
        PNG_COLOR_TYPE_GRAY, PNG_COLOR_TYPE_GRAY_ALPHA, PNG_COLOR_TYPE_RGB, PNG_COLOR_TYPE_RGBA};
    return kind.palette ? PNG_COLOR_TYPE_PALETTE : types[samples.channels - 1];
}

void append(png_structp png, png_bytep bytes, std::size_t count) {
    static_cast<std::string*>(png_get_io_ptr(png))->append(reinterpret_cast<const char*>(bytes), count);
}

} // namespace

void append_little_endian(std::string& bytes, std::uint32_t value, int count) {
    for (int n = 0; n < count; ++n) {
        bytes.push_back(static_cast<char>(value));
        value >>= 8U;
    }
}

std::string png_of(const Samples& samples, const PngKind& kind) {
    std::string bytes;
    png_structp png = png_create_write_struct(PNG_LIBPNG_VER_STRING, nullptr, nullptr, nullptr);
    png_infop info = png_create_info_struct(png);
    png_set_write_fn(png, &bytes, append, nullptr);
    png_set_IHDR(png,
                 info,
                 static_cast<png_uint_32>(samples.width),
                 static_cast<png_uint_32>(samples.height),
                 kind.bits,
                 color_type(samples, kind),
                 kind.interlaced ? PNG_INTERLACE_ADAM7 : PNG_INTERLACE_NONE,
                 PNG_COMPRESSION_TYPE_DEFAULT,
                 PNG_FILTER_TYPE_DEFAULT);
    if (kind.palette) {
        std::vector<png_color> palette(std::size_t{1} << static_cast<unsigned>(kind.bits));
        for (std::size_t n = 0; n < palette.size(); ++n) {
            const auto gray = static_cast<png_byte>(255 - n);
            palette[n] = {gray, gray, gray};
        }
        png_set_PLTE(png, info, palette.data(), static_cast<int>(palette.size()));
    }
    if (kind.pixels_per_metre > 0) {
        const auto density = static_cast<png_uint_32>(kind.pixels_per_metre);
        const auto rows = kind.rows_per_metre > 0 ? static_cast<png_uint_32>(kind.rows_per_metre) : density;
        png_set_pHYs(
            png, info, density, rows, kind.in_metres ? PNG_RESOLUTION_METER : PNG_RESOLUTION_UNKNOWN);
    }
    std::vector<std::vector<png_byte>> rows;
    std::vector<png_bytep> starts;
    for (int row = 0; row < samples.height; ++row) {
        rows.push_back(packed_row(samples, row, kind.bits));
        starts.push_back(rows.back().data());
    }
    png_set_rows(png, info, starts.data());
    png_write_png(png, info, PNG_TRANSFORM_IDENTITY, nullptr);
    png_destroy_write_struct(&png, &info);
    return bytes;
}

std::string jpeg_of(const Samples& samples, const JpegKind& kind) {
    jpeg_compress_struct jpeg = {};
    jpeg_error_mgr errors = {};
    jpeg.err = jpeg_std_error(&errors);
    jpeg_create_compress(&jpeg);
    unsigned char* data = nullptr;
    unsigned long size = 0;
    jpeg_mem_dest(&jpeg, &data, &size);
    jpeg.image_width = static_cast<JDIMENSION>(samples.width);
    jpeg.image_height = static_cast<JDIMENSION>(samples.height);
    jpeg.input_components = samples.channels;
    jpeg.in_color_space = samples.channels == 1 ? JCS_GRAYSCALE : samples.channels == 3 ? JCS_RGB : JCS_CMYK;
    jpeg_set_defaults(&jpeg);
    jpeg_set_quality(&jpeg, 95, TRUE);
    if (samples.channels == 4) {
        jpeg.write_Adobe_marker = kind.adobe ? TRUE : FALSE;
    }
    if (kind.progressive) {
        jpeg_simple_progression(&jpeg);
    }
    if (kind.dots_per_inch > 0) {
        jpeg.density_unit = 1;
        jpeg.X_density = static_cast<UINT16>(kind.dots_per_inch);
        jpeg.Y_density = kind.rows_per_inch > 0 ? static_cast<UINT16>(kind.rows_per_inch) : jpeg.X_density;
    }
    jpeg_start_compress(&jpeg, TRUE);
    const auto stride = static_cast<std::size_t>(samples.width * samples.channels);
    for (std::size_t row = 0; row < static_cast<std::size_t>(samples.height); ++row) {
        std::vector<JSAMPLE> line;
        for (std::size_t n = 0; n < stride; ++n) {
            line.push_back(static_cast<JSAMPLE>(samples.values[row * stride + n]));
        }
        JSAMPROW start = line.data();
        jpeg_write_scanlines(&jpeg, &start, 1);
    }
    jpeg_finish_compress(&jpeg);
    std::string bytes(reinterpret_cast<const char*>(data), size);
    jpeg_destroy_compress(&jpeg);
    std::free(data); // NOLINT(cppcoreguidelines-no-malloc): libjpeg's own
    return bytes;
}

namespace {} // namespace

std::string bmp_of(const Samples& samples, int bits, bool top_down) {
    std::string bytes = "BM";
    append_little_endian(bytes, 0, 8);
    append_little_endian(bytes, 54, 4);
    append_little_endian(bytes, 40, 4);
    append_little_endian(bytes, static_cast<std::uint32_t>(samples.width), 4);
    append_little_endian(bytes, static_cast<std::uint32_t>(top_down ? -samples.height : samples.height), 4);
    append_little_endian(bytes, 1, 2);
    append_little_endian(bytes, static_cast<std::uint32_t>(bits), 2);
    append_little_endian(bytes, 0, 4 * 6);
    for (int line = 0; line < samples.height; ++line) {
        const int row = top_down ? line : samples.height - 1 - line;
        for (int x = 0; x < samples.width; ++x) {
            for (int color = 2; color >= 0; --color) {
                append_little_endian(
                    bytes,
                    samples.values[static_cast<std::size_t>((row * samples.width + x) * 3 + color)],
                    1);
            }
            append_little_endian(bytes, 0, bits / 8 - 3);
        }
        while ((bytes.size() - 54) % 4 != 0) {
            bytes.push_back('\0');
        }
    }
    return bytes;
}

} // namespace millwright::plot
