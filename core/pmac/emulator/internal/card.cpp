#include "core/pmac/emulator/internal/card.h"

#include "core/base/error.h"

#include <algorithm>
#include <cmath>

namespace millwright::pmac::card {

namespace {

constexpr double clock_ms = 8'388'608.0; // units of I10 in a millisecond

constexpr std::uint32_t integrates = 0x500000; // what is at the address below is summed up each cycle
constexpr std::uint32_t address_mask = 0xFFFF;

/// -1: no channel's.
int channel_of_output(int address) {
    constexpr std::array<int, 4> places{0xC003, 0xC002, 0xC00B, 0xC00A};
    constexpr int gate_step = 16;
    for (int n = 0; n < 2; ++n) {
        const auto found = std::find(places.begin(), places.end(), address - gate_step * n);
        if (found != places.end()) {
            return static_cast<int>(found - places.begin()) + 4 * n;
        }
    }
    return -1;
}

} // namespace

Card::Card(const std::vector<PmacPlant>& plants, int channels)
    : p_(Variables::count), q_(Variables::count), memory_(*this), channel_count_(channels) {
    for (int n = 0; n < motors; ++n) {
        constexpr std::uint32_t first_encoder = 0xC000, encoder_step = 4;
        encoder_table_[static_cast<std::size_t>(n)] =
            first_encoder + encoder_step * static_cast<std::uint32_t>(n);
        channels_.emplace_back(n < std::ssize(plants) ? plants[static_cast<std::size_t>(n)] : PmacPlant{});
    }
    for (int n = 0; n < systems; ++n) {
        systems_.emplace_back(*this, n);
    }
    saved_ = i_.values();
    reset(false);
}

void Card::reset(bool factory) {
    i_ = factory ? IVariables() : i_;
    if (!factory) {
        i_.load(saved_);
    }
    load_settings();
    for (CoordinateSystem& system : systems_) {
        system.reset(factory);
    }
    for (int n = 0; n < motors; ++n) {
        const int wire = wires_[static_cast<std::size_t>(n)];
        constexpr int power_on_mode = 80;
        const bool closes = settings(n).active && i(variables_per_motor * (n + 1) + power_on_mode) > 0.0;
        motor(n).reset(wire >= 0 ? channel(wire).encoder() : 0.0, closes);
    }
    for (Plc& plc : plc_) {
        plc.at = 0;
    }
    flag_words_ = {};
    said_.clear();
    asked_.clear();
}

double Card::value(char kind, int index) const {
    const auto n = static_cast<std::size_t>(index);
    switch (kind) {
    case 'I':
        return i_.value(index);
    case 'P':
        return p_[n];
    case 'Q':
        return q_[n];
    default:
        return memory_.value(index);
    }
}

void Card::set(char kind, int index, double value) {
    const auto n = static_cast<std::size_t>(index);
    const double finite = std::isfinite(value) ? value : 0.0;
    switch (kind) {
    case 'I':
        i_.set(index, finite);
        load_settings();
        break;
    case 'P':
        p_[n] = finite;
        break;
    case 'Q':
        q_[n] = finite;
        break;
    default:
        memory_.set_value(index, finite);
    }
}

int Card::system_of(int motor) const {
    const auto found = std::find_if(systems_.begin(), systems_.end(), [&](const CoordinateSystem& system) {
        return system.definition(motor).exists();
    });
    return found == systems_.end() ? -1 : static_cast<int>(found - systems_.begin());
}

double Card::bias(int motor) const {
    const int owner = system_of(motor);
    return owner < 0 ? 0.0 : system(owner).definition(motor).offset;
}

StoredProgram* Card::program(int number) {
    const auto found = programs_.find(number);
    return found == programs_.end() ? nullptr : &found->second;
}

StoredProgram& Card::make_program(int number) {
    return programs_[number];
}

void Card::enable_plc(int number, bool on) {
    Plc& plc = plc_[static_cast<std::size_t>(number)];
    plc.on = on;
    plc.at = 0;
    if (on && !plc.program.sound()) {
        (void)plc.program.join();
    }
}

double Card::cycle() const {
    constexpr double shortest = 100'000.0; // units of I10: 12 us
    return std::max(i(10), shortest) / clock_ms / 1000.0;
}

/// I-variables, as the motors use them.
void Card::load_settings() {
    constexpr double sixteenth = 1.0 / 16.0;
    constexpr double per_s = 1000.0; // counts/ms
    for (int n = 0; n < motors; ++n) {
        const auto own = [&](int index) { return i(variables_per_motor * (n + 1) + index); };
        MotorSettings& to = settings_[static_cast<std::size_t>(n)];
        to.active = own(0) > 0.0;
        to.fatal_error = own(11) * sixteenth;
        to.warning_error = own(12) * sixteenth;
        to.soft_high = own(13);
        to.soft_low = own(14);
        to.abort_rate = std::max(own(15), 1e-9) * per_s * per_s;
        to.jog = {.speed = std::abs(own(22)) * per_s,
                  .acceleration = std::max(own(19), 1e-9) * per_s * per_s,
                  .acceleration_time = own(20) / per_s,
                  .s_curve_time = std::max(own(21), 0.0) / per_s};
        to.home_speed = own(23) * per_s;
        to.flags = static_cast<std::int64_t>(own(25));
        to.home_offset = own(26) * sixteenth;
        to.in_position = own(28) * sixteenth;
        to.output_bias = own(29);
        to.gain = own(30);
        to.damping = own(31);
        to.velocity_ahead = own(32);
        to.integral = own(33);
        to.integrate_at_rest = own(34) > 0.0;
        to.acceleration_ahead = own(35);
        to.position_scale = own(8);
        to.velocity_scale = own(9);
        to.most_error = std::abs(own(67)) * sixteenth;
        to.most_output = std::abs(own(69));
        to.in_position_scans = static_cast<int>(i(7)) + 1;
        const int wire = wire_of(n);
        to.wired = wire >= 0;
        wires_[static_cast<std::size_t>(n)] = wire;
        constexpr int first_encoder = 900, encoder_step = 5;
        const int encoder = first_encoder + encoder_step * std::max(wire, 0);
        to.decode = static_cast<int>(i(encoder));
        to.capture = static_cast<int>(i(encoder + 2));
        to.capture_flag = static_cast<int>(i(encoder + 3));
    }
}

/// The channel whose output a motor has and whose encoder it reads (Ix02, Ix03); -1: none. Behind the wired
/// ones are those of simulated motors, whose place is the sum of their own output.
int Card::wire_of(int motor) const {
    const auto output = static_cast<std::uint32_t>(i(variables_per_motor * (motor + 1) + 2)) & address_mask;
    const int entry = static_cast<int>(i(variables_per_motor * (motor + 1) + 3)) - encoder_table_address;
    if (entry < 0 || entry >= motors) {
        return -1;
    }
    const std::uint32_t made_of = encoder_table_[static_cast<std::size_t>(entry)];
    if (made_of == (integrates | output)) {
        return entry >= channel_count() ? entry : -1;
    }
    return entry < channel_count() && channel_of_output(static_cast<int>(output)) == entry ? entry : -1;
}

/// Wired, or summing up a simulated motor's output.
bool Card::is_there(int channel) const {
    return channel < channel_count() ||
           (encoder_table_[static_cast<std::size_t>(channel)] & ~address_mask) == integrates;
}

void Card::advance(double seconds) {
    expects(seconds >= 0.0, "time does not run backwards");
    pending_ += seconds;
    for (double step = cycle(); pending_ >= step; step = cycle()) {
        pending_ -= step;
        servo_cycle(step);
    }
}

void Card::servo_cycle(double cycle) {
    time_ += cycle;
    ++cycles_;
    if (cycles_ % (static_cast<std::int64_t>(i(8)) + 1) == 0) {
        real_time_interrupt();
    }
    for (CoordinateSystem& system : systems_) {
        system.advance(cycle);
    }
    std::array<bool, motors> driven{};
    for (int n = 0; n < motors; ++n) {
        const int wire = wires_[static_cast<std::size_t>(n)];
        if (settings(n).active) {
            const int owner = system_of(n);
            const double base = owner < 0 ? 1.0 : system(owner).percent() / 100.0;
            (void)motor(n).servo(settings(n), wire < 0 ? nowhere_ : channel(wire), cycle, base);
            handle(n, motor(n).take_event());
            driven[static_cast<std::size_t>(std::max(wire, 0))] |= wire >= 0;
        }
    }
    for (int n = 0; n < motors; ++n) {
        Channel& one = channel(n);
        if (!driven[static_cast<std::size_t>(n)]) {
            constexpr int encoder_step = 5, first_encoder = 900;
            one.advance(0.0, false, static_cast<int>(i(first_encoder + encoder_step * n)), cycle);
        }
        last_motion_ = std::abs(one.velocity()) > 0.5 ? time_ : last_motion_; // counts/s
    }
}

void Card::handle(int index, Motor::Event event) {
    if (event == Motor::Event::none) {
        return;
    }
    const int owner = system_of(index);
    if (owner >= 0) {
        system(owner).halt();
    }
    if (event == Motor::Event::limit) {
        return;
    }
    constexpr int action_place = 21, this_motor = 2;
    const std::int64_t action = settings(index).flags >> action_place & 3;
    for (int n = 0; n < motors && action < this_motor; ++n) {
        if (action == 0 || (owner >= 0 && system_of(n) == owner)) {
            motor(n).kill();
        }
    }
    for (CoordinateSystem& one : systems_) {
        if (action == 0) {
            one.halt();
        }
    }
}

void Card::kill_all() {
    for (CoordinateSystem& system : systems_) {
        system.halt();
    }
    for (Motor& motor : motors_) {
        motor.kill();
    }
}

void Card::abort_all() {
    for (CoordinateSystem& system : systems_) {
        system.abort();
    }
    for (int n = 0; n < motors; ++n) {
        if (system_of(n) < 0 && settings(n).active) {
            motor(n).abort(settings(n));
        }
    }
}

void Card::real_time_interrupt() {
    constexpr double per_statement = 40e-6; // s: what the processor of the card takes for one
    const auto room = static_cast<int>(cycle() * (i(8) + 1.0) / per_statement) + 1;
    for (CoordinateSystem& system : systems_) {
        system.calculate(room);
    }
    const int plcs_on = static_cast<int>(i(5));
    for (int n = 0; n < plcs; ++n) {
        if (plc_[static_cast<std::size_t>(n)].on && (plcs_on & (n == 0 ? 1 : 2)) != 0) {
            scan(plc_[static_cast<std::size_t>(n)]);
        }
    }
}

/// Once through the program, or to the end of a loop.
void Card::scan(Plc& plc) {
    constexpr int most = 2000;
    const auto& statements = plc.program.statements();
    if (!plc.program.sound()) {
        return;
    }
    for (int n = 0; n < most && plc.at < std::ssize(statements); ++n) {
        const Statement& one = statements[static_cast<std::size_t>(plc.at)];
        switch (one.verb) {
        case Verb::if_true:
        case Verb::while_true:
            plc.at = one.data.value(*this) > 0.0 ? plc.at + 1 : one.jump;
            continue;
        case Verb::otherwise:
            plc.at = one.jump;
            continue;
        case Verb::end_while:
            plc.at = one.jump;
            return;
        case Verb::set:
            if (const double index = one.data.value(*this); index >= 0.0 && index < Variables::count) {
                set(one.letter, static_cast<int>(index), one.value.value(*this));
            }
            break;
        case Verb::command:
            command(one.text);
            break;
        case Verb::send:
            send(one.text);
            break;
        case Verb::enable_plc:
        case Verb::disable_plc:
            for (const int number : one.numbers) {
                plc_[static_cast<std::size_t>(number)].on = one.verb == Verb::enable_plc;
            }
            break;
        default:
            break;
        }
        ++plc.at;
    }
    plc.at = 0;
}

bool Card::moving() const {
    return std::any_of(motors_.begin(), motors_.end(), [](const Motor& motor) { return motor.busy(); }) ||
           std::any_of(
               systems_.begin(), systems_.end(), [](const CoordinateSystem& one) { return one.running(); }) ||
           std::any_of(channels_.begin(), channels_.end(), [](const Channel& one) {
               return std::abs(one.velocity()) > 0.5;
           });
}

std::uint32_t Card::status_word_1(int index) const {
    return motor(index).status_word_1(settings(index));
}

std::uint32_t Card::status_word_2(int index) const {
    constexpr int assigned = 23, system_place = 20;
    const int owner = system_of(index);
    const std::uint32_t belongs =
        owner < 0 ? 0U : (1U << assigned) | (static_cast<std::uint32_t>(owner) << system_place);
    return motor(index).status_word_2() | belongs;
}

} // namespace millwright::pmac::card
