// The session of a GrblWire as a Driver.
#pragma once

#include "tests/core/drivers/grbl/grbl_wire.h"

#include <optional>

namespace millwright::test {

class WireDriver final : public drivers::Driver {
public:
    /// `checks`: a dispatcher reads what it is given before.
    explicit WireDriver(GrblWire& wire, bool checks = false) : wire_(wire), checks_(checks) {}

    [[nodiscard]] std::string name() const override { return "grbl"; }
    [[nodiscard]] drivers::DriverStatus status() const override { return wire_.session.status(); }
    [[nodiscard]] drivers::Capabilities capabilities() const override {
        using kinematics::AxisKind;
        drivers::Capabilities able;
        able.axes = {{'X', AxisKind::linear}, {'Y', AxisKind::linear}, {'Z', AxisKind::linear}};
        able.dialect = checks_ ? std::optional(gcode::Dialect::grbl) : std::nullopt;
        able.takes = drivers::Capabilities::Takes::text;
        able.overrides = drivers::Capabilities::OverrideRange::feed;
        able.program.single_block = able.program.piecewise = true;
        return able;
    }
    void connect() override {}
    void start(drivers::Work work) override {
        wire_.session.start(
            drivers::grbl::program_lines(*work.listing, "test.ngc"), wire_.now, std::move(work.ahead));
    }
    void hold() override { wire_.session.hold(wire_.now); }
    void resume() override { wire_.session.resume(wire_.now); }
    void stop() override { wire_.session.stop(wire_.now); }
    void emergency_stop() override { wire_.session.emergency_stop(wire_.now); }
    void reset() override { wire_.session.reset(wire_.now); }
    void trust_position() override { wire_.session.trust_position(); }
    void doubt_position(std::string why, bool lost) override {
        wire_.session.doubt_position(std::move(why), lost);
    }
    void close() noexcept override {}
    void set_overrides(const drivers::Overrides& wanted) override { wire_.session.set_overrides(wanted); }
    void set_single_block(bool on) override { wire_.session.set_single_block(on); }

private:
    GrblWire& wire_;
    bool checks_;
};

} // namespace millwright::test
