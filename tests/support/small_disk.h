// A real disk of 64 KiB in memory, for what happens when a disk is full. Only root can make one.
#pragma once

#include <sys/mount.h>

#include <array>
#include <filesystem>
#include <fstream>
#include <utility>

namespace millwright::test {

class SmallDisk {
public:
    /// At `folder`, which is made where missing; gone with its files at the end.
    explicit SmallDisk(std::filesystem::path folder) : folder_(std::move(folder)) {
        std::filesystem::create_directories(folder_);
        mounted_ = ::mount("none", folder_.c_str(), "tmpfs", 0, "size=64k") == 0;
    }
    SmallDisk(const SmallDisk&) = delete;
    SmallDisk& operator=(const SmallDisk&) = delete;
    ~SmallDisk() {
        if (mounted_) {
            ::umount2(folder_.c_str(), MNT_DETACH);
        }
    }

    /// False where the test may make none.
    [[nodiscard]] bool mounted() const { return mounted_; }

    void fill() const {
        std::ofstream filler(folder_ / "filler", std::ios::binary);
        constexpr std::array<char, 512> piece{};
        while (filler.write(piece.data(), piece.size()).flush()) {
        }
    }

private:
    std::filesystem::path folder_;
    bool mounted_ = false;
};

} // namespace millwright::test
