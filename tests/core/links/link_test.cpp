#include "core/links/link.h"

#include "core/base/error.h"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <string>

namespace millwright::links {
namespace {

using ::testing::HasSubstr;

TEST(Link, IsATcpConnectionOrASerialPortByItsAddress) {
    EXPECT_EQ(make_link("tcp:localhost:2300")->name(), "tcp:localhost:2300");
    EXPECT_EQ(make_link("/dev/ttyUSB7")->name(), "/dev/ttyUSB7");
}

TEST(Link, RefusesWhatIsNoAddress) {
    for (const char* address :
         {"", "tcp:", "tcp:host", "tcp::12", "tcp:host:0", "tcp:host:65536", "tcp:host:1x"}) {
        EXPECT_THROW((void)make_link(address), Error) << address;
    }
}

/// Why the port at `path` cannot be opened.
std::string port_refusal(const std::string& path) {
    try {
        make_link(path)->open();
    } catch (const Error& error) {
        return error.what();
    }
    return "opened";
}

TEST(Link, SaysWhatToDoAboutASerialPortThatCannotBeOpened) {
    EXPECT_THAT(port_refusal("/dev/does-not-exist"),
                HasSubstr("there is no such serial port (plug the controller in and switch it on, or choose "
                          "another port: the computer has "));
    EXPECT_THAT(port_refusal("/dev/null"),
                HasSubstr("/dev/null: this is not a serial port (choose another one: the computer has "));
}

TEST(Link, TellsWhyNothingCanBeOpened) {
    EXPECT_THROW(make_link("/dev/does-not-exist")->open(), Error);
    EXPECT_THROW(make_link("tcp:127.0.0.1:1")->open(), Error);
}

TEST(Link, IsLostBeforeItIsOpened) {
    const auto link = make_link("/dev/ttyUSB7");
    EXPECT_TRUE(link->lost());
    link->write("nobody hears this");
    EXPECT_EQ(link->read(), "");
}

} // namespace
} // namespace millwright::links
