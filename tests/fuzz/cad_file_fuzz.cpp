// Any bytes are either faces with sound patches, or an Error about the file.
#include "core/exchange/cad_file.h"

#include "core/base/error.h"

#include <unistd.h>

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <fstream>
#include <string>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace millwright;
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    const char* const kind = bytes.starts_with("ISO") ? ".step" : ".igs";
    const auto file =
        std::filesystem::temp_directory_path() / ("cad_file_fuzz_" + std::to_string(getpid()) + kind);
    std::ofstream(file, std::ios::binary) << bytes;
    try {
        const exchange::CadModel model = exchange::read_cad(file, {});
        expects(!model.faces.empty(), "a model has faces");
        for (const exchange::CadFace& face : model.faces) {
            expects(std::ssize(face.patches) == std::ptrdiff_t{face.rows} * face.columns,
                    "a face is a raster");
        }
    } catch (const Error& error) {
        expects(error.diagnostic().place.file == file, "an error of a file names it");
    }
    std::filesystem::remove(file);
    return 0;
}
