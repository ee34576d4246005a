#include "core/simulation/spec_text.h"

#include "core/base/error.h"
#include "core/base/numbers.h"
#include "core/base/units.h"

#include <fmt/format.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cmath>
#include <string>
#include <vector>

namespace millwright::simulation {

namespace {

constexpr double largest = 1e5; ///< mm, of any number

constexpr std::string_view stock_forms =
    "box:LX,LY,LZ[@X,Y,Z], cylinder:D,L[,x|y|z][@X,Y,Z], tube:D,BORE,L[,x|y|z][@X,Y,Z] or FILE.stl[@X,Y,Z]";
constexpr std::string_view tool_forms =
    "flat:D, ball:D, bull:D:R, v:ANGLE:D[:TIP|:rR], drill:D[:ANGLE], each "
    "with :lLENGTH if wanted, or a tool file";

/// A text with the place of its parts in the whole of it.
class Piece {
public:
    Piece(std::string_view whole, std::string_view part, std::string_view forms)
        : whole_(whole), part_(part), forms_(forms) {}

    [[nodiscard]] std::string_view text() const { return part_; }
    [[nodiscard]] Piece of(std::string_view part) const { return {whole_, part, forms_}; }
    [[nodiscard]] std::vector<Piece> split(char at) const {
        std::vector<Piece> parts;
        std::string_view rest = part_;
        for (std::size_t end = rest.find(at); end != std::string_view::npos; end = rest.find(at)) {
            parts.push_back(of(rest.substr(0, end)));
            rest = rest.substr(end + 1);
        }
        parts.push_back(of(rest));
        return parts;
    }
    [[nodiscard]] double number() const {
        const std::string_view digits = without_plus(part_);
        double value = 0.0;
        const auto [end, failure] = std::from_chars(digits.data(), digits.data() + digits.size(), value);
        if (digits.empty() || failure != std::errc{} || end != digits.data() + digits.size() ||
            !std::isfinite(value)) {
            fail("is not a number");
        }
        if (std::abs(value) > largest) {
            fail(fmt::format("is beyond {:g}", largest));
        }
        return value;
    }
    [[nodiscard]] double above_zero() const {
        const double value = number();
        if (!(value > 0.0)) {
            fail("is not above 0");
        }
        return value;
    }
    [[noreturn]] void fail(const std::string& what) const {
        const auto column = static_cast<int>(part_.data() - whole_.data()) + 1;
        throw Error(Diagnostic{
            {},
            fmt::format("\"{}\", column {}: \"{}\" {}", printable(whole_), column, printable(part_), what),
            fmt::format("write {}", forms_)});
    }

private:
    std::string_view whole_, part_, forms_;
};

Vec3 vector_of(const Piece& piece) {
    const std::vector<Piece> parts = piece.split(',');
    if (parts.size() != 3) {
        piece.fail("is not three numbers");
    }
    return {parts[0].number(), parts[1].number(), parts[2].number()};
}

/// The part before `at`, and behind it if there is one.
std::pair<Piece, std::optional<Piece>> cut_in_two(const Piece& piece, char at) {
    const std::size_t found = piece.text().rfind(at);
    if (found == std::string_view::npos) {
        return {piece, std::nullopt};
    }
    return {piece.of(piece.text().substr(0, found)), piece.of(piece.text().substr(found + 1))};
}

Stock box_of(const Piece& sizes, const std::optional<Piece>& place) {
    const std::vector<Piece> parts = sizes.split(',');
    if (parts.size() != 3) {
        sizes.fail("is not three lengths");
    }
    const Vec3 size(parts[0].above_zero(), parts[1].above_zero(), parts[2].above_zero());
    const Vec3 low = place ? vector_of(*place) : Vec3(0.0, 0.0, -size.z());
    return BoxStock{low, low + size};
}

Stock cylinder_of(const Piece& sizes, const std::optional<Piece>& place, bool hollow) {
    std::vector<Piece> parts = sizes.split(',');
    CylinderStock cylinder;
    if (const std::string_view last = parts.back().text(); last == "x" || last == "y" || last == "z") {
        cylinder.axis = last[0] - 'x';
        parts.pop_back();
    }
    if (parts.size() != (hollow ? 3U : 2U)) {
        sizes.fail(hollow ? "is not diameter, bore and length" : "is not diameter and length");
    }
    cylinder.diameter = parts[0].above_zero();
    cylinder.bore = hollow ? parts[1].above_zero() : 0.0;
    cylinder.length = parts.back().above_zero();
    cylinder.base = place ? vector_of(*place) : Vec3::Zero();
    if (!place && cylinder.axis == 2) {
        cylinder.base.z() = -cylinder.length;
    }
    if (const std::string fault = fault_of(cylinder); !fault.empty()) {
        sizes.fail("does not fit: " + fault);
    }
    return cylinder;
}

/// Whether the name ends so, in any case.
bool ends_in(std::string_view name, std::string_view ending) {
    return name.size() > ending.size() &&
           std::ranges::equal(name.substr(name.size() - ending.size()), ending, [](char a, char b) {
               return std::tolower(static_cast<unsigned char>(a)) == b;
           });
}

toolpath::Profile v_of(const Piece& all, const std::vector<Piece>& parts, double length) {
    if (parts.size() < 3 || parts.size() > 4) {
        all.fail("is not v:ANGLE:D or v:ANGLE:D:TIP");
    }
    constexpr double flat_angle = 180.0;
    const double angle = parts[1].above_zero();
    if (angle >= flat_angle) {
        parts[1].fail("is not an angle below 180 degrees");
    }
    toolpath::ProfileShape shape{
        .half_angle = 0.5 * from_degrees(angle), .radius = 0.5 * parts[2].above_zero(), .top = length};
    if (parts.size() == 4) {
        const bool round = parts[3].text().starts_with('r');
        const Piece end = round ? parts[3].of(parts[3].text().substr(1)) : parts[3];
        const double size = end.number();
        if (size < 0.0) {
            end.fail("is below 0");
        }
        (round ? shape.corner : shape.flat) = round ? size : 0.5 * size;
    }
    const double neck = shape.flat + shape.corner * std::cos(shape.half_angle);
    if (neck > shape.radius) {
        parts[3].fail("is wider than the tool");
    }
    const double flank = shape.corner * (1.0 - std::sin(shape.half_angle)) +
                         (shape.radius - neck) / std::tan(shape.half_angle);
    if (flank > length) {
        all.fail(fmt::format("has a point {:.4g} mm long, and the tool is {:g} mm long", flank, length));
    }
    return toolpath::Profile(shape);
}

toolpath::Profile body_of(const Piece& all, const std::vector<Piece>& parts, std::optional<double> length) {
    const std::string_view kind = parts[0].text();
    const auto expect_count = [&](std::size_t least, std::size_t most) {
        if (parts.size() < least || parts.size() > most) {
            all.fail("has too few numbers, or too many");
        }
    };
    constexpr double usual_diameters = 5.0, usual_length = 50.0;
    const auto long_enough = [&](double diameter) {
        return length.value_or(std::max(usual_diameters * diameter, usual_length));
    };
    if (kind == "v") {
        expect_count(3, 4);
        return v_of(all, parts, long_enough(parts[2].above_zero()));
    }
    if (kind == "drill") {
        expect_count(2, 3);
        const double diameter = parts[1].above_zero();
        constexpr std::string_view usual_point = "118";
        const Piece angle = parts.size() == 3 ? parts[2] : parts[1].of(usual_point);
        return v_of(all, {parts[0], angle, parts[1]}, long_enough(diameter));
    }
    expect_count(kind == "bull" ? 3 : 2, kind == "bull" ? 3 : 2);
    const double radius = 0.5 * parts[1].above_zero();
    toolpath::ProfileShape shape{.flat = radius, .radius = radius, .top = long_enough(2.0 * radius)};
    if (kind != "flat") {
        shape.corner = kind == "ball" ? radius : parts[2].number();
        if (shape.corner < 0.0 || shape.corner > radius) {
            parts[2].fail("is no corner radius of this tool");
        }
        shape.flat = radius - shape.corner;
    }
    if (shape.top <= shape.corner) {
        all.fail("is shorter than its corner");
    }
    return toolpath::Profile(shape);
}

} // namespace

StockText parse_stock(std::string_view text) {
    const Piece whole(text, text, stock_forms);
    const auto [front, place] = cut_in_two(whole, '@');
    StockText found;
    for (const std::string_view ending : {".stl", ".obj", ".ply"}) {
        if (ends_in(front.text(), ending)) {
            found.mesh_file = std::string(front.text());
            found.shift = place ? vector_of(*place) : Vec3::Zero();
            return found;
        }
    }
    if (ends_in(text, ".stl") || ends_in(text, ".obj") ||
        ends_in(text, ".ply")) { // @ in the name of a folder
        found.mesh_file = std::string(text);
        return found;
    }
    const std::size_t colon = front.text().find(':');
    const std::string_view kind = front.text().substr(0, colon);
    const Piece sizes = front.of(colon == std::string_view::npos ? front.text().substr(front.text().size())
                                                                 : front.text().substr(colon + 1));
    if (colon != std::string_view::npos && kind == "box") {
        found.stock = box_of(sizes, place);
    } else if (colon != std::string_view::npos && (kind == "cylinder" || kind == "tube")) {
        found.stock = cylinder_of(sizes, place, kind == "tube");
    } else {
        whole.fail("is no stock");
    }
    return found;
}

ToolText parse_tool(std::string_view text) {
    const Piece whole(text, text, tool_forms);
    ToolText found;
    Piece rest = whole;
    if (const std::size_t equals = text.find('='); equals != std::string_view::npos) {
        const Piece number = whole.of(text.substr(0, equals));
        const bool digits = !number.text().empty() && number.text().size() < 7 &&
                            std::ranges::all_of(number.text(), [](char c) { return c >= '0' && c <= '9'; });
        if (digits) {
            found.number = static_cast<int>(number.number());
            rest = whole.of(text.substr(equals + 1));
        }
    }
    if (ends_in(rest.text(), ".json")) {
        found.file = std::string(rest.text());
        return found;
    }
    std::vector<Piece> parts = rest.split(':');
    const std::string_view kind = parts[0].text();
    constexpr std::array<std::string_view, 5> kinds{"flat", "ball", "bull", "v", "drill"};
    if (std::ranges::find(kinds, kind) == kinds.end() || parts.size() < 2) {
        rest.fail("is no tool");
    }
    std::optional<double> length;
    if (parts.back().text().starts_with('l')) {
        length = parts.back().of(parts.back().text().substr(1)).above_zero();
        parts.pop_back();
    }
    found.body = body_of(rest, parts, length);
    return found;
}

} // namespace millwright::simulation
