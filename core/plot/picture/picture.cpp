#include "core/plot/picture/picture.h"

#include "core/base/file_snapshot.h"
#include "core/plot/picture/file_pixels.h"
#include "core/plot/picture/internal/exif.h"
#include "core/plot/picture/internal/row_sink.h"
#include "core/plot/picture/internal/square_pixels.h"

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <utility>

namespace millwright::plot {

namespace {

using internal::PixelShape;

/// Cameras lay their pictures down as they were held, and say so.
ReadPicture read_turned(std::string_view bytes,
                        const std::filesystem::path& file,
                        PictureSettings settings,
                        const Progress& progress,
                        PixelShape& shape,
                        const internal::PictureTurn& turn,
                        void (*read_rows)(std::string_view bytes, internal::RowSink& sink)) {
    if (settings.region && turn.orientation != 1) {
        settings.region = internal::region_in_file(*settings.region, turn);
    }
    internal::RowSink sink(settings, file, progress);
    read_rows(bytes, sink);
    ReadPicture read = sink.end(shape);
    if (turn.orientation != 1) {
        read.picture = internal::turned(read.picture, turn.orientation);
    }
    if (internal::lies(turn.orientation)) {
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
            bytes, file, settings, progress, shape, internal::jpeg_turn(bytes), internal::read_jpeg_rows);
    }
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) {
        return read_turned(
            bytes, file, settings, progress, shape, internal::png_turn(bytes), internal::read_png_rows);
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

} // namespace millwright::plot
