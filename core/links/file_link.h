// A link that ends in a file: what is written is kept, and nothing comes back.
#pragma once

#include "core/links/link.h"

#include <filesystem>
#include <fstream>
#include <mutex>
#include <utility>

namespace millwright::links {

class FileLink final : public Link {
public:
    explicit FileLink(std::filesystem::path file) : file_(std::move(file)) {}

    [[nodiscard]] std::string name() const override { return "file:" + file_.string(); }
    /// Begins the file anew. Throws Error if it cannot be written.
    void open() override;
    void write(std::string_view bytes) override;
    [[nodiscard]] std::string read() override { return {}; }
    void wait(double seconds) override;
    [[nodiscard]] std::optional<std::string> lost() const override;
    void close() noexcept override;

private:
    std::filesystem::path file_;
    mutable std::mutex mutex_; ///< guards what follows
    std::ofstream out_;
    bool failed_ = false;
};

} // namespace millwright::links
