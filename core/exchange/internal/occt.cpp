#include "core/exchange/internal/occt.h"

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>

#include <algorithm>
#include <utility>

namespace millwright::exchange {

namespace {

std::mutex& only_one() {
    static std::mutex turn;
    return turn;
}

} // namespace

OcctTurn::OcctTurn() : turn_(only_one()) {
    Message::DefaultMessenger()->RemovePrinters(STANDARD_TYPE(Message_Printer));
}

ProgressStream::ProgressStream(const std::string& text, Progress progress, std::string afterwards)
    : text_(text), progress_(std::move(progress)), afterwards_(std::move(afterwards)) {}

ProgressStream::int_type ProgressStream::underflow() {
    constexpr std::size_t piece = 1 << 16;
    const std::size_t size = std::min(piece, text_.size() - given_);
    if (size == 0) {
        progress_.report(1.0, afterwards_);
        return traits_type::eof();
    }
    progress_.report(static_cast<double>(given_) / static_cast<double>(text_.size()));
    char* const begin = const_cast<char*>(text_.data()) + given_; // a buffer that is only read from
    setg(begin, begin, begin + size);
    given_ += size;
    return traits_type::to_int_type(*begin);
}

} // namespace millwright::exchange
