#include "core/exchange/internal/file_kind.h"

#include <algorithm>
#include <cctype>

namespace millwright::exchange {

std::string kind_of(const std::filesystem::path& file) {
    std::string kind = file.extension().string();
    std::ranges::transform(kind, kind.begin(), [](unsigned char c) { return std::tolower(c); });
    return kind.empty() ? kind : kind.substr(1);
}

} // namespace millwright::exchange
