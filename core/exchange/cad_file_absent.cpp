// In a build without Open CASCADE: says so.
#include "core/base/error.h"
#include "core/exchange/cad_file.h"

namespace millwright::exchange {

namespace {

[[noreturn]] void refuse(const std::filesystem::path& file) {
    throw Error("this build has no Open CASCADE: STEP and IGES files can be neither read nor written",
                file,
                "install libocct-data-exchange-dev, then rebuild");
}

} // namespace

bool reads_cad_files() {
    return false;
}

CadModel read_cad(const std::filesystem::path& file, const Progress&) {
    refuse(file);
}

void write_step(const geometry::Surface&, const std::filesystem::path& file, const Progress&) {
    refuse(file);
}

} // namespace millwright::exchange
