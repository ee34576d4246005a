#include "app/studies/spread_study.h"

#include "app/studies/mpi_gather.h"
#include "app/studies/unfinished_study.h"
#include "core/base/error.h"
#include "core/studies/kinematic_study.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <atomic>
#include <bit>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <exception>
#include <numeric>
#include <optional>
#include <stop_token>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::app {

// What the ranks of a study tell rank 0: where they are, the rows of a case that is done, that they are at
// their end.

struct StudyMessage {
    std::optional<std::size_t> at = {};                      ///< index of the case that it is about
    double fraction = 0.0;                                   ///< of that case
    std::string text = {};                                   ///< what is being done, or why it failed
    std::optional<std::vector<studies::StudyRow>> rows = {}; ///< of the case, which is done
    bool failed = false;
    bool ended = false; ///< nothing more comes
};

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

/// Figures to the last bit.
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

/// Throws Error if these are none of our bytes.
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

namespace {

using studies::StudyCase;
using studies::StudyRow;

/// The cases of one rank, one after another; every one is reported, and the end in any case.
void study_cases(const Ranks& ranks,
                 std::span<const StudyCase> cases,
                 const StudyOne& study,
                 const Tell& tell_bytes,
                 const std::stop_token& stop) {
    const auto tell = [&](const StudyMessage& message) { tell_bytes(packed(message)); };
    constexpr std::chrono::milliseconds between_reports{200};
    auto last = std::chrono::steady_clock::now();
    StudyMessage end{.ended = true};
    try {
        for (std::size_t n = static_cast<std::size_t>(ranks.rank()); n < cases.size();
             n += static_cast<std::size_t>(ranks.size())) {
            const auto report = [&, n](const Progress::Report& now) {
                if (std::chrono::steady_clock::now() - last > between_reports) {
                    last = std::chrono::steady_clock::now();
                    tell({.at = n, .fraction = now.fraction, .text = now.text});
                }
            };
            tell({.at = n, .fraction = 1.0, .rows = study(cases[n], Progress(report, stop))});
        }
    } catch (const Cancelled&) {
        end.text = "stopped";
    } catch (const std::exception& failure) {
        end.text = failure.what();
        end.failed = true;
    }
    tell(end);
}

/// Where all ranks are.
class Gathering {
public:
    Gathering(int ranks, std::span<const StudyCase> cases)
        : cases_(cases), ranks_(static_cast<std::size_t>(ranks)), fractions_(cases.size(), 0.0) {
        study_.rows.resize(cases.size());
    }

    /// Whether a case is done with it.
    bool take(int from, StudyMessage message) {
        Rank& rank = ranks_[static_cast<std::size_t>(from)];
        rank.ended = rank.ended || message.ended;
        if (message.failed) {
            rank.why = message.text;
        }
        if (message.at) {
            fractions_.at(*message.at) = message.fraction;
        }
        if (message.rows) {
            study_.rows.at(*message.at) = std::move(*message.rows);
        }
        return message.rows.has_value();
    }
    [[nodiscard]] bool over() const { return std::ranges::all_of(ranks_, &Rank::ended); }
    [[nodiscard]] double fraction() const {
        return std::accumulate(fractions_.begin(), fractions_.end(), 0.0) /
               static_cast<double>(cases_.size());
    }
    [[nodiscard]] const std::vector<std::vector<StudyRow>>& rows() const { return study_.rows; }

    /// What is lost by one rank, as a sentence; nothing if all of its cases have come.
    [[nodiscard]] std::optional<std::string> lost_by(std::size_t rank) const {
        std::string missing;
        for (std::size_t n = rank; n < cases_.size(); n += ranks_.size()) {
            if (study_.rows[n].empty()) {
                missing += (missing.empty() ? "" : ", ") + name_of(cases_[n]);
            }
        }
        if (missing.empty()) {
            return std::nullopt;
        }
        return fmt::format("rank {} {}; missing cases: {}", rank, fate(ranks_[rank]), missing);
    }
    /// Notes and tells what is lost by the ranks from `first` on that was not reported before.
    void tell_lost(std::size_t first, const StudyNews& news) {
        for (std::size_t rank = first; rank < ranks_.size(); ++rank) {
            const auto sentence = ranks_[rank].told ? std::nullopt : lost_by(rank);
            if (sentence) {
                ranks_[rank].told = true;
                study_.lost.push_back(*sentence);
                news.lost(*sentence);
            }
        }
    }
    [[nodiscard]] SpreadStudy result() && { return std::move(study_); }

private:
    struct Rank {
        bool ended = false;
        std::string why; ///< it failed
        bool told = false;
    };

    static std::string fate(const Rank& rank) {
        if (!rank.why.empty()) {
            return "failed: " + rank.why;
        }
        return rank.ended ? "was stopped" : "has not ended";
    }

    std::span<const StudyCase> cases_;
    std::vector<Rank> ranks_;
    std::vector<double> fractions_;
    SpreadStudy study_;
};

/// Where a rank is in its cases.
struct Place {
    std::atomic<std::size_t> next;   ///< of all cases
    std::atomic<bool> begun = false; ///< with that one
};

/// Of a rank that has no case to do and none that may be lost: empty.
std::string lost_with_rank_0(const Ranks& ranks, std::span<const StudyCase> cases, const Place& at) {
    const auto step = static_cast<std::size_t>(ranks.size());
    const std::size_t next = at.next;
    std::string missing;
    for (std::size_t n = next; n < cases.size(); n += step) {
        const bool begun = n == next && at.begun;
        missing += (missing.empty() ? "" : ", ") + name_of(cases[n]) + (begun ? " (begun)" : "");
    }
    std::string lost;
    if (!missing.empty()) {
        lost += "; missing cases: " + missing;
    }
    if (next >= step) {
        lost += "; its last finished case may not be written: " + name_of(cases[next - step]);
    }
    return lost.empty()
               ? std::string()
               : fmt::format("rank {} was stopped and rank 0 does not respond{}", ranks.rank(), lost);
}

} // namespace

SpreadStudy gather_study(const Ranks& ranks,
                         std::span<const StudyCase> cases,
                         const StudyOne& study,
                         const StudyNews& news,
                         const Progress& progress) {
    ranks.tell_all("begin");
    Gathering gathering(ranks.size(), cases);
    std::size_t shown = 0;
    const auto over = [&] {
        for (; shown < cases.size() && !gathering.rows()[shown].empty(); ++shown) {
            news.done(gathering.rows()[shown]);
        }
        progress.report(gathering.fraction(), shared_work(cases.size(), "case", ranks));
        return gathering.over();
    };
    const GatheredWork all{
        .own = [&](const Tell& tell,
                   const std::stop_token& stop) { study_cases(ranks, cases, study, tell, stop); },
        .heard =
            [&](int from, const std::string& bytes) {
                if (gathering.take(from, unpacked(bytes))) {
                    news.came(gathering.rows());
                }
            },
        .over = over,
        .given_up = [&] { gathering.tell_lost(1, news); }};
    const bool whole = mpi_gather(ranks, all, progress);
    gathering.tell_lost(0, news);
    SpreadStudy result = std::move(gathering).result();
    result.stopped = !whole;
    return result;
}

void help_with_study(const Ranks& ranks,
                     std::span<const StudyCase> cases,
                     const StudyOne& study,
                     const std::function<void(const std::string& lost)>& deserted,
                     const std::stop_token& stop) {
    Place at{static_cast<std::size_t>(ranks.rank())};
    const auto one = [&](const StudyCase& of, const Progress& progress) {
        at.begun = true;
        std::vector<StudyRow> rows = study(of, progress);
        at.next += static_cast<std::size_t>(ranks.size());
        at.begun = false;
        return rows;
    };
    const HelpingWork mine{.own =
                               [&](const std::string&, const Tell& tell, const std::stop_token& own_stop) {
                                   study_cases(ranks, cases, one, tell, own_stop);
                               },
                           .deserted = [&] { deserted(lost_with_rank_0(ranks, cases, at)); }};
    mpi_help(ranks, mine, stop);
}

} // namespace millwright::app
