#include "core/exchange/internal/cad_frames.h"

#include "core/base/error.h"

#include <cstdint>
#include <cstring>
#include <type_traits>
#include <utility>

namespace millwright::exchange {

namespace {

constexpr std::size_t frame_head_size = 1 + sizeof(std::uint64_t);

class Packer {
public:
    template <typename Value> void put(const Value& value) {
        static_assert(std::is_arithmetic_v<Value>);
        bytes_.append(reinterpret_cast<const char*>(&value), sizeof value);
    }
    void put_text(std::string_view text) {
        put(std::uint64_t{text.size()});
        bytes_.append(text);
    }
    template <typename Values, typename Put> void put_each(const Values& values, Put put_one) {
        put(std::uint64_t{values.size()});
        for (const auto& value : values) {
            put_one(value);
        }
    }
    [[nodiscard]] std::string take() && { return std::move(bytes_); }

private:
    std::string bytes_;
};

class Unpacker {
public:
    explicit Unpacker(std::string_view bytes) : left_(bytes) {}

    template <typename Value> Value get() {
        Value value{};
        std::memcpy(&value, bytes(sizeof value).data(), sizeof value);
        return value;
    }
    std::string get_text() { return std::string(bytes(get<std::uint64_t>())); }
    /// `smallest`: bytes that each of them takes at least, so that a wrong count cannot ask for memory.
    template <typename Get> auto get_each(std::size_t smallest, Get get_one) {
        const auto count = get<std::uint64_t>();
        if (count > left_.size() / smallest) {
            fail();
        }
        std::vector<decltype(get_one())> values;
        for (std::uint64_t n = 0; n < count; ++n) {
            values.push_back(get_one());
        }
        return values;
    }
    void expect_end() const {
        if (!left_.empty()) {
            fail();
        }
    }

private:
    [[noreturn]] static void fail() { throw Error("the output of the file reader is invalid"); }
    std::string_view bytes(std::uint64_t count) {
        if (count > left_.size()) {
            fail();
        }
        const std::string_view result = left_.substr(0, count);
        left_.remove_prefix(count);
        return result;
    }

    std::string_view left_;
};

void put_vector(Packer& to, const Vec3& vector) {
    for (int k = 0; k < 3; ++k) {
        to.put(vector[k]);
    }
}

Vec3 get_vector(Unpacker& from) {
    const double x = from.get<double>();
    const double y = from.get<double>();
    return {x, y, from.get<double>()};
}

void put_patch(Packer& to, const geometry::BezierPatch& patch) {
    const geometry::ControlNet& net = patch.net();
    to.put(net.rows);
    to.put(net.columns);
    to.put_each(net.points, [&](const Vec3& point) { put_vector(to, point); });
    to.put_each(net.weights, [&](double weight) { to.put(weight); });
}

geometry::BezierPatch get_patch(Unpacker& from) {
    geometry::ControlNet net;
    net.rows = from.get<int>();
    net.columns = from.get<int>();
    net.points = from.get_each(3 * sizeof(double), [&] { return get_vector(from); });
    net.weights = from.get_each(sizeof(double), [&] { return from.get<double>(); });
    return geometry::BezierPatch(std::move(net));
}

void put_loop(Packer& to, const std::vector<Vec2>& loop) {
    to.put_each(loop, [&](const Vec2& place) {
        to.put(place.x());
        to.put(place.y());
    });
}

std::vector<Vec2> get_loop(Unpacker& from) {
    return from.get_each(2 * sizeof(double), [&] {
        const double x = from.get<double>();
        return Vec2(x, from.get<double>());
    });
}

void put_bspline(Packer& to, const geometry::BsplineNet& net) {
    for (const int number : {net.degree_u, net.degree_v, net.rows, net.columns}) {
        to.put(number);
    }
    const auto put_numbers = [&](const std::vector<double>& numbers) {
        to.put_each(numbers, [&](double number) { to.put(number); });
    };
    put_numbers(net.knots_u);
    put_numbers(net.knots_v);
    to.put_each(net.points, [&](const Vec3& point) { put_vector(to, point); });
    put_numbers(net.weights);
}

geometry::BsplineNet get_bspline(Unpacker& from) {
    geometry::BsplineNet net;
    for (int* number : {&net.degree_u, &net.degree_v, &net.rows, &net.columns}) {
        *number = from.get<int>();
    }
    const auto get_numbers = [&] {
        return from.get_each(sizeof(double), [&] { return from.get<double>(); });
    };
    net.knots_u = get_numbers();
    net.knots_v = get_numbers();
    net.points = from.get_each(3 * sizeof(double), [&] { return get_vector(from); });
    net.weights = get_numbers();
    if (!geometry::fault_of(net).empty()) {
        throw Error("the output of the file reader is invalid");
    }
    return net;
}

void put_face(Packer& to, const CadFace& face) {
    to.put(face.number);
    to.put(face.rows);
    to.put(face.columns);
    to.put_each(face.patches, [&](const auto& patch) { put_patch(to, patch); });
    put_loop(to, face.outline);
    to.put_each(face.holes, [&](const auto& hole) { put_loop(to, hole); });
    put_vector(to, face.box.min());
    put_vector(to, face.box.max());
    to.put(face.bspline ? 1 : 0);
    if (face.bspline) {
        put_bspline(to, *face.bspline);
    }
}

CadFace get_face(Unpacker& from) {
    CadFace face;
    face.number = from.get<int>();
    face.rows = from.get<int>();
    face.columns = from.get<int>();
    face.patches = from.get_each(sizeof(int), [&] { return get_patch(from); });
    face.outline = get_loop(from);
    face.holes = from.get_each(sizeof(std::uint64_t), [&] { return get_loop(from); });
    const Vec3 low = get_vector(from);
    face.box = Box3(low, get_vector(from));
    if (from.get<int>() != 0) {
        face.bspline = get_bspline(from);
    }
    return face;
}

} // namespace

std::string framed(const Frame& frame) {
    const std::uint64_t length = frame.bytes.size();
    std::string result(1, static_cast<char>(frame.kind));
    result.append(reinterpret_cast<const char*>(&length), sizeof length);
    return result + frame.bytes;
}

std::optional<Frame> take_frame(std::string& stream) {
    if (stream.size() < frame_head_size) {
        return std::nullopt;
    }
    const auto kind = static_cast<FrameKind>(stream.front());
    if (kind != FrameKind::progress && kind != FrameKind::error && kind != FrameKind::model) {
        throw Error("the output of the file reader is invalid");
    }
    std::uint64_t length = 0;
    std::memcpy(&length, stream.data() + 1, sizeof length);
    if (stream.size() - frame_head_size < length) {
        return std::nullopt;
    }
    Frame frame{kind, stream.substr(frame_head_size, length)};
    stream.erase(0, frame_head_size + length);
    return frame;
}

Frame progress_frame(const Progress::Report& report) {
    Packer to;
    to.put(report.fraction);
    to.put_text(report.text);
    return {FrameKind::progress, std::move(to).take()};
}

Frame error_frame(const Diagnostic& diagnostic) {
    Packer to;
    to.put(diagnostic.place.line);
    to.put_text(diagnostic.message);
    to.put_text(diagnostic.hint);
    return {FrameKind::error, std::move(to).take()};
}

Progress::Report told_progress(const Frame& frame) {
    Unpacker from(frame.bytes);
    Progress::Report report;
    report.fraction = from.get<double>();
    report.text = from.get_text();
    from.expect_end();
    return report;
}

Diagnostic told_error(const Frame& frame) {
    Unpacker from(frame.bytes);
    Diagnostic diagnostic;
    diagnostic.place.line = from.get<int>();
    diagnostic.message = from.get_text();
    diagnostic.hint = from.get_text();
    from.expect_end();
    return diagnostic;
}

std::string packed(const CadModel& model) {
    Packer to;
    to.put_text(model.unit);
    to.put_each(model.left_out, [&](const std::string& reason) { to.put_text(reason); });
    to.put_each(model.notes, [&](const std::string& note) { to.put_text(note); });
    to.put_each(model.faces, [&](const CadFace& face) { put_face(to, face); });
    return std::move(to).take();
}

CadModel unpacked(std::string_view bytes) {
    Unpacker from(bytes);
    CadModel model;
    model.unit = from.get_text();
    model.left_out = from.get_each(sizeof(std::uint64_t), [&] { return from.get_text(); });
    model.notes = from.get_each(sizeof(std::uint64_t), [&] { return from.get_text(); });
    model.faces = from.get_each(3 * sizeof(int), [&] { return get_face(from); });
    from.expect_end();
    return model;
}

} // namespace millwright::exchange
