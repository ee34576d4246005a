// A running millwright-cad.
#pragma once

#include <sys/types.h>

#include <filesystem>
#include <string>

namespace millwright::exchange {

class CadChild {
public:
    /// Throws Error if it cannot be started.
    explicit CadChild(const std::filesystem::path& file);
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
