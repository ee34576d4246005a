// Any bytes are either a machine, or an Error about the file.
#include "core/kinematics/machine_file.h"

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
    const auto file =
        std::filesystem::temp_directory_path() / ("machine_file_fuzz_" + std::to_string(getpid()) + ".json");
    std::ofstream(file, std::ios::binary) << std::string_view(reinterpret_cast<const char*>(data), size);
    try {
        static_cast<void>(millwright::kinematics::read_machine(file));
    } catch (const millwright::Error& error) {
        millwright::expects(error.diagnostic().place.file == file,
                            "an error of a machine file names the file");
    }
    std::filesystem::remove(file);
    return 0;
}
