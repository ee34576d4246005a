#include "core/exchange/internal/occt.h"

#include <Message.hxx>
#include <Message_Messenger.hxx>
#include <Message_Printer.hxx>

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

} // namespace millwright::exchange
