// In a build without MPI.
#include "app/studies/ranks.h"
#include "core/base/error.h"

#include <cstdlib>
#include <string>

namespace millwright::app {

struct Ranks::UnderWay {};

Ranks::Ranks() {
    const char* const size = std::getenv("OMPI_COMM_WORLD_SIZE");
    if (size != nullptr && std::string(size) != "1") {
        throw Error("this build has no MPI: each process would do the whole work",
                    {},
                    "install libopenmpi-dev, then rebuild");
    }
}

Ranks::~Ranks() = default;

void Ranks::tell(std::string_view) const {
    throw Defect("rank 0 receives messages, it does not send them");
}

void Ranks::tell_all(std::string_view) const {} // there are no other ranks

void Ranks::let_go() const {}

std::optional<Ranks::Message> Ranks::heard() const {
    return std::nullopt;
}

} // namespace millwright::app
