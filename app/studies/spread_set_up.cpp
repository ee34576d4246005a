#include "app/studies/spread_set_up.h"

#include "app/studies/mpi_gather.h"
#include "core/base/counted.h"
#include "core/base/error.h"
#include "core/base/text.h"
#include "core/base/units.h"
#include "core/toolpath/set_up_search.h"

#include <fmt/format.h>
#include <nlohmann/json.hpp>

#include <algorithm>
#include <chrono>
#include <cstddef>
#include <exception>
#include <mutex>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace millwright::app {

// What the ranks of a set-up search tell one another: the places that are asked for, and what they cost.

struct CostMessage {
    std::size_t first = 0; ///< index of the first place; the others are as many ranks apart
    std::vector<toolpath::PlaceFigures> figures;
    std::string why_not; ///< nothing more comes: "was stopped", or "failed: ..."
};

/// Never empty. Figures to the last bit.
[[nodiscard]] std::string packed(std::span<const toolpath::SetUpPlace> places);
[[nodiscard]] std::string packed(const CostMessage& message);

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

/// Throw Error if these are none of our bytes.
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

namespace {

using toolpath::PlaceFigures;
using toolpath::SetUpCost;
using toolpath::SetUpPlace;

/// The places of one rank, some at a time; each is reported, or why there are no more.
void evaluate_places(const Ranks& ranks,
                     const SetUpCost& cost,
                     std::span<const SetUpPlace> places,
                     const Tell& tell,
                     const std::stop_token& stop) {
    constexpr std::size_t at_a_time = 16;
    const auto step = static_cast<std::size_t>(ranks.size());
    try {
        for (auto from = static_cast<std::size_t>(ranks.rank()); from < places.size();
             from += at_a_time * step) {
            std::vector<SetUpPlace> some;
            for (std::size_t n = from; n < places.size() && some.size() < at_a_time; n += step) {
                some.push_back(places[n]);
            }
            tell(packed(CostMessage{from, figures_at(cost, some, Progress({}, stop)), {}}));
        }
    } catch (const Cancelled&) {
        tell(packed(CostMessage{0, {}, "was stopped"}));
    } catch (const std::exception& failure) {
        tell(packed(CostMessage{0, {}, std::string("failed: ") + failure.what()}));
    }
}

std::string place_text(const SetUpPlace& place) {
    return fmt::format("({}, {}, {}) mm turned by {} degrees",
                       fixed(place[0], 1),
                       fixed(place[1], 1),
                       fixed(place[2], 1),
                       fixed(to_degrees(place[3]), 1));
}

/// "from (0.0, ...) to (40.0, ...)"
std::string range_of(std::span<const SetUpPlace> places, const std::vector<std::size_t>& some) {
    return fmt::format("from {} to {}", place_text(places[some.front()]), place_text(places[some.back()]));
}

std::string without_places(std::span<const SetUpPlace> places, const std::vector<std::size_t>& without) {
    return fmt::format("{} of its positions are missing: {}", without.size(), range_of(places, without));
}

/// What has come of one request.
class Costs {
public:
    Costs(std::span<const SetUpPlace> places, int ranks)
        : places_(places), ranks_(static_cast<std::size_t>(ranks)), costs_(places.size()), why_not_(ranks_),
          told_(ranks_, false) {}

    void take(int from, const CostMessage& message) {
        if (!message.why_not.empty()) {
            why_not_[static_cast<std::size_t>(from)] = message.why_not;
        }
        for (std::size_t n = 0; n < message.figures.size(); ++n) {
            std::optional<PlaceFigures>& cost = costs_.at(message.first + n * ranks_);
            come_ += cost ? 0 : 1;
            cost = message.figures[n];
        }
    }
    [[nodiscard]] bool over() const {
        for (std::size_t rank = 0; rank < ranks_; ++rank) {
            if (why_not_[rank].empty() && !missing(rank).empty()) {
                return false;
            }
        }
        return true;
    }
    [[nodiscard]] double fraction() const {
        return places_.empty() ? 1.0 : static_cast<double>(come_) / static_cast<double>(places_.size());
    }
    [[nodiscard]] std::size_t come() const { return come_; }

    /// Says of each rank from `first` on whose costs are not all here, and was not reported before, a
    /// sentence; those that were only stopped are silent.
    void tell_lost(std::size_t first, const std::function<void(const std::string&)>& say) {
        for (std::size_t rank = first; rank < ranks_; ++rank) {
            const std::vector<std::size_t> without = missing(rank);
            if (without.empty() || why_not_[rank] == "was stopped" || told_[rank]) {
                continue;
            }
            told_[rank] = true;
            lost_.push_back(fmt::format("rank {} {}; {}",
                                        rank,
                                        why_not_[rank].empty() ? "has not ended" : why_not_[rank],
                                        without_places(places_, without)));
            say(lost_.back());
        }
    }
    [[nodiscard]] const std::vector<std::string>& lost() const { return lost_; }
    [[nodiscard]] std::vector<PlaceFigures> all() const {
        std::vector<PlaceFigures> all;
        std::ranges::transform(costs_, std::back_inserter(all), [](const auto& cost) { return *cost; });
        return all;
    }

private:
    [[nodiscard]] std::vector<std::size_t> missing(std::size_t rank) const {
        std::vector<std::size_t> found;
        for (std::size_t n = rank; n < costs_.size(); n += ranks_) {
            if (!costs_[n]) {
                found.push_back(n);
            }
        }
        return found;
    }

    std::span<const SetUpPlace> places_;
    std::size_t ranks_;
    std::vector<std::optional<PlaceFigures>> costs_;
    std::vector<std::string> why_not_; ///< of each rank that has ended early
    std::vector<bool> told_;           ///< of each rank that it is lost
    std::vector<std::string> lost_;    ///< the sentences
    std::size_t come_ = 0;
};

/// Of another rank: how far it is, asked by one thread while another measures.
class OwnPlaces {
public:
    explicit OwnPlaces(const Ranks& ranks) : ranks_(ranks) {}

    void begin(const std::vector<SetUpPlace>& places) {
        const std::scoped_lock lock(turn_);
        places_ = places;
        next_ = static_cast<std::size_t>(ranks_.rank());
    }
    void add(std::size_t measured) {
        const std::scoped_lock lock(turn_);
        next_ += measured * static_cast<std::size_t>(ranks_.size());
    }
    /// What is lost with rank 0, as a sentence.
    [[nodiscard]] std::string lost() const {
        const std::scoped_lock lock(turn_);
        return fmt::format(
            "rank {} was stopped and rank 0 does not respond; {}", ranks_.rank(), share_lost());
    }

private:
    /// Of this rank's places those from one of them on.
    [[nodiscard]] std::vector<std::size_t> from(std::size_t first) const {
        std::vector<std::size_t> found;
        for (std::size_t n = first; n < places_.size(); n += static_cast<std::size_t>(ranks_.size())) {
            found.push_back(n);
        }
        return found;
    }
    /// What it measured went to rank 0, which keeps it in memory alone.
    [[nodiscard]] std::string share_lost() const {
        if (places_.empty()) {
            return "no position had been assigned to it yet";
        }
        const std::vector<std::size_t> own = from(static_cast<std::size_t>(ranks_.rank()));
        if (const std::vector<std::size_t> without = from(next_); !without.empty()) {
            const std::size_t measured = own.size() - without.size();
            return without_places(places_, without) +
                   (measured > 0
                        ? fmt::format("; the {} before them, which it had measured, are lost with rank 0",
                                      measured)
                        : std::string());
        }
        return own.empty() ? fmt::format("none of the {} positions was assigned to it", places_.size())
                           : fmt::format("it had measured all of its {}, which are lost with rank 0, as is "
                                         "what rank 0 computes alone after them: {}",
                                         counted(own.size(), "position"),
                                         range_of(places_, own));
    }

    const Ranks& ranks_;
    mutable std::mutex turn_;        ///< guards what follows
    std::vector<SetUpPlace> places_; ///< of the last request
    std::size_t next_ = 0;           ///< of this rank's places
};

} // namespace

SpreadCosts::SpreadCosts(const Ranks& ranks,
                         const SetUpCost& cost,
                         std::function<void(const std::string&)> say)
    : ranks_(ranks), cost_(cost), say_(std::move(say)) {}

std::vector<PlaceFigures> SpreadCosts::at(std::span<const SetUpPlace> places, const Progress& progress) {
    ranks_.tell_all(packed(places));
    Costs costs(places, ranks_.size());
    const GatheredWork all{
        .own = [&](const Tell& tell,
                   const std::stop_token& stop) { evaluate_places(ranks_, cost_, places, tell, stop); },
        .heard = [&](int from, const std::string& bytes) { costs.take(from, unpacked_costs(bytes)); },
        .over =
            [&] {
                progress.report(costs.fraction(), shared_work(places.size(), "position", ranks_));
                return costs.over();
            },
        .given_up = [&] { costs.tell_lost(1, say_); }};
    const bool whole = mpi_gather(ranks_, all, progress);
    costs.tell_lost(0, say_);
    const std::vector<std::string>& lost = costs.lost();
    if (!lost.empty()) {
        throw Error(
            fmt::format("{} of {} positions were measured: {}", costs.come(), places.size(), lost[0]));
    }
    if (!whole) {
        throw Cancelled();
    }
    return costs.all();
}

void help_with_costs(const Ranks& ranks,
                     const SetUpCost& cost,
                     const std::function<void(const std::string& lost)>& deserted,
                     const std::stop_token& stop) {
    OwnPlaces own(ranks);
    const HelpingWork mine{
        .own =
            [&](const std::string& asked, const Tell& tell, const std::stop_token& own_stop) {
                const std::vector<SetUpPlace> places = unpacked_places(asked);
                own.begin(places);
                const auto count_and_tell = [&](const std::string& bytes) {
                    own.add(unpacked_costs(bytes).figures.size());
                    tell(bytes);
                };
                evaluate_places(ranks, cost, places, count_and_tell, own_stop);
            },
        .deserted = [&] { deserted(own.lost()); }};
    mpi_help(ranks, mine, stop);
}

} // namespace millwright::app
