#include "core/plot/picture/picture.h"

#include "core/base/file_snapshot.h"
#include "core/plot/picture/internal/exif.h"
#include "core/plot/picture/internal/row_sink.h"

namespace millwright::plot {

namespace {

/// Cameras lay their pictures down as they were held, and say so.
ReadPicture read_turned(std::string_view bytes,
                        const std::filesystem::path& file,
                        PictureSettings settings,
                        const Progress& progress,
                        const internal::PictureTurn& turn,
                        void (*read_rows)(std::string_view bytes, internal::RowSink& sink)) {
    if (settings.region && turn.orientation != 1) {
        settings.region = internal::region_in_file(*settings.region, turn);
    }
    internal::RowSink sink(settings, file, progress);
    read_rows(bytes, sink);
    ReadPicture read = sink.end();
    if (turn.orientation != 1) {
        read.picture = internal::turned(read.picture, turn.orientation);
    }
    return read;
}

} // namespace

ReadPicture read_picture(std::string_view bytes,
                         const std::filesystem::path& file,
                         const PictureSettings& settings,
                         const Progress& progress) {
    if (bytes.starts_with("\xff\xd8")) {
        return read_turned(
            bytes, file, settings, progress, internal::jpeg_turn(bytes), internal::read_jpeg_rows);
    }
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) {
        return read_turned(
            bytes, file, settings, progress, internal::png_turn(bytes), internal::read_png_rows);
    }
    internal::RowSink sink(settings, file, progress);
    if (bytes.starts_with("BM")) {
        internal::read_bmp_rows(bytes, sink);
    } else if (bytes.starts_with("P5") || bytes.starts_with("P6")) {
        internal::read_pnm_rows(bytes, sink);
    } else {
        sink.fail(bytes.empty() ? "the file is empty" : "this is no picture that can be read",
                  "PNG, JPEG, BMP, PGM and PPM files can be read");
    }
    return sink.end();
}

ReadPicture read_picture_file(const std::filesystem::path& file,
                              const PictureSettings& settings,
                              const Progress& progress) {
    const FileSnapshot bytes(file, progress);
    return read_picture(bytes.text(), file, settings, progress);
}

} // namespace millwright::plot
