// A running millwright-cad.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace millwright::exchange {

class CadChild {
public:
    /// With `input` on its standard input. Throws Error about `file` if it cannot be started.
    CadChild(std::vector<std::string> arguments, std::string_view input, const std::filesystem::path& file);
    CadChild(const CadChild&) = delete;
    CadChild& operator=(const CadChild&) = delete;
    ~CadChild(); ///< kills it if it still runs

    /// Appends what it has said, waiting for it at most 20 ms. False once it says no more.
    [[nodiscard]] bool listen(std::string& stream);
    /// Waits for its end. Empty if that was as it should be, else how it ended, as a sentence's rest.
    [[nodiscard]] std::string end();

private:
    pid_t child_ = -1;
    int said_ = -1;
};

} // namespace millwright::exchange
