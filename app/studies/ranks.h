// The processes of one `mpirun`, which share a piece of work. Started otherwise, or in a build without MPI,
// there is one: rank 0.
#pragma once

#include <memory>
#include <optional>
#include <string>
#include <string_view>

namespace millwright::app {

/// One at a time in a process.
class Ranks {
public:
    /// Joins the others. Throws Error if mpirun started several and this build has no MPI.
    Ranks();
    Ranks(const Ranks&) = delete;
    Ranks& operator=(const Ranks&) = delete;
    ~Ranks(); ///< lets the others go, and waits for them

    [[nodiscard]] int rank() const { return rank_; }
    [[nodiscard]] int size() const { return size_; }

    /// From another rank to rank 0. Never waits for one that may be gone: what is left to do is done by
    /// heard(), as with every message.
    void tell(std::string_view message) const;

    struct Message {
        int from = 0;
        std::string text;
    };
    /// From rank 0 to every other; never empty.
    void tell_all(std::string_view message) const;
    /// Rank 0 tells all, with an empty message, that it is there and that there is nothing more to do for
    /// them. Once: then nothing.
    void let_go() const;
    /// The next one that has come whole, nothing if none has. Never waits either.
    [[nodiscard]] std::optional<Message> heard() const;

private:
    struct UnderWay;
    std::unique_ptr<UnderWay> under_way_;
    int rank_ = 0;
    int size_ = 1;
};

} // namespace millwright::app
