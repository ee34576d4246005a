#include "core/drivers/linuxcnc/internal/replies.h"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>

namespace millwright::drivers::linuxcnc {

namespace {

std::string_view trimmed(std::string_view text) {
    const auto blank = [](char c) { return std::isspace(static_cast<unsigned char>(c)) != 0; };
    while (!text.empty() && blank(text.front())) {
        text.remove_prefix(1);
    }
    while (!text.empty() && blank(text.back())) {
        text.remove_suffix(1);
    }
    return text;
}

std::string_view take_word(std::string_view& text) {
    const std::size_t end = std::min(text.find(' '), text.size());
    const std::string_view word = text.substr(0, end);
    text = trimmed(text.substr(end));
    return word;
}

bool is_subject(std::string_view word) {
    return !word.empty() &&
           std::ranges::all_of(word, [](char c) { return (c >= 'A' && c <= 'Z') || c == '_'; });
}

} // namespace

Reply read_reply(std::string_view line) {
    std::string_view rest = trimmed(line);
    const std::string_view first = take_word(rest);
    Reply reply;
    if (first == "HELLO") {
        reply.kind = rest.starts_with("ACK") ? Reply::Kind::hello : Reply::Kind::refused;
        reply.subject = first;
    } else if (first == "SET" || first == "GET") {
        reply.subject = take_word(rest);
        reply.kind = rest == "ACK"   ? Reply::Kind::done
                     : rest == "NAK" ? Reply::Kind::refused
                                     : Reply::Kind::other;
    } else if (is_subject(first)) {
        reply.kind = Reply::Kind::value;
        reply.subject = first;
        reply.text = rest;
    }
    return reply;
}

std::optional<std::vector<double>> read_numbers(std::string_view text) {
    std::vector<double> numbers;
    for (text = trimmed(text); !text.empty();) {
        const std::string_view word = take_word(text);
        double value = 0.0;
        const auto read = std::from_chars(word.data(), word.data() + word.size(), value);
        if (read.ec != std::errc{} || read.ptr != word.data() + word.size() || !std::isfinite(value)) {
            return std::nullopt;
        }
        numbers.push_back(value);
    }
    return numbers;
}

} // namespace millwright::drivers::linuxcnc
