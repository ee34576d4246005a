// What a machine says, line by line.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace millwright::machine {

class AnswerLines {
public:
    void add(std::string_view bytes) { inbox_ += bytes; }
    /// Forgets what came and is no whole line yet.
    void clear() { inbox_.clear(); }
    /// The next whole line, without blanks around it; those without anything else are passed over.
    [[nodiscard]] std::optional<std::string> next();

private:
    std::string inbox_;
};

} // namespace millwright::machine
