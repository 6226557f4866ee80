#include "server/drivers/modbus_device.h"

#include <modbus/modbus.h>

#include <algorithm>
#include <array>
#include <cerrno>
#include <chrono>
#include <cstdint>
#include <optional>

#include "core/base/diagnostics.h"
#include "core/model/endpoint.h"

namespace armloom {
namespace {

using Wall = std::chrono::steady_clock;

// Time from the end of a connection to the next attempt, and from a refused value of an output to
// the next one.
constexpr std::chrono::seconds kTriesAgain{1};
// The protocol allows 125 registers in one request, and more bits.
constexpr int kBlockMax = 120;

const SignalDescription::Place& place_of(const IoDescription& io, SignalId signal) {
  return *io.signal(signal).place;
}

}  // namespace

ModbusDevice::ModbusDevice(const IoDescription& io, IoDeviceId device, Report report)
    : io_(io),
      device_(io.devices[device.index()]),
      signals_(io.signals_of(device)),
      blocks_(blocks_of(io, device)),
      report_(std::move(report)),
      thread_([this](const std::stop_token& stop) { run(stop); }) {}

ModbusDevice::~ModbusDevice() = default;

void ModbusDevice::write(SignalId signal, const SignalValue& value) {
  {
    const std::scoped_lock lock(mutex_);
    if (is_up_) outputs_.emplace_back(signal, value);
  }
  wakes_.notify_one();
}

// Only adjacent addresses are read together: many devices refuse a block with a gap.
std::vector<ModbusDevice::Block> ModbusDevice::blocks_of(const IoDescription& io,
                                                         IoDeviceId device) {
  std::vector<SignalId> sorted = io.signals_of(device);
  std::ranges::sort(sorted, {}, [&](SignalId signal) {
    return std::pair(place_of(io, signal).table, place_of(io, signal).address);
  });
  std::vector<Block> blocks;
  for (const SignalId signal : sorted) {
    const auto& [name, table, address] = place_of(io, signal);
    const bool goes_on = !blocks.empty() && blocks.back().table == table &&
                         blocks.back().first + std::ssize(blocks.back().signals) == address &&
                         std::ssize(blocks.back().signals) < kBlockMax;
    if (!goes_on) blocks.push_back({table, address, {}});
    blocks.back().signals.push_back(signal);
  }
  return blocks;
}

void ModbusDevice::run(const std::stop_token& stop) {
  std::optional<std::string> told;
  while (!stop.stop_requested()) {
    bool was_up = false;
    std::string why = serve(stop);
    {
      const std::scoped_lock lock(mutex_);
      was_up = std::exchange(is_up_, false);
      outputs_.clear();
    }
    if (stop.stop_requested()) return;
    if (was_up || told != why) report_({device_.name, false, why, {}});
    told = std::move(why);
    (void)wait(stop, Wall::now() + kTriesAgain);
  }
}

// Returns why the connection has ended, or could not be made.
std::string ModbusDevice::serve(const std::stop_token& stop) {
  std::string fault;
  const Connection connection = connect(fault);
  if (!connection) return fault;
  Session session{connection.get(), blocks_};
  fault = write_fail_states(session);
  std::optional<IoReport> told;
  std::deque<Output> outputs;
  while (fault.empty()) {
    for (const Output& output : outputs) {
      if (fault.empty()) fault = write_out(session, output);
    }
    IoReport report{device_.name, true};
    if (fault.empty()) fault = read_all(session, report);
    if (!fault.empty()) break;
    const bool is_news = !told || told->values != report.values || told->faults != report.faults;
    if (is_news || !outputs.empty()) {
      {
        const std::scoped_lock lock(mutex_);
        is_up_ = true;
      }
      report_(report);
      told = std::move(report);
    }
    outputs =
        wait(stop, Wall::now() + std::chrono::duration_cast<Wall::duration>(device_.poll_period));
    if (stop.stop_requested()) return write_fail_states(session);
  }
  return fault;
}

// A device refuses a block if it refuses one address of it, so that the block is then read address
// by address.
std::string ModbusDevice::read_all(Session& session, IoReport& report) const {
  std::vector<Block>& blocks = session.blocks;
  for (std::size_t b = 0; b < blocks.size(); ++b) {
    const Fault fault = read_in(session.to, blocks[b], report.values);
    if (fault.text.empty()) continue;
    if (!fault.is_refused) return fault.text;
    const Block whole = blocks[b];
    if (whole.signals.size() == 1) {
      report.faults.emplace(io_.signal(whole.signals.front()).name, fault.text);
      continue;
    }
    blocks.erase(blocks.begin() + static_cast<std::ptrdiff_t>(b));
    for (std::size_t i = whole.signals.size(); i-- > 0;) {
      blocks.insert(blocks.begin() + static_cast<std::ptrdiff_t>(b),
                    {whole.table, whole.first + static_cast<int>(i), {whole.signals[i]}});
    }
    --b;  // the first of the new blocks
  }
  std::erase_if(session.writes,
                [now = Wall::now()](const auto& write) { return write.second.until <= now; });
  for (const auto& [signal, refusal] : session.writes) {
    report.faults.emplace(io_.signal(signal).name, refusal.text);
  }
  return {};
}

ModbusDevice::Connection ModbusDevice::connect(std::string& fault) const {
  const Endpoint endpoint = *parse_endpoint(device_.endpoint);
  Connection made(modbus_new_tcp_pi(endpoint.host.c_str(), endpoint.port.c_str()), [](_modbus* of) {
    modbus_close(of);
    modbus_free(of);
  });
  const auto us = std::chrono::duration_cast<std::chrono::microseconds>(device_.timeout).count();
  const auto whole_s = static_cast<std::uint32_t>(us / 1'000'000);
  const auto rest_us = static_cast<std::uint32_t>(us % 1'000'000);
  const bool is_made = made && modbus_set_response_timeout(made.get(), whole_s, rest_us) == 0 &&
                       modbus_set_slave(made.get(), device_.unit) == 0 &&
                       modbus_connect(made.get()) == 0;
  if (is_made) return made;
  fault = "no connection to " + device_.endpoint + ": " + modbus_strerror(errno);
  return {nullptr, [](_modbus*) {}};
}

std::string ModbusDevice::write_out(Session& session, const Output& output) const {
  const auto& [signal, value] = output;
  const auto& [name, table, address] = place_of(io_, signal);
  const bool* flag = std::get_if<bool>(&value);
  const int written =
      flag != nullptr ? modbus_write_bit(session.to, address, *flag ? 1 : 0)
                      : modbus_write_register(session.to, address, std::get<std::uint16_t>(value));
  if (written == 1) {
    session.writes.erase(signal);
    return {};
  }
  Fault fault = fault_at("writing", table, address);
  if (!fault.is_refused) return fault.text;
  session.writes[signal] = {fault.text + " (value " + text_of(value) + ")",
                            Wall::now() + kTriesAgain};
  return {};
}

std::string ModbusDevice::write_fail_states(Session& session) const {
  std::string fault;
  for (const SignalId signal : signals_) {
    const auto& value = io_.signal(signal).fail_state;
    if (value && fault.empty()) fault = write_out(session, {signal, *value});
  }
  return fault;
}

ModbusDevice::Fault ModbusDevice::read_in(_modbus* from, const Block& block,
                                          std::map<std::string, SignalValue>& values) const {
  std::array<std::uint8_t, kBlockMax> bits{};
  std::array<std::uint16_t, kBlockMax> registers{};
  const auto size = static_cast<int>(block.signals.size());
  const auto read = [&] {
    switch (block.table) {
      case ModbusTable::coil:
        return modbus_read_bits(from, block.first, size, bits.data());
      case ModbusTable::discrete_input:
        return modbus_read_input_bits(from, block.first, size, bits.data());
      case ModbusTable::holding_register:
        return modbus_read_registers(from, block.first, size, registers.data());
      case ModbusTable::input_register:
        return modbus_read_input_registers(from, block.first, size, registers.data());
    }
    return -1;
  };
  if (read() != size) return fault_at("reading", block.table, block.first);
  for (std::size_t i = 0; i < block.signals.size(); ++i) {
    values.emplace(io_.signal(block.signals[i]).name, is_of_bits(block.table)
                                                          ? SignalValue(bits.at(i) != 0)
                                                          : SignalValue(registers.at(i)));
  }
  return {};
}

ModbusDevice::Fault ModbusDevice::fault_at(const char* doing, ModbusTable table,
                                           int address) const {
  const int error = errno;
  const std::string place = std::string(doing) + " " + to_string(table) + " " +
                            std::to_string(address) + " of unit " + std::to_string(device_.unit);
  if (error == ETIMEDOUT) {
    return {place + ": no answer within " + text_of(to_seconds(device_.timeout)) + " s"};
  }
  const bool is_refused = error == EMBXILFUN || error == EMBXILADD || error == EMBXILVAL;
  return {place + ": " + modbus_strerror(error), is_refused};
}

// Returns the outputs that are to be written: at once when there are some, else none at `until`.
std::deque<ModbusDevice::Output> ModbusDevice::wait(const std::stop_token& stop,
                                                    Wall::time_point until) {
  std::unique_lock lock(mutex_);
  wakes_.wait_until(lock, stop, until, [this] { return !outputs_.empty(); });
  return std::exchange(outputs_, {});
}

}  // namespace armloom
