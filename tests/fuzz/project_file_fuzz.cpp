// Any bytes are either a project, which is written and read back as the same, or an Error about the file.
#include "core/project/project_file.h"

#include "core/base/error.h"

#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace millwright::project;
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    try {
        const Project project = project_from_text(text, "fuzz.json");
        millwright::expects(project_from_text(project_text(project), "again.json") == project,
                            "a project that was read is written and read back as the same");
    } catch (const millwright::Error& error) {
        millwright::expects(error.diagnostic().place.file == "fuzz.json",
                            "an error names the file that was read");
    }
    return 0;
}
