#include "core/cordic_rtl/processor_rtl.h"

#include <array>
#include <random>

namespace millwright::cordic {
namespace {

/// Writes instructions into pages of the program ROM, and PAGE where the next one would cross an end.
class ProgramWriter {
public:
    explicit ProgramWriter(const NumberFormat& format) : image_{.format = format} {}

    void put(const Instruction& instruction) {
        const std::size_t size =
            1U + static_cast<std::size_t>(operand_bytes(instruction.opcode, image_.format));
        if (image_.code.size() % rom_size + size + 1 > rom_size) {
            append(image_.code, {.opcode = Opcode::page}, image_.format);
            image_.code.resize(page_count(image_.code.size()) * rom_size, 0xff);
            ++count_;
        }
        append(image_.code, instruction, image_.format);
        ++count_;
    }
    void put(Opcode opcode) { put({.opcode = opcode}); }
    void move(Register target, Word word) { put({Opcode::mov, target, to_immediate(image_.format, word)}); }
    void load(Register target, Word address) { put({Opcode::ld, target, address}); }
    void store(Register source, Word address) { put({Opcode::st, source, address}); }
    void byte(std::uint8_t value) { image_.code.push_back(value); }
    /// A jump over `bytes` bytes that are no instructions.
    void jump(int bytes) {
        constexpr int opcode_byte = 1;
        const auto size = static_cast<std::size_t>(opcode_byte + immediate_bytes(image_.format) + bytes);
        if (image_.code.size() % rom_size + size + 2 > rom_size) {
            return;
        }
        move(Register::PC, (image_.code.size() + size) % rom_size);
        image_.code.resize(image_.code.size() + static_cast<std::size_t>(bytes), 0xff);
    }

    [[nodiscard]] std::int64_t count() const { return count_; }
    [[nodiscard]] const Image& image() const { return image_; }

private:
    Image image_;
    std::int64_t count_ = 0;
};

/// Places within an eighth of the range, arcs between lines: so that nothing overflows on the way.
class RandomProgram {
public:
    RandomProgram(const NumberFormat& format, std::uint64_t seed)
        : writer_(format), random_(seed), largest_(FixedArithmetic(format).largest()), place_(largest_ / 8),
          format_(format) {}

    [[nodiscard]] Image made(std::int64_t instructions) {
        speed();
        while (writer_.count() < instructions) {
            block();
        }
        writer_.put(Opcode::m30);
        return writer_.image();
    }

private:
    void block() {
        constexpr unsigned kinds = 16;
        switch (random_() % kinds) {
        case 0:
            return speed();
        case 1:
        case 2:
        case 3:
            return arc(false);
        case 4:
        case 5:
            return arc(true);
        case 6:
        case 7:
            return space_line();
        case 8:
            return command();
        case 9:
            return memory();
        case 10:
            return writer_.jump(static_cast<int>(random_() % 4));
        case 11:
            return writer_.put(random_() % 2 != 0 ? Opcode::nop : Opcode::g01); // G01: to where the axes are
        default:
            return line();
        }
    }

    void line() {
        constexpr unsigned kinds = 9;
        const auto kind = static_cast<unsigned>(random_() % kinds);
        switch (kind) {
        case 0: // along an axis
            x_to(number(place_));
            break;
        case 1:
            y_to(number(place_));
            break;
        case 2: // as short as can be
            x_to(x_ + 1);
            y_to(y_ - 1);
            break;
        case 3: // at 45 degrees exactly, either way
            at_45_degrees(y_ - x_);
            break;
        case 4:
            at_45_degrees(y_ + x_);
            break;
        default:
            x_to(number(place_));
            y_to(number(place_));
        }
        writer_.put(random_() % 2 != 0 ? Opcode::g00 : Opcode::g01);
    }
    void at_45_degrees(std::int64_t y) {
        const bool near = y <= 2 * place_ && y >= -2 * place_;
        y_to(near ? y : 0);
        x_to(0);
    }
    void x_to(std::int64_t x) {
        x_ = x;
        writer_.move(Register::XI, word(x));
    }
    void y_to(std::int64_t y) {
        y_ = y;
        writer_.move(Register::YJ, word(y));
    }
    void space_line() {
        const unsigned kind = static_cast<unsigned>(random_() % 4);
        if (kind != 0) { // else straight up or down
            x_to(number(place_));
            y_to(number(place_));
        }
        if (kind != 1) {
            writer_.move(Register::Z, word(number(place_)));
        }
        writer_.put(random_() % 2 != 0 ? Opcode::g00z : Opcode::g01z);
    }
    void arc(bool helix) {
        constexpr int most_chords = 4;
        constexpr std::int64_t of_rise = 64;
        writer_.move(Register::XI, word(number(place_)));
        writer_.move(Register::YJ, word(number(place_)));
        writer_.move(Register::Dz, word(number(angle())));
        writer_.move(Register::N, 1 + random_() % most_chords);
        if (helix) {
            writer_.move(Register::Z, word(number(largest_ / of_rise)));
        }
        const bool g02 = random_() % 2 != 0;
        writer_.put(helix ? (g02 ? Opcode::g02z : Opcode::g03z) : g02 ? Opcode::g02 : Opcode::g03);
        x_to(number(place_));
        y_to(number(place_));
        writer_.move(Register::Z, word(number(place_)));
        writer_.put(helix ? Opcode::g01z : Opcode::g01);
    }
    void speed() {
        writer_.move(Register::Vmax, word(1 + positive(largest_ / 2)));
        writer_.move(Register::Amax, word(1 + positive(largest_ / 2)));
    }
    void command() {
        constexpr std::array codes = {Opcode::g04,
                                      Opcode::m00,
                                      Opcode::m01,
                                      Opcode::m03,
                                      Opcode::m04,
                                      Opcode::m05,
                                      Opcode::m06,
                                      Opcode::m07,
                                      Opcode::m08,
                                      Opcode::m09,
                                      Opcode::muser};
        writer_.move(Register::P, random_() & 0xffffffffU);
        writer_.put(codes[random_() % codes.size()]);
    }
    /// A register into the RAM, or the port behind it, and back.
    void memory() {
        constexpr std::array kept = {
            Register::XI, Register::Vmax, Register::N, Register::X0, Register::Z0, Register::P};
        const Register name = kept[random_() % kept.size()];
        const std::uint64_t room = 0x10000U - ram_begin - 8U;
        Word address = ram_begin + random_() % room;
        if (crosses_memories(static_cast<std::uint16_t>(address), immediate_bytes(format_))) {
            address = ram_begin;
        }
        writer_.store(name, address);
        writer_.load(name, address);
        writer_.store(static_cast<Register>(random_() % register_count), ram_begin);
    }

    /// The largest angle to turn by, below a quarter turn.
    [[nodiscard]] std::int64_t angle() const {
        constexpr double most = 1.5;
        bool beyond = false;
        return FixedArithmetic(format_).from_double(most, beyond);
    }
    [[nodiscard]] std::int64_t positive(std::int64_t most) {
        return static_cast<std::int64_t>(random_() % static_cast<std::uint64_t>(most));
    }
    [[nodiscard]] std::int64_t number(std::int64_t most) {
        constexpr unsigned small_every = 8; // one in so many is a unit or a few
        const std::int64_t size = random_() % small_every == 0 ? std::min<std::int64_t>(most, 3) : most;
        return positive(2 * size + 1) - size;
    }
    [[nodiscard]] static Word word(std::int64_t number) { return static_cast<Word>(number); }

    ProgramWriter writer_;
    std::mt19937_64 random_;
    std::int64_t largest_;
    std::int64_t place_;
    std::int64_t x_ = 0, y_ = 0; ///< XI and YJ
    NumberFormat format_;
};

/// What `write` puts behind speeds that are in order.
template <class Write> Image short_program(const NumberFormat& format, Write&& write) {
    ProgramWriter writer(format);
    writer.move(Register::Vmax, 3);
    writer.move(Register::Amax, 4);
    write(writer);
    return writer.image();
}

} // namespace

std::vector<Image>
rtl_test_programs(const NumberFormat& format, std::int64_t instructions, std::uint64_t seed) {
    const FixedArithmetic arithmetic(format);
    const auto largest = static_cast<Word>(arithmetic.largest());
    const auto least = static_cast<Word>(-arithmetic.largest() - 1);
    std::vector<Image> programs = {RandomProgram(format, seed).made(instructions)};
    const auto add = [&](auto&& write) { programs.push_back(short_program(format, write)); };
    add([](ProgramWriter& w) { w.put(Opcode::hlt); });
    add([](ProgramWriter& w) { w.put(Opcode::m02); });
    add([](ProgramWriter& w) { w.byte(0x03); }); // no instruction
    add([](ProgramWriter& w) { w.move(Register::Vmax, 0); });
    add([](ProgramWriter& w) { w.move(Register::Amax, ~Word{0}); });
    add([](ProgramWriter& w) { w.move(Register::PC, 0x10000); });
    add([](ProgramWriter& w) { w.load(Register::XI, 0xfffe); });  // behind the last address
    add([](ProgramWriter& w) { w.store(Register::XI, 0x7ffe); }); // across memories
    add([](ProgramWriter& w) { w.store(Register::XI, 0x0100); }); // into the ROM
    add([](ProgramWriter& w) { w.put(Opcode::page); });
    add([](ProgramWriter& w) { w.put(Opcode::g02); }); // no chord
    add([&](ProgramWriter& w) {                        // the range from end to end
        w.move(Register::X0, least);
        w.move(Register::XI, largest);
        w.put(Opcode::g01);
    });
    add([&](ProgramWriter& w) { // a number beyond the word, where the immediate has room for it
        w.move(Register::YJ, largest + 1);
        w.put(Opcode::hlt);
    });
    add([&](ProgramWriter& w) { // a number whose opposite the word does not have
        w.move(Register::X0, least);
        w.put(Opcode::g00z);
        w.put(Opcode::hlt);
    });
    for (const Word dz : {largest, least, largest / 2 + largest / 4, largest / 2}) {
        add([dz](ProgramWriter& w) { // at and beyond what the steps turn by
            w.move(Register::X0, 5);
            w.move(Register::Dz, dz);
            w.move(Register::N, 2);
            w.put(Opcode::g03);
            w.put(Opcode::hlt);
        });
    }
    ProgramWriter bare(format);
    bare.move(Register::XI, 7);
    bare.put(Opcode::g00); // without a speed
    programs.push_back(bare.image());
    return programs;
}

} // namespace millwright::cordic
