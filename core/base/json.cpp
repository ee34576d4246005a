#include "core/base/json.h"

#include "core/base/error.h"
#include "core/base/files.h"
#include "core/base/text.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <utility>

namespace millwright {

enum class JsonKind { null, flag, number, text, array, object };

namespace {

std::string_view name_of(JsonKind kind) {
    switch (kind) {
    case JsonKind::null:
        return "null";
    case JsonKind::flag:
        return "true or false";
    case JsonKind::number:
        return "a number";
    case JsonKind::text:
        return "a text";
    case JsonKind::array:
        return "a list";
    case JsonKind::object:
        return "an object";
    }
    return "unknown";
}

constexpr std::size_t deepest = 64;
constexpr std::size_t most_values = 4'000'000; ///< some 160 bytes of memory each

} // namespace

struct JsonValue::Node {
    JsonKind kind = JsonKind::null;
    int line = 1;
    int column = 1;
    double number = 0.0;
    bool flag = false;
    std::string text;
    std::vector<std::string> keys; ///< of an object, one per child
    std::vector<std::shared_ptr<Node>> children;
};

/// Builds the tree from the parser's events. A cursor follows them through the text, because the parser does
/// not tell where a value begins.
class JsonValue::Builder final : public nlohmann::json_sax<nlohmann::json> {
public:
    Builder(std::string_view text, const std::filesystem::path& file) : text_(text), file_(file) {}

    [[nodiscard]] std::shared_ptr<const Node> take() { return std::move(root_); }

    bool null() override { return add(JsonKind::null), skip_word(); }
    bool boolean(bool value) override { return add(JsonKind::flag).flag = value, skip_word(); }
    bool number_integer(number_integer_t value) override { return add_number(static_cast<double>(value)); }
    bool number_unsigned(number_unsigned_t value) override { return add_number(static_cast<double>(value)); }
    bool number_float(number_float_t value, const string_t&) override { return add_number(value); }
    bool string(string_t& value) override {
        return add(JsonKind::text).text = std::move(value), skip_string();
    }
    bool binary(binary_t&) override { return false; }
    bool start_object(std::size_t) override { return open(JsonKind::object); }
    bool start_array(std::size_t) override { return open(JsonKind::array); }
    bool end_object() override { return close(); }
    bool end_array() override { return close(); }

    bool key(string_t& value) override {
        to_token();
        auto& keys = open_.back()->keys;
        if (std::find(keys.begin(), keys.end(), value) != keys.end()) {
            throw Error(Diagnostic{here(), fmt::format("the field \"{}\" occurs twice", value), {}});
        }
        keys.push_back(value);
        return skip_string();
    }

    bool parse_error(std::size_t position,
                     const std::string& last_token,
                     const nlohmann::json::exception& failure) override {
        move_to(std::min(position > 0 ? position - 1 : 0, text_.size()));
        const bool too_large = failure.id == 406; // nlohmann: out_of_range.406, number overflow
        throw Error(Diagnostic{here(),
                               too_large ? fmt::format("the number {} is too large", last_token)
                               : position > text_.size()
                                   ? std::string("the file ends in the middle of a value")
                                   : fmt::format("not valid JSON near \"{}\"", printable(last_token)),
                               {}});
    }

private:
    static std::string printable(std::string token) {
        constexpr std::size_t longest = 40;
        if (token.size() > longest) {
            token = "..." + token.substr(token.size() - longest);
        }
        std::replace_if(
            token.begin(), token.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
        return token;
    }

    Node& add(JsonKind kind) {
        to_token();
        if (++values_ > most_values) {
            throw Error(Diagnostic{here(), fmt::format("more than {} values", most_values), {}});
        }
        auto node = std::make_shared<Node>();
        node->kind = kind;
        node->line = line_;
        node->column = column_;
        Node& result = *node;
        if (open_.empty()) {
            root_ = std::move(node);
        } else {
            open_.back()->children.push_back(std::move(node));
        }
        return result;
    }

    bool add_number(double value) {
        add(JsonKind::number).number = value;
        return skip_while("+-.eE0123456789");
    }

    bool open(JsonKind kind) {
        Node& node = add(kind);
        if (open_.size() >= deepest) {
            throw Error(Diagnostic{here(), fmt::format("nested deeper than {} levels", deepest), {}});
        }
        open_.push_back(&node);
        step();
        return true;
    }

    bool close() {
        to_token();
        step();
        open_.pop_back();
        return true;
    }

    [[nodiscard]] Place here() const { return {file_, line_, column_, static_cast<std::int64_t>(cursor_)}; }

    void step() {
        if (cursor_ < text_.size() && text_[cursor_] == '\n') {
            ++line_;
            column_ = 0;
        }
        ++cursor_;
        ++column_;
    }

    void move_to(std::size_t position) {
        while (cursor_ < position) {
            step();
        }
    }

    bool skip_while(std::string_view characters) {
        while (cursor_ < text_.size() && characters.find(text_[cursor_]) != std::string_view::npos) {
            step();
        }
        return true;
    }

    void to_token() { skip_while(" \t\r\n,:\xEF\xBB\xBF"); }

    bool skip_word() { return skip_while("truefalsn"); }

    bool skip_string() {
        step();
        while (cursor_ < text_.size() && text_[cursor_] != '"') {
            if (text_[cursor_] == '\\') {
                step();
            }
            step();
        }
        step();
        return true;
    }

    std::string_view text_;
    std::filesystem::path file_;
    std::size_t cursor_ = 0;
    std::size_t values_ = 0; ///< read so far
    int line_ = 1;
    int column_ = 1;
    std::shared_ptr<Node> root_;
    std::vector<Node*> open_;
};

JsonValue::JsonValue(std::shared_ptr<const Node> node, std::filesystem::path file, std::string path)
    : node_(std::move(node)), file_(std::move(file)), path_(std::move(path)) {}

JsonValue JsonValue::parse(std::string_view text, const std::filesystem::path& file) {
    refuse_wide_text(text, file);
    Builder builder(text, file);
    nlohmann::json::sax_parse(text.begin(), text.end(), &builder);
    return {builder.take(), file, {}};
}

JsonValue JsonValue::read(const std::filesystem::path& file) {
    constexpr std::uintmax_t most_bytes = 16 << 20; // as values they take eighty times as much
    std::error_code unknown;
    const std::uintmax_t bytes = std::filesystem::file_size(file, unknown);
    if (!unknown && bytes > most_bytes) {
        throw Error(fmt::format("the file is too large ({} MB)", bytes >> 20),
                    file,
                    fmt::format("the maximum is {} MB", most_bytes >> 20));
    }
    return parse(read_file(file), file);
}

JsonValue JsonValue::at(std::string_view key) const {
    if (auto found = find(key)) {
        return *std::move(found);
    }
    fail(fmt::format("the field \"{}\" is missing", key));
}

std::optional<JsonValue> JsonValue::find(std::string_view key) const {
    if (node_->kind != JsonKind::object) {
        fail(fmt::format("expected an object, found {}", name_of(node_->kind)));
    }
    const auto found = std::find(node_->keys.begin(), node_->keys.end(), key);
    if (found == node_->keys.end()) {
        return std::nullopt;
    }
    const auto child = node_->children[static_cast<std::size_t>(found - node_->keys.begin())];
    return JsonValue(child, file_, path_ + (path_.empty() ? "" : "/") + std::string(key));
}

void JsonValue::expect_only(std::initializer_list<std::string_view> keys) const {
    expect_only(std::span(keys.begin(), keys.size()));
}

void JsonValue::expect_only(std::span<const std::string_view> keys) const {
    if (node_->kind != JsonKind::object) {
        fail(fmt::format("expected an object, found {}", name_of(node_->kind)));
    }
    for (const std::string& key : node_->keys) {
        if (std::find(keys.begin(), keys.end(), key) == keys.end()) {
            at(key).fail(fmt::format("the field \"{}\" is not known here", key),
                         fmt::format("known: {}", fmt::join(keys, ", ")));
        }
    }
}

std::vector<JsonValue> JsonValue::items() const {
    if (node_->kind != JsonKind::array) {
        fail(fmt::format("expected a list, found {}", name_of(node_->kind)));
    }
    std::vector<JsonValue> result;
    for (std::size_t n = 0; n < node_->children.size(); ++n) {
        result.push_back(JsonValue(node_->children[n], file_, fmt::format("{}[{}]", path_, n)));
    }
    return result;
}

std::vector<JsonValue> JsonValue::items(std::size_t count) const {
    std::vector<JsonValue> result = items();
    if (result.size() != count) {
        fail(fmt::format("expected a list of {}, found {}", count, result.size()));
    }
    return result;
}

double JsonValue::number(double min, double max) const {
    if (node_->kind != JsonKind::number) {
        fail(fmt::format("expected a number, found {}", name_of(node_->kind)));
    }
    if (!(node_->number >= min && node_->number <= max)) {
        fail(fmt::format("{} is not between {} and {}", node_->number, min, max));
    }
    return node_->number;
}

int JsonValue::integer(int min, int max) const {
    const double value = number();
    if (value < min || value > max) {
        fail(fmt::format("{} is not between {} and {}", value, min, max));
    }
    const int whole = static_cast<int>(value);
    if (value < whole || value > whole) {
        fail(fmt::format("expected a whole number, found {}", value));
    }
    return whole;
}

bool JsonValue::flag() const {
    if (node_->kind != JsonKind::flag) {
        fail(fmt::format("expected true or false, found {}", name_of(node_->kind)));
    }
    return node_->flag;
}

std::string JsonValue::text() const {
    if (node_->kind != JsonKind::text) {
        fail(fmt::format("expected a text, found {}", name_of(node_->kind)));
    }
    return node_->text;
}

bool JsonValue::is_null() const {
    return node_->kind == JsonKind::null;
}
bool JsonValue::is_object() const {
    return node_->kind == JsonKind::object;
}
bool JsonValue::is_text() const {
    return node_->kind == JsonKind::text;
}

void JsonValue::fail(std::string_view message, std::string hint) const {
    throw Error(Diagnostic{{file_, node_->line, node_->column, -1},
                           path_.empty() ? std::string(message) : fmt::format("{}: {}", path_, message),
                           std::move(hint)});
}

} // namespace millwright
