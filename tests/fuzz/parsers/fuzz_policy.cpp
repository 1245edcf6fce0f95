// parse_policy: whatever is read is written and read back as the same policy. Most changes to a policy file end at its
// header's length or at its checksum; the mutator here makes changes that go deeper and mends both.

#include <folk/games/random.h>
#include <folk/sct/policy/policy_file.h>

#include <algorithm>
#include <bit>
#include <cctype>
#include <cstring>
#include <string>
#include <utility>

#include "fuzz.h"

namespace {

using folk::RandomStream;

constexpr std::size_t length_bytes = 8;

std::size_t below(RandomStream& random, std::size_t bound) { return static_cast<std::size_t>(random() % bound); }

/// A policy file as its two changeable parts.
struct Parts {
  std::string header;
  std::string data;

  static Parts of(std::string_view bytes) {
    std::uint64_t length = 0;
    for (std::size_t i = 0; i < length_bytes && i < bytes.size(); ++i)
      length |= std::uint64_t{static_cast<unsigned char>(bytes[i])} << (8 * i);
    bytes.remove_prefix(std::min(bytes.size(), length_bytes));
    const auto header = bytes.substr(0, std::min<std::uint64_t>(length, bytes.size()));
    return {std::string(header), std::string(bytes.substr(header.size()))};
  }

  std::string bytes() const {
    std::string length;
    for (std::size_t i = 0; i < length_bytes; ++i) length += static_cast<char>((header.size() >> (8 * i)) & 0xFFU);
    return length + header + data;
  }
};

/// Where a value of the header, a text without its quotes or a number, begins and how long it is.
std::pair<std::size_t, std::size_t> value(RandomStream& random, const std::string& header) {
  std::size_t begin = below(random, header.size());
  const auto in_value = [&](std::size_t i) { return std::strchr("\"{}[]:,", header[i]) == nullptr; };
  while (begin < header.size() && !in_value(begin)) ++begin;
  while (begin > 0 && begin < header.size() && in_value(begin - 1)) --begin;
  std::size_t end = begin;
  while (end < header.size() && in_value(end)) ++end;
  return {begin, end - begin};
}

/// Where one entry, from its name to its closing bracket, begins and how long it is.
std::pair<std::size_t, std::size_t> entry(RandomStream& random, const std::string& header) {
  const std::size_t end = header.find("}", below(random, header.size()));
  if (end == std::string::npos) return {0, 0};
  const std::size_t before = header.rfind("},", end == 0 ? 0 : end - 1);
  const std::size_t begin = before == std::string::npos ? 1 : before + 2;
  return begin > end ? std::pair<std::size_t, std::size_t>{0, 0} : std::pair{begin, end + 1 - begin};
}

void change_header(RandomStream& random, std::string& header) {
  static const char* const values[] = {"0",
                                       "1",
                                       "2",
                                       "3",
                                       "5",
                                       "256",
                                       "8192",
                                       "-1",
                                       "1e999",
                                       "nan",
                                       "1.5",
                                       "true",
                                       "false",
                                       "own",
                                       "cat",
                                       "add",
                                       "selfconf",
                                       "mean",
                                       "1/3",
                                       "F16",
                                       "4294967296",
                                       "18446744073709551615",
                                       "18446744073709551616",
                                       "",
                                       "\\u0000",
                                       "\\ud800"};
  const auto [begin, length] = value(random, header);
  switch (below(random, 6)) {
    case 0: header.replace(begin, length, values[below(random, std::size(values))]); break;
    case 1: {  // another value of the header
      const auto [from, size] = value(random, header);
      header.replace(begin, length, header.substr(from, size));
      break;
    }
    case 2: {  // a digit for another
      const std::size_t digit = header.find_first_of("0123456789", begin);
      if (digit != std::string::npos) header[digit] = static_cast<char>('0' + below(random, 10));
      break;
    }
    case 3: {  // an entry goes
      const auto [from, size] = entry(random, header);
      header.erase(from, size + 1);
      break;
    }
    case 4: {  // an entry comes
      const auto [from, size] = entry(random, header);
      const std::string copy = header.substr(from, size) + ',';
      header.insert(entry(random, header).first, copy);
      break;
    }
    default: header.insert(header.size(), below(random, 9), ' ');
  }
}

void change_data(RandomStream& random, std::string& data) {
  static constexpr std::uint32_t words[] = {0x7FC00000, 0x7F800000, 0xFF800000, 0x80000000, 0x00000001, 0x7F7FFFFF};
  const std::size_t place = below(random, data.size() / 4 + 1) * 4;
  if (place + 4 <= data.size()) {
    const auto word =
        random.chance(0.5) ? words[below(random, std::size(words))] : static_cast<std::uint32_t>(random());
    for (std::size_t i = 0; i < 4; ++i) data[place + i] = static_cast<char>((word >> (8 * i)) & 0xFFU);
  }
  if (random.chance(0.1)) data.resize(data.size() + below(random, 9) - std::min<std::size_t>(data.size(), 4));
}

/// Gives the file the checksum that the reader asks for.
void mend_checksum(Parts& parts) {
  try {
    folk::sct::parse_policy(parts.bytes(), "");
  } catch (const folk::InputFileError& error) {
    const std::string_view message = error.what();
    constexpr std::string_view before = ": checksum ";
    const std::size_t place = parts.header.find("\"checksum\":\"");
    if (message.starts_with(before) && place != std::string::npos)
      parts.header.replace(place + 12, 16, message.substr(before.size(), 16));
  }
}

}  // namespace

extern "C" std::size_t LLVMFuzzerCustomMutator(std::uint8_t* data, std::size_t size, std::size_t most, unsigned seed) {
  RandomStream random({.seed = seed});
  Parts parts = Parts::of({reinterpret_cast<const char*>(data), size});
  for (std::size_t changes = 1 + below(random, 3); changes > 0 && !parts.header.empty(); --changes) {
    if (random.chance(0.2))
      change_data(random, parts.data);
    else
      change_header(random, parts.header);
  }
  if (random.chance(0.9)) mend_checksum(parts);
  const std::string bytes = parts.bytes();
  std::copy_n(bytes.begin(), std::min(bytes.size(), most), data);
  return std::min(bytes.size(), most);
}

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  return folk::fuzz::only_folk_errors(data, size, [](std::string_view bytes) {
    const std::string once = folk::sct::policy_bytes(folk::sct::parse_policy(bytes, "fuzz.bin"));
    folk::fuzz::require(folk::sct::policy_bytes(folk::sct::parse_policy(once, "fuzz.bin")) == once);
  });
}
