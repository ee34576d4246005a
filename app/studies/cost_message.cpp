#include "app/studies/cost_message.h"

#include "core/base/error.h"

#include <nlohmann/json.hpp>

#include <exception>
#include <optional>
#include <utility>

namespace millwright::app {

namespace {

using Json = nlohmann::json;
using toolpath::PlaceFigures;
using toolpath::SetUpPlace;

/// Infinity, too, stays what it is.
std::string binary_of(const Json& value) {
    std::string bytes;
    Json::to_msgpack(value, bytes);
    return bytes;
}

template <class Read> auto understood(std::string_view bytes, const Read& read) {
    try {
        return read(Json::from_msgpack(bytes.begin(), bytes.end()));
    } catch (const std::exception& fault) {
        throw Error(std::string("a rank sent an invalid message: ") + fault.what());
    }
}

} // namespace

std::string packed(std::span<const SetUpPlace> places) {
    Json numbers = Json::array();
    for (const SetUpPlace& place : places) {
        for (const double number : place) {
            numbers.push_back(number);
        }
    }
    return binary_of(numbers);
}

std::string packed(const CostMessage& message) {
    Json figures = Json::array();
    for (const PlaceFigures& place : message.figures) {
        figures.push_back({place.cost, place.axis_max ? Json(*place.axis_max) : Json()});
    }
    return binary_of({message.first, std::move(figures), message.why_not});
}

std::vector<SetUpPlace> unpacked_places(std::string_view bytes) {
    return understood(bytes, [](const Json& numbers) {
        std::vector<SetUpPlace> places(numbers.size() / 4);
        for (std::size_t n = 0; n < 4 * places.size(); ++n) {
            places[n / 4][static_cast<Eigen::Index>(n % 4)] = numbers.at(n).get<double>();
        }
        return places;
    });
}

CostMessage unpacked_costs(std::string_view bytes) {
    return understood(bytes, [](const Json& from) {
        CostMessage message{from.at(0), {}, from.at(2)};
        for (const Json& place : from.at(1)) {
            const Json& axis_max = place.at(1);
            message.figures.push_back(
                {place.at(0).get<double>(),
                 axis_max.is_null() ? std::nullopt : std::optional(axis_max.get<double>())});
        }
        return message;
    });
}

} // namespace millwright::app
