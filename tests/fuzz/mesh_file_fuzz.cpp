// Any bytes are either a mesh of finite points and sound triangles, or an Error about the file.
#include "core/exchange/mesh_file.h"

#include "core/base/error.h"

#include <array>
#include <cstddef>
#include <cstdint>
#include <string_view>

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace millwright;
    constexpr std::array<const char*, 3> names{"part.stl", "part.obj", "part.ply"};
    const std::string_view bytes(reinterpret_cast<const char*>(data), size);
    for (const char* const name : names) {
        try {
            const exchange::MeshFile read = exchange::parse_mesh(bytes, name, 1.0, {});
            expects(!read.mesh.triangles.empty(), "a mesh has triangles");
            for (std::size_t n = 0; n < read.mesh.triangles.size(); ++n) {
                expects(is_finite(read.mesh.doubled_area(n)), "an area is finite");
            }
        } catch (const Error& error) {
            expects(error.diagnostic().place.file == name, "an error of a mesh names the file");
        }
    }
    return 0;
}
