#include "core/plot/picture/picture.h"

#include "core/base/file_snapshot.h"
#include "core/plot/picture/internal/row_sink.h"

namespace millwright::plot {

ReadPicture read_picture(std::string_view bytes,
                         const std::filesystem::path& file,
                         const PictureSettings& settings,
                         const Progress& progress) {
    internal::RowSink sink(settings, file, progress);
    if (bytes.starts_with("\x89PNG\r\n\x1a\n")) {
        internal::read_png_rows(bytes, sink);
    } else if (bytes.starts_with("\xff\xd8")) {
        internal::read_jpeg_rows(bytes, sink);
    } else if (bytes.starts_with("BM")) {
        internal::read_bmp_rows(bytes, sink);
    } else {
        sink.fail(bytes.empty() ? "the file is empty" : "this is no picture that can be read",
                  "PNG, JPEG and BMP files can be read");
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
