// Reading our JSON files: every value knows its position, so that a wrong one is reported with file, line,
// column and its path inside the file. Nothing is guessed: a missing, extra, repeated or mistyped field is an
// Error.
#pragma once

#include <filesystem>
#include <initializer_list>
#include <limits>
#include <memory>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace millwright {

class JsonValue {
public:
    /// Parses a whole file's text; `file` is named in every diagnostic. Throws Error at the first wrong byte,
    /// at a key that stands twice in one object, and beyond 64 levels.
    [[nodiscard]] static JsonValue parse(std::string_view text, const std::filesystem::path& file);

    /// Reads and parses `file`.
    [[nodiscard]] static JsonValue read(const std::filesystem::path& file);

    /// The field `key` of an object. Throws Error if this is no object or has no such field.
    [[nodiscard]] JsonValue at(std::string_view key) const;
    /// The field `key` if there is one. Throws Error if this is no object.
    [[nodiscard]] std::optional<JsonValue> find(std::string_view key) const;
    /// Throws Error if the object has a field that is not in `keys`.
    void expect_only(std::initializer_list<std::string_view> keys) const;
    void expect_only(std::span<const std::string_view> keys) const;

    /// The elements of an array. Throws Error if this is not an array, or does not have `count` elements
    /// where that is given.
    [[nodiscard]] std::vector<JsonValue> items() const;
    [[nodiscard]] std::vector<JsonValue> items(std::size_t count) const;

    /// Each throws Error if the value is of another type or out of range; a number is always finite.
    [[nodiscard]] double number(double min = -std::numeric_limits<double>::max(),
                                double max = std::numeric_limits<double>::max()) const;
    [[nodiscard]] int integer(int min = std::numeric_limits<int>::min(),
                              int max = std::numeric_limits<int>::max()) const;
    [[nodiscard]] bool flag() const;
    [[nodiscard]] std::string text() const;
    [[nodiscard]] bool is_null() const;
    [[nodiscard]] bool is_object() const;
    [[nodiscard]] bool is_text() const;

    /// Throws an Error about this value: place, path, `message`.
    [[noreturn]] void fail(std::string_view message, std::string hint = {}) const;

private:
    struct Node;
    class Builder;
    JsonValue(std::shared_ptr<const Node> node, std::filesystem::path file, std::string path);

    std::shared_ptr<const Node> node_;
    std::filesystem::path file_;
    std::string path_; ///< like grid/nu; empty for the whole file
};

} // namespace millwright
