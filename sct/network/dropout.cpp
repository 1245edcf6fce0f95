#include <folk/sct/network/dropout.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>

namespace folk::sct {
namespace {

constexpr std::size_t lanes = 16;
constexpr std::size_t decisions = lanes * 4 * 2;  // 16 bits each

using Words = std::array<std::uint32_t, lanes>;

/// Philox4x32-10 (Salmon, Moraes, Dror & Shaw 2011), Random123's, for `lanes` counters side by side, so that the
/// compiler finds vector instructions for it. Word w of lane l is words[w][l].
void philox(std::array<Words, 4>& words, std::uint32_t key_0, std::uint32_t key_1) {
  for (int round = 0; round < 10; ++round) {
#pragma GCC unroll 1  // unrolled before its time, the loop finds no vector instructions
    for (std::size_t l = 0; l < lanes; ++l) {
      const std::uint64_t a = std::uint64_t{0xD2511F53} * words[0][l];
      const std::uint64_t b = std::uint64_t{0xCD9E8D57} * words[2][l];
      words[0][l] = static_cast<std::uint32_t>(b >> 32U) ^ words[1][l] ^ key_0;
      words[1][l] = static_cast<std::uint32_t>(b);
      words[2][l] = static_cast<std::uint32_t>(a >> 32U) ^ words[3][l] ^ key_1;
      words[3][l] = static_cast<std::uint32_t>(a);
    }
    key_0 += 0x9E3779B9;
    key_1 += 0xBB67AE85;
  }
}

}  // namespace

Dropout::Dropout(double probability, std::uint64_t seed, std::uint64_t step, std::uint32_t pass)
    : threshold_(static_cast<std::uint32_t>(std::lround(std::clamp(probability, 0.0, most) * 65536.0))),
      seed_(seed),
      step_(step),
      pass_(pass) {}

void Dropout::keep(std::uint8_t* keep, std::size_t count, std::size_t window, std::size_t site) const {
  const auto threshold = static_cast<std::uint16_t>(threshold_);
  const auto site_word = static_cast<std::uint32_t>(site) | pass_ << 24U;
  for (std::size_t i = 0; i < count; i += decisions) {
    std::array<Words, 4> words;
    for (std::size_t l = 0; l < lanes; ++l) words[0][l] = static_cast<std::uint32_t>(i / decisions * lanes + l);
    words[1].fill(static_cast<std::uint32_t>(window));
    words[2].fill(site_word);
    words[3].fill(static_cast<std::uint32_t>(step_));
    philox(words, static_cast<std::uint32_t>(seed_), static_cast<std::uint32_t>(seed_ >> 32U));
    std::array<std::uint16_t, decisions> halves;
    std::memcpy(halves.data(), words.data(), sizeof halves);
    std::array<std::uint8_t, decisions> kept;
    for (std::size_t k = 0; k < decisions; ++k) kept[k] = halves[k] >= threshold ? 1 : 0;
    std::memcpy(keep + i, kept.data(), std::min(decisions, count - i));
  }
}

}  // namespace folk::sct
