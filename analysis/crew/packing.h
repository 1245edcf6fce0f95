#pragma once
// Results as bytes, for other ranks and for journals: numbers as they lie in this machine's memory.

#include <folk/games/error.h>

#include <cstddef>
#include <cstring>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>

namespace folk {

template <class T>
concept Packable = std::is_trivially_copyable_v<T>;

/// Appends the bytes of numbers.
template <Packable T>
void pack(std::string& bytes, std::span<const T> numbers) {
  bytes.append(reinterpret_cast<const char*>(numbers.data()), numbers.size_bytes());
}

template <Packable T>
void pack(std::string& bytes, const T& number) {
  pack(bytes, std::span<const T>(&number, 1));
}

/// Reads them in the order in which they were packed.
class Unpacker {
public:
  explicit Unpacker(std::string_view bytes)
      : rest_(bytes) {}

  std::size_t left() const { return rest_.size(); }

  /// Throws EnvironmentError where fewer bytes are left.
  std::string_view bytes(std::size_t count) {
    if (count > rest_.size()) throw_other_size();
    const auto found = rest_.substr(0, count);
    rest_.remove_prefix(count);
    return found;
  }

  template <Packable T>
  void read(std::span<T> numbers) {
    if (const auto found = bytes(numbers.size_bytes()); !found.empty())
      std::memcpy(numbers.data(), found.data(), found.size());
  }

  template <Packable T>
  T number() {
    T value{};
    read(std::span<T>(&value, 1));
    return value;
  }

  /// Throws EnvironmentError unless all was read.
  void end() const {
    if (!rest_.empty()) throw_other_size();
  }

private:
  [[noreturn]] static void throw_other_size() {
    throw EnvironmentError("a piece of the work has another size than it should: do all ranks run the same Folk?");
  }

  std::string_view rest_;
};

}  // namespace folk
