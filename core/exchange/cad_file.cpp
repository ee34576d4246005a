#include "core/exchange/cad_file.h"

#include "core/exchange/internal/file_kind.h"

#include <algorithm>
#include <array>
#include <string_view>

namespace millwright::exchange {

bool is_cad_file(const std::filesystem::path& file) {
    constexpr std::array<std::string_view, 4> kinds{"step", "stp", "iges", "igs"};
    return std::ranges::find(kinds, kind_of(file)) != kinds.end();
}

} // namespace millwright::exchange
