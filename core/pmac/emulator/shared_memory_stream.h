// Points to an emulated PMAC through its dual-ported RAM, by the hand-shake of the thesis: three words and
// two flags in the RAM, and EQU1 back, an interrupt of the host port. After Saengsasri, Nittayachin 1996
// (KMITL), whose own loop is commented out and whose program for the card is lost:
// docs/reference/pmac.md#streaming.
#pragma once

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace millwright::pmac {

/// The RAM and what goes through it, as both sides see it now.
struct SharedMemoryBuffer {
    double time = 0.0;                   ///< of the card since the first point, s
    std::array<std::int32_t, 3> words{}; ///< M151, M152, M153: X, Y and Z in thousandths of a degree
    bool runs = false;                   ///< M154: the card's program goes on
    bool ready = false;                  ///< M155: a point waits in the words
    int sent = 0;                        ///< points that were written
    int taken = 0;                       ///< interrupts of EQU1: points that the card has taken
    std::array<double, 3> position{};    ///< of the motors, deg
};

class SharedMemoryStream {
public:
    using Point = std::array<double, 3>; ///< X, Y, Z, deg

    /// The card begins at `points.front()`, and takes as long for each move that no axis is faster than
    /// `deg_per_s`. Throws Error without a point, or beyond what a word holds.
    SharedMemoryStream(std::vector<Point> points, double deg_per_s);
    SharedMemoryStream(const SharedMemoryStream&) = delete;
    SharedMemoryStream& operator=(const SharedMemoryStream&) = delete;
    ~SharedMemoryStream();

    /// Lets the card and its host go on for `seconds`, or until the buffer has changed. Throws Error if the
    /// card ends its program on its own.
    void advance(double seconds);
    [[nodiscard]] const SharedMemoryBuffer& buffer() const;
    [[nodiscard]] int count() const;        ///< of points
    [[nodiscard]] double move_time() const; ///< of each, s
    /// Every point was taken, and the motors stand.
    [[nodiscard]] bool finished() const;
    /// M154 = 0: the card goes to the point that it has, and no further.
    void stop();

private:
    class Body;
    std::unique_ptr<Body> body_;
};

} // namespace millwright::pmac
