// P1, P2, P10: characters and interrupts through the registers of the ISA bus.
#include "core/base/error.h"
#include "core/base/units.h"
#include "core/links/host_port_link.h"
#include "core/pmac/driver/pmac_driver.h"
#include "core/pmac/emulator/pmac_host_port.h"
#include "tests/support/reason.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <memory>
#include <string>
#include <utility>

namespace millwright::pmac {
namespace {

using test::reason;
using ::testing::HasSubstr;

/// As the thesis talks: each character when the card is ready for it, answers until none comes any more.
struct Host {
    PmacEmulator card;
    PmacHostPort port{card};

    void pass(double seconds) {
        for (double time = 0.0; time < seconds; time += 1e-4) {
            port.advance(1e-4);
        }
    }
    void send(const std::string& line) {
        for (const char c : line + "\r") {
            while ((port.read(2) & 2U) == 0) {
                port.advance(1e-4);
            }
            port.write(7, static_cast<std::uint8_t>(c));
        }
        pass(1e-3);
    }
    std::string answer() {
        std::string text;
        while ((port.read(2) & 1U) != 0) {
            text += static_cast<char>(port.read(7));
        }
        return text;
    }
    std::string ask(const std::string& line) {
        send(line);
        return answer();
    }
};

TEST(PmacHostPortP2, CarriesEachModeOfI3ByTheBitsOfItsStatus) {
    Host host;
    host.port.write(5, 0);
    host.port.write(6, 0);
    EXPECT_EQ(host.ask("P1=25"), "\n"); // I3=1
    EXPECT_EQ(host.ask("P1"), "\n25\r\n");
    EXPECT_EQ(host.ask("garbage"), "\a\r\nERR003\r");
    EXPECT_EQ(host.ask("RHL:$720").size(), 15U); // the thesis's question whether a card is there
    (void)host.ask("I3=2");
    EXPECT_EQ(host.ask("P1"), "25\r\x06");
    (void)host.ask("I3=0");
    EXPECT_EQ(host.ask("P1"), "25\r");
    EXPECT_EQ(host.port.read(2), 2); // nothing to read, ready for more
}

TEST(PmacHostPortP2, KeepsBothDirectionsApart) {
    Host host;
    host.send("P1=7 P1");
    ASSERT_EQ(host.port.read(2) & 1U, 1U);
    host.port.write(7, 'X'); // not what is read there
    EXPECT_EQ(host.port.read(2) & 2U, 0U);
    EXPECT_EQ(host.answer(), "\n7\r\n");
    host.pass(1e-3);
    EXPECT_EQ(host.port.read(2) & 2U, 2U);
    host.port.write(5, 0x55);
    EXPECT_EQ(host.port.read(5), 0);
    EXPECT_EQ(host.port.read(4), 0xFF);
}

TEST(PmacHostPortP2, ACharacterThatIsWrittenTooEarlyTakesThePlaceOfTheOneBefore) {
    Host host;
    (void)host.ask("P1=1 P11=2");
    for (const char c : std::string("P1")) {
        host.port.write(7, static_cast<std::uint8_t>(c));
        host.port.advance(1e-4);
    }
    host.port.write(7, '1');
    host.port.write(7, '\r'); // without a look at the status
    host.pass(1e-3);
    EXPECT_EQ(host.answer(), "\n1\r\n");
}

/// The words of the thesis for its interrupt.
void initialise(PmacHostPort& port) {
    port.write(0, 0);
    port.write(8, 0x17);
    port.write(9, 0x08);
    port.write(9, 0x03);
    port.write(9, 0xDF);
    port.write(0, 0x81);
}

TEST(PmacHostPortP10, TheCompareSignalAloneGetsThrough) {
    Host host;
    initialise(host.port);
    EXPECT_EQ(host.port.read(9), 0xDF);
    EXPECT_FALSE(host.port.interrupts());
    (void)host.ask("M112->X:$C000,12 M113->X:$C000,13 M112=1 M113=1 M113=0"); // EQU1
    host.pass(1e-3);
    ASSERT_TRUE(host.port.interrupts());
    host.port.write(10, 0x40); // the routine of the thesis
    host.port.write(8, 0x40);
    host.port.write(10, 0x0B);
    EXPECT_EQ(host.port.read(8), 0x20);
    EXPECT_EQ(host.port.read(3), 0x08 + 5);
    host.port.write(8, 0x40);
    EXPECT_FALSE(host.port.interrupts()); // and the end is automatic: the next one comes
}

TEST(PmacHostPortP10, NothingComesBeforeItIsToldHowOrWhileItIsMasked) {
    Host host;
    const auto pulse = [&] {
        (void)host.ask("M112->X:$C000,12 M113->X:$C000,13 M112=1 M113=1 M113=0");
        host.pass(1e-3);
    };
    pulse();
    EXPECT_FALSE(host.port.interrupts());
    initialise(host.port);
    EXPECT_FALSE(host.port.interrupts()); // what came before is forgotten
    host.port.write(9, 0xFF);
    pulse();
    EXPECT_FALSE(host.port.interrupts());
    host.port.write(9, 0xDF);
    EXPECT_TRUE(host.port.interrupts()); // it was kept
}

/// Time that passes for card and host alike.
struct CardTime final : Clock {
    explicit CardTime(PmacHostPort& its_port) : port(its_port) {}
    [[nodiscard]] double now() const override { return time; }
    void wait(double seconds) override {
        time += seconds;
        port.advance(seconds);
    }
    PmacHostPort& port;
    double time = 0.0;
};

/// Registers that the link owns, of a port that the test owns.
struct Lent final : links::PortRegisters {
    explicit Lent(PmacHostPort& its_port) : port(&its_port) {}
    [[nodiscard]] std::string name() const override { return port->name(); }
    void open() override {}
    void close() noexcept override {}
    [[nodiscard]] std::uint8_t read(int offset) override {
        return port == nullptr ? 0xFF : port->read(offset);
    }
    void write(int offset, std::uint8_t value) override { port->write(offset, value); }
    PmacHostPort* port;
};

struct Linked : Host {
    Lent* registers = nullptr;
    std::unique_ptr<links::HostPortLink> link;

    Linked() {
        auto lent = std::make_unique<Lent>(port);
        registers = lent.get();
        link = std::make_unique<links::HostPortLink>(std::move(lent), std::make_unique<CardTime>(port));
        link->open();
    }
    std::string talk(const std::string& bytes, double seconds) {
        link->write(bytes);
        std::string said;
        for (double waited = 0.0; waited < seconds; waited += 0.01) {
            link->wait(0.01);
            said += link->read();
        }
        return said;
    }
};

TEST(PmacHostPortP1, TheLinkLosesNoCharacterOfALongText) {
    Linked host;
    std::string text, expected;
    for (int n = 0; n < 200; ++n) {
        text += "P" + std::to_string(n) + "=" + std::to_string(3 * n) + "\r";
        expected += "\n";
    }
    for (int n = 0; n < 200; ++n) {
        text += "P" + std::to_string(n) + "\r";
        expected += "\n" + std::to_string(3 * n) + "\r\n";
    }
    EXPECT_EQ(host.talk(text, 4.0), expected);
    EXPECT_FALSE(host.link->lost());
}

TEST(PmacHostPortP1, SaysThatNoCardIsThereOrThatItTakesNothing) {
    Linked host;
    host.registers->port = nullptr;
    EXPECT_THAT(reason([&] { host.link->open(); }), HasSubstr("no card answers at"));
    Linked gone;
    gone.registers->port = nullptr;
    EXPECT_EQ(gone.link->read(), "");
    EXPECT_THAT(gone.link->lost().value_or(""), HasSubstr("the card no longer answers"));

    struct Busy final : links::PortRegisters {
        [[nodiscard]] std::string name() const override { return "busy"; }
        void open() override {}
        void close() noexcept override {}
        [[nodiscard]] std::uint8_t read(int /*offset*/) override { return 0; }
        void write(int /*offset*/, std::uint8_t /*value*/) override {}
    };
    Host other;
    links::HostPortLink busy(std::make_unique<Busy>(), std::make_unique<CardTime>(other.port));
    busy.open();
    busy.write("P1\r");
    EXPECT_FALSE(busy.lost());
    busy.wait(0.6);
    EXPECT_THAT(busy.lost().value_or(""), HasSubstr("accepts no characters"));
}

TEST(PmacHostPortP1, AnAddressNamesIt) {
    EXPECT_EQ(links::make_link("isa:0x210")->name(), "isa:0x210");
    EXPECT_EQ(links::make_link("isa:528")->name(), "isa:0x210");
    EXPECT_THAT(reason([] { (void)links::make_link("isa:nowhere"); }), HasSubstr("not a valid address"));
    EXPECT_THAT(reason([] { (void)links::make_link("isa:0x10000"); }), HasSubstr("not a valid address"));
}

} // namespace
} // namespace millwright::pmac
