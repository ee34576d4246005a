#include "app/studies/study_message.h"

#include "core/base/error.h"

#include <nlohmann/json.hpp>

#include <array>
#include <bit>
#include <cstdint>

namespace millwright::app {

namespace {

using Json = nlohmann::json;
using studies::StudyFigures;
using studies::StudyRow;

/// All figures of a row in one order; time last.
template <class Figures> auto figures_in_order(Figures& of) {
    auto& error = of.error;
    return std::array{&error.max,
                      &error.mean,
                      &error.lmean,
                      &error.rms,
                      &error.p95,
                      &error.variance,
                      &error.axis_max,
                      &error.axis_mean,
                      &of.track_gap,
                      &of.path_length,
                      &of.offset.x(),
                      &of.offset.y(),
                      &of.offset.z()};
}

Json packed_figures(const StudyFigures& figures) {
    Json values = Json::array();
    for (const double* const value : figures_in_order(figures)) {
        values.push_back(std::bit_cast<std::uint64_t>(*value));
    }
    if (figures.time) {
        values.push_back(std::bit_cast<std::uint64_t>(*figures.time));
    }
    return values;
}

StudyFigures unpacked_figures(const Json& values) {
    StudyFigures figures;
    const auto places = figures_in_order(figures);
    for (std::size_t n = 0; n < places.size(); ++n) {
        *places[n] = std::bit_cast<double>(values.at(n).get<std::uint64_t>());
    }
    if (values.size() > places.size()) {
        figures.time = std::bit_cast<double>(values.at(places.size()).get<std::uint64_t>());
    }
    return figures;
}

Json packed_row(const StudyRow& row) {
    return {{"surface", row.of.surface},
            {"machine", row.of.machine},
            {"points", row.of.points},
            {"tracks", row.of.tracks},
            {"method", static_cast<int>(row.method)},
            {"note", row.note},
            {"no_gain", row.no_gain},
            {"loss", row.loss},
            {"figures", row.figures ? packed_figures(*row.figures) : Json()}};
}

StudyRow unpacked_row(const Json& from) {
    StudyRow row;
    row.of = {from.at("surface"), from.at("machine"), from.at("points"), from.at("tracks")};
    row.method = studies::every_study_method.at(from.at("method").get<std::size_t>());
    row.note = from.at("note");
    row.no_gain = from.at("no_gain");
    row.loss = from.at("loss");
    if (!from.at("figures").is_null()) {
        row.figures = unpacked_figures(from.at("figures"));
    }
    return row;
}

} // namespace

std::string packed(const StudyMessage& message) {
    Json bytes{{"fraction", message.fraction},
               {"text", message.text},
               {"failed", message.failed},
               {"ended", message.ended}};
    if (message.at) {
        bytes["at"] = *message.at;
    }
    if (message.rows) {
        bytes["rows"] = Json::array();
        for (const StudyRow& row : *message.rows) {
            bytes["rows"].push_back(packed_row(row));
        }
    }
    return bytes.dump(-1, ' ', false, Json::error_handler_t::replace);
}

StudyMessage unpacked(std::string_view bytes) {
    try {
        const Json from = Json::parse(bytes);
        StudyMessage message;
        message.fraction = from.at("fraction");
        message.text = from.at("text");
        message.failed = from.at("failed");
        message.ended = from.at("ended");
        if (from.contains("at")) {
            message.at = from.at("at").get<std::size_t>();
        }
        if (from.contains("rows")) {
            message.rows.emplace();
            for (const Json& row : from.at("rows")) {
                message.rows->push_back(unpacked_row(row));
            }
        }
        return message;
    } catch (const std::exception& fault) {
        throw Error(std::string("a rank sent an invalid message: ") + fault.what());
    }
}

} // namespace millwright::app
