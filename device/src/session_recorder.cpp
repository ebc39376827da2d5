// Saves, loads and replays sessions.
#include "feeler/device/session_recorder.hpp"

#include <array>
#include <bit>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <string>

namespace feeler {
namespace {

static_assert(std::endian::native == std::endian::little, "the file is written as it lies in memory");

using Word = std::uint64_t;
constexpr Word magic = 0x31'53'45'53'4C'45'45'46;  // "FEELSES1" in the order of the file

/// Visits the values of a thing in the order of the file; one list for writing and reading.
template <class Tick, class Visit>
void visit_tick(Tick& record, const Visit& visit) {
  auto& tick = record.tick;
  visit(tick.now), visit(tick.period), visit(tick.age), visit(tick.status), visit(tick.request);
  for (auto& p : tick.state.pose.position) visit(p);
  for (auto& q : tick.state.pose.orientation) visit(q);
  visit(tick.state.buttons), visit(tick.state.time), visit(tick.state.motor_temperature);
  for (auto* wrench : {&tick.wanted, &record.pushed}) {
    for (auto& f : wrench->force) visit(f);
    for (auto& t : wrench->torque) visit(t);
  }
  visit(record.phase), visit(record.fault);
}

template <class Recording, class Visit>
void visit_head(Recording& recording, const Visit& visit) {
  auto& device = recording.device;
  visit(device.nominal_rate), visit(device.maximum_force), visit(device.continuous_force);
  visit(device.maximum_torque), visit(device.continuous_torque);
  for (auto& is_pushed : device.is_pushed) visit(is_pushed);
  auto& limits = recording.limits;
  visit(limits.maximum_force), visit(limits.continuous_force), visit(limits.maximum_torque);
  visit(limits.continuous_torque), visit(limits.force_slew), visit(limits.torque_slew), visit(limits.free_force);
  visit(limits.free_torque), visit(limits.ramp_time), visit(limits.fade_time), visit(limits.latest_tick);
  visit(limits.heating_time), visit(limits.warm_temperature), visit(recording.lost);
}

template <class Value>
Word to_word(const Value& value) {
  if constexpr (std::is_same_v<Value, double>) {
    return std::bit_cast<Word>(value);
  } else {
    return static_cast<Word>(value);
  }
}

template <class Value>
void from_word(Word word, Value& value) {
  if constexpr (std::is_same_v<Value, double>) {
    value = std::bit_cast<double>(word);
  } else {
    value = static_cast<Value>(word);
  }
}

[[noreturn]] void fail(const std::filesystem::path& file, const char* what) { throw std::runtime_error("The session " + file.string() + what); }

bool is_same(const DeviceWrench& a, const DeviceWrench& b) noexcept { return std::memcmp(&a, &b, sizeof a) == 0; }

}  // namespace

SessionRecorder::SessionRecorder(std::size_t capacity) : ticks_(capacity) {}

void SessionRecorder::describe(const DeviceSpecification& device, const ForceLimits& limits) {
  device_ = device;
  limits_ = limits;
  count_ = 0;
  lost_ = 0;
}

SessionRecording SessionRecorder::recording() const { return {device_, limits_, {ticks_.begin(), ticks_.begin() + std::ptrdiff_t(count_)}, lost_}; }

void save(const SessionRecording& recording, const std::filesystem::path& file) {
  std::vector<Word> words{magic, Word(recording.ticks.size()), Word(recording.device.name.size())};
  const auto append = [&words](const auto& value) { words.push_back(to_word(value)); };
  for (const char letter : recording.device.name) append(static_cast<unsigned char>(letter));
  visit_head(recording, append);
  for (const SessionTick& tick : recording.ticks) visit_tick(tick, append);

  std::ofstream out(file, std::ios::binary);
  out.write(reinterpret_cast<const char*>(words.data()), std::streamsize(words.size() * sizeof(Word)));
  out.close();
  if (!out) fail(file, " cannot be written: check the folder and the room on the disk.");
}

SessionRecording load_session(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) fail(file, " cannot be read: check its name.");
  const auto next = [&] {
    Word word = 0;
    if (!in.read(reinterpret_cast<char*>(&word), sizeof word)) fail(file, " was cut off: record it again.");
    return word;
  };
  if (next() != magic) fail(file, " is no recording of this version of Feeler: record it again.");
  const Word count = next();
  const Word letters = next();
  if (letters > 1000) fail(file, " has a name that is too long: record it again.");
  SessionRecording recording;
  for (Word i = 0; i < letters; ++i) recording.device.name.push_back(static_cast<char>(next()));
  const auto take = [&next](auto& value) { from_word(next(), value); };
  visit_head(recording, take);
  // One by one, so that a count that is wrong ends with the file and not with the memory.
  for (Word i = 0; i < count; ++i) visit_tick(recording.ticks.emplace_back(), take);
  return recording;
}

Replay replay(const SessionRecording& recording, const std::function<DeviceWrench(const DeviceState&)>& render) {
  ForceSafety safety(recording.limits, recording.device);
  Replay result;
  for (const SessionTick& recorded : recording.ticks) {
    ForceSafety::Tick tick = recorded.tick;
    const bool was_rendered = tick.status == DeviceStatus::ok || tick.status == DeviceStatus::warning;
    if (render && was_rendered) tick.wanted = render(tick.state);
    const auto index = std::int64_t(result.ticks++);
    if (result.first_other_wish < 0 && !is_same(tick.wanted, recorded.tick.wanted)) result.first_other_wish = index;
    if (result.first_other_push < 0 && !is_same(safety.step(tick), recorded.pushed)) result.first_other_push = index;
  }
  return result;
}

}  // namespace feeler
