// Any bytes are either JSON, of which every value can be asked for everything, or an Error with a place.
#include "core/base/json.h"

#include "core/base/error.h"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <string_view>

namespace {

using millwright::Error;
using millwright::expects;
using millwright::JsonValue;

template <class Question> void ask(const Question& question) {
    try {
        question();
    } catch (const Error& error) {
        expects(error.diagnostic().place.line > 0, "an error of a value has a line");
    }
}

void ask_everything(const JsonValue& value) {
    ask([&] { expects(std::isfinite(value.number()), "a number is finite"); });
    ask([&] { static_cast<void>(value.integer()); });
    ask([&] { static_cast<void>(value.text()); });
    ask([&] { static_cast<void>(value.find("axes")); });
    ask([&] {
        for (const JsonValue& item : value.items()) {
            ask_everything(item);
        }
    });
}

} // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size);

int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    const std::string_view text(reinterpret_cast<const char*>(data), size);
    ask([&] { ask_everything(JsonValue::parse(text, "fuzz.json")); });
    return 0;
}
