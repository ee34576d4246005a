#include "tests/app/sending.h"

#include <nlohmann/json.hpp>

#include <sstream>

namespace millwright::test {

nlohmann::json last_record(const std::filesystem::path& folder) {
    nlohmann::json last;
    for (const auto& entry : std::filesystem::directory_iterator(folder)) {
        if (entry.path().extension() != ".jsonl") {
            continue;
        }
        std::istringstream text(content_of(entry.path()));
        for (std::string line; std::getline(text, line);) {
            last = nlohmann::json::parse(line);
        }
    }
    return last;
}

} // namespace millwright::test
