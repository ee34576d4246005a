#include "app/ranks.h"
#include "core/base/error.h"

#include <mpi.h>

#include <cstdlib>

namespace millwright::app {

namespace {

constexpr int tag = 0;

/// A process alone does not wait for the daemons of MPI.
bool started_by_mpirun() {
    return std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr || std::getenv("PMI_SIZE") != nullptr;
}

} // namespace

Ranks::Ranks() {
    if (!started_by_mpirun()) {
        return;
    }
    int given = 0;
    if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given) != MPI_SUCCESS ||
        given < MPI_THREAD_FUNNELED) {
        throw Error("MPI does not start, or not beside threads");
    }
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

Ranks::~Ranks() {
    int begun = 0;
    MPI_Initialized(&begun);
    if (begun != 0) {
        MPI_Finalize();
    }
}

void Ranks::tell(std::string_view message) const {
    expects(rank_ != 0, "rank 0 is told, it does not tell");
    MPI_Send(message.data(), static_cast<int>(message.size()), MPI_CHAR, 0, tag, MPI_COMM_WORLD);
}

void Ranks::tell_all(std::string_view message) const {
    expects(rank_ == 0, "rank 0 tells all");
    for (int to = 1; to < size_; ++to) {
        MPI_Send(message.data(), static_cast<int>(message.size()), MPI_CHAR, to, tag, MPI_COMM_WORLD);
    }
}

std::optional<Ranks::Message> Ranks::heard() const {
    if (size_ == 1) {
        return std::nullopt;
    }
    int waiting = 0;
    MPI_Status status;
    MPI_Iprobe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &waiting, &status);
    if (waiting == 0) {
        return std::nullopt;
    }
    int length = 0;
    MPI_Get_count(&status, MPI_CHAR, &length);
    Message message{status.MPI_SOURCE, std::string(static_cast<std::size_t>(length), '\0')};
    MPI_Recv(
        message.text.data(), length, MPI_CHAR, status.MPI_SOURCE, tag, MPI_COMM_WORLD, MPI_STATUS_IGNORE);
    return message;
}

} // namespace millwright::app
