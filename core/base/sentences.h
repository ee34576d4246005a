// Pieces of text as sentences for people. Errors and drivers write theirs small and without a full stop, as
// parts of longer ones; some are questions.
#pragma once

#include <string>
#include <string_view>

namespace millwright {

/// Whether `text` ends as a sentence does: a full stop, a question or an exclamation mark.
[[nodiscard]] bool ends_sentence(std::string_view text);

/// With a large first letter; an address such as tcp:HOST stays as it is.
[[nodiscard]] std::string capitalised(std::string text);

/// With a full stop where it does not end as a sentence already; "" stays.
[[nodiscard]] std::string with_full_stop(std::string text);

/// Capitalised, with a full stop.
[[nodiscard]] std::string as_sentence(std::string text);

/// `text` with `next` behind it, each a sentence of its own; `text` may be empty.
[[nodiscard]] std::string with_sentence(std::string text, std::string_view next);

/// `text` with `next` behind it in the same sentence, after a semicolon; after a question, as the next one.
[[nodiscard]] std::string with_clause(std::string text, std::string_view next);

} // namespace millwright
