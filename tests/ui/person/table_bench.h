// An emulated table that takes records at a pseudo-terminal, for a person to connect to.
#pragma once

#include "core/emulators/emulator.h"
#include "core/emulators/table/table_emulator.h"
#include "core/links/pseudo_terminal.h"
#include "tests/support/machines.h"

#include <cstdint>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace millwright::test {

class TableBench {
public:
    /// A forming table that obeys records of the usual form at once and answers each by `ok`.
    explicit TableBench(const emulators::TableOptions& options = {}) {
        auto terminal = std::make_unique<links::PseudoTerminal>();
        terminal->open();
        port_ = terminal->path().string();
        std::vector<std::unique_ptr<links::Link>> links;
        links.push_back(std::move(terminal));
        drivers::RecordFormat format;
        format.answer = "ok";
        auto table = std::make_unique<emulators::TableEmulator>(format, machine("forming-table"), options);
        table_ = table.get();
        server_ = std::make_unique<emulators::EmulatorServer>(std::move(links), clock_, std::move(table));
    }

    [[nodiscard]] const std::string& port() const { return port_; }
    /// Records that were obeyed.
    [[nodiscard]] std::int64_t records() {
        return server_->with_emulator([this](emulators::Emulator&) { return table_->records(); });
    }
    [[nodiscard]] std::int64_t bad_lines() {
        return server_->with_emulator([this](emulators::Emulator&) { return table_->bad_lines(); });
    }
    /// mm of X, Y and Z.
    [[nodiscard]] std::vector<double> position() {
        return server_->with_emulator([this](emulators::Emulator&) { return table_->position(); });
    }

    /// All that it went to, if it keeps them.
    [[nodiscard]] std::vector<std::vector<double>> positions() {
        return server_->with_emulator([this](emulators::Emulator&) { return table_->positions(); });
    }

private:
    SteadyClock clock_;
    std::string port_;
    emulators::TableEmulator* table_ = nullptr; ///< lives in the server
    std::unique_ptr<emulators::EmulatorServer> server_;
};

} // namespace millwright::test
