// What a machine says, line by line.
#pragma once

#include <cstddef>
#include <optional>
#include <string>
#include <string_view>

namespace millwright::drivers {

class AnswerLines {
public:
    void add(std::string_view bytes) { inbox_ += bytes; }
    /// Forgets what came and is no whole line yet.
    void clear() {
        inbox_.clear();
        begin_ = 0;
    }
    /// The next whole line, without blanks around it; those without anything else are passed over.
    [[nodiscard]] std::optional<std::string> next();

private:
    std::string inbox_;
    std::size_t begin_ = 0; ///< of what is not taken yet
};

} // namespace millwright::drivers
