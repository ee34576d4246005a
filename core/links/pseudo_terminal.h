// The far end of a simulated serial port: a pseudo-terminal, whose near end programs open like a port.
#pragma once

#include "core/links/link.h"

#include <filesystem>

namespace millwright::links {

/// Served by whoever opens it, used through path(). Programs come and go without the link being lost.
class PseudoTerminal final : public Link {
public:
    /// `symlink`, if not empty, will point to the terminal while it is open.
    explicit PseudoTerminal(std::filesystem::path symlink = {});
    PseudoTerminal(const PseudoTerminal&) = delete;
    PseudoTerminal& operator=(const PseudoTerminal&) = delete;
    ~PseudoTerminal() override;

    /// Of the near end, once open.
    [[nodiscard]] std::filesystem::path path() const;
    [[nodiscard]] std::string name() const override;
    /// A symbolic link that leads nowhere is replaced. Throws Error for anything else that stands in the
    /// way: of a link to another terminal it says which program holds that, where the system tells.
    void open() override;
    void write(std::string_view bytes) override;
    [[nodiscard]] std::string read() override;
    void wait(double seconds) override;
    [[nodiscard]] std::optional<std::string> lost() const override;
    void close() noexcept override;

private:
    struct Port;
    void make_symlink();

    std::filesystem::path symlink_;
    std::string near_end_;
    int near_handle_ = -1; ///< kept open, so that the far end survives the programs that come and go
    std::unique_ptr<Port> port_;
};

} // namespace millwright::links
