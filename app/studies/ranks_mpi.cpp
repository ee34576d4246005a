#include "app/studies/ranks.h"
#include "core/base/error.h"

#include <mpi.h>

#include <cstdlib>
#include <list>
#include <utility>

namespace millwright::app {

namespace {

constexpr int tag = 0;

/// A process alone does not wait for the daemons of MPI.
bool started_by_mpirun() {
    return std::getenv("OMPI_COMM_WORLD_SIZE") != nullptr || std::getenv("PMI_SIZE") != nullptr;
}

/// A message that MPI reads or writes. The text stays where it is until the request is done.
struct Transfer {
    std::string text;
    MPI_Request request = MPI_REQUEST_NULL;
    int from = 0;
};

bool ended(Transfer& transfer) {
    int done = 0;
    MPI_Test(&transfer.request, &done, MPI_STATUS_IGNORE);
    return done != 0;
}

} // namespace

struct Ranks::UnderWay {
    std::list<Transfer> sent;         // a list, whose elements stay where they are
    std::unique_ptr<Transfer> coming; // one at a time, so that messages stay in their order
    bool let_go = false;

    void send(std::string_view message, int to) {
        Transfer& leaving = sent.emplace_back();
        leaving.text = message;
        MPI_Isend(leaving.text.data(),
                  static_cast<int>(leaving.text.size()),
                  MPI_CHAR,
                  to,
                  tag,
                  MPI_COMM_WORLD,
                  &leaving.request);
    }
};

Ranks::Ranks() : under_way_(std::make_unique<UnderWay>()) {
    if (!started_by_mpirun()) {
        return;
    }
    int given = 0;
    if (MPI_Init_thread(nullptr, nullptr, MPI_THREAD_FUNNELED, &given) != MPI_SUCCESS ||
        given < MPI_THREAD_FUNNELED) {
        throw Error("MPI did not start, or does not support threads");
    }
    MPI_Comm_rank(MPI_COMM_WORLD, &rank_);
    MPI_Comm_size(MPI_COMM_WORLD, &size_);
}

Ranks::~Ranks() {
    int begun = 0;
    MPI_Initialized(&begun);
    if (begun != 0) {
        if (rank_ == 0) {
            let_go();
        }
        for (Transfer& transfer : under_way_->sent) {
            MPI_Wait(&transfer.request, MPI_STATUS_IGNORE);
        }
        MPI_Finalize();
    }
}

void Ranks::tell(std::string_view message) const {
    expects(rank_ != 0, "rank 0 receives messages, it does not send them");
    under_way_->send(message, 0);
}

void Ranks::tell_all(std::string_view message) const {
    expects(rank_ == 0, "only rank 0 sends to all");
    expects(!message.empty() && !under_way_->let_go, "an empty message releases the other ranks");
    for (int to = 1; to < size_; ++to) {
        under_way_->send(message, to);
    }
}

void Ranks::let_go() const {
    expects(rank_ == 0, "only rank 0 releases the other ranks");
    const bool before = std::exchange(under_way_->let_go, true);
    for (int to = 1; to < size_ && !before; ++to) {
        under_way_->send({}, to);
    }
}

std::optional<Ranks::Message> Ranks::heard() const {
    if (size_ == 1) {
        return std::nullopt;
    }
    under_way_->sent.remove_if(ended);
    std::unique_ptr<Transfer>& coming = under_way_->coming;
    if (!coming) {
        int waiting = 0;
        MPI_Message found = MPI_MESSAGE_NULL;
        MPI_Status status;
        MPI_Improbe(MPI_ANY_SOURCE, tag, MPI_COMM_WORLD, &waiting, &found, &status);
        if (waiting == 0) {
            return std::nullopt;
        }
        int length = 0;
        MPI_Get_count(&status, MPI_CHAR, &length);
        coming = std::make_unique<Transfer>();
        coming->text.resize(static_cast<std::size_t>(length));
        coming->from = status.MPI_SOURCE;
        MPI_Imrecv(coming->text.data(), length, MPI_CHAR, &found, &coming->request);
    }
    if (!ended(*coming)) {
        return std::nullopt;
    }
    const std::unique_ptr<Transfer> whole = std::move(coming);
    return Message{whole->from, std::move(whole->text)};
}

} // namespace millwright::app
