// Network and Stream: the bytes are a small architecture, windows for it and a history of appending to them. What the
// stream says of tokens that come in pieces, some of them by mistake, is to the bit what the network says of the whole
// windows: so far as no sum has more terms than a panel of gemm.cpp, beyond which they may differ in the last bits.

#include <folk/analysis/play/signature.h>
#include <folk/games/random.h>
#include <folk/sct/network/stream.h>

#include <algorithm>
#include <numeric>
#include <vector>

#include "fuzz.h"

namespace {

using namespace folk::sct;
using folk::fuzz::require;

/// The input byte by byte and, after its end, numbers drawn from what it was.
class Bytes {
public:
  Bytes(const std::uint8_t* data, std::size_t size)
      : data_(data),
        size_(size) {
    folk::Signature signature;
    signature.add(std::string_view(reinterpret_cast<const char*>(data), size));
    random_ = folk::RandomStream({.seed = signature.value()});
  }

  std::uint8_t next() { return at_ < size_ ? data_[at_++] : static_cast<std::uint8_t>(random_()); }

  /// least <= n <= most
  std::size_t between(std::size_t least, std::size_t most) { return least + next() % (most - least + 1); }

  /// In [-2, 2).
  float number() { return static_cast<float>(next()) / 64 - 2; }

  /// `count` numbers in [-0.5, 0.5), none of them from the input's bytes.
  std::vector<float> parameters(std::size_t count) {
    std::vector<float> drawn(count);
    for (auto& x : drawn) x = static_cast<float>(random_.uniform() - 0.5);
    return drawn;
  }

private:
  const std::uint8_t* data_;
  std::size_t size_;
  std::size_t at_ = 0;
  folk::RandomStream random_;
};

Architecture architecture_of(Bytes& bytes) {
  Architecture a;
  a.heads = bytes.between(1, 3);
  a.hidden = a.heads * bytes.between(1, 6);
  a.layers = bytes.between(1, 3);
  a.agents = bytes.between(1, 3);
  a.context = bytes.between(1, 8);
  a.time_rows = bytes.between(a.context, 9);
  a.observation_size = bytes.between(1, 3);
  a.discrete = bytes.between(0, 1) == 1;
  a.action_size = bytes.between(2, 3);
  a.belief_token = bytes.between(0, 1) == 1;
  a.readout = Readout::own;
  return a;
}

Actions<float> actions_of(const Architecture& architecture, std::size_t count, Bytes& bytes) {
  Actions<float> actions;
  for (std::size_t i = 0; i < count; ++i) {
    if (architecture.discrete)
      actions.classes.push_back(static_cast<std::int32_t>(bytes.between(0, architecture.action_size - 1)));
    for (std::size_t k = 0; !architecture.discrete && k < architecture.action_size; ++k)
      actions.numbers.push_back(bytes.number());
  }
  return actions;
}

/// One to three windows of the same length.
Batch<float> batch_of(const Architecture& architecture, Bytes& bytes) {
  const auto numbers = [&](std::size_t count) {
    std::vector<float> read(count);
    for (auto& x : read) x = bytes.number();
    return read;
  };
  Batch<float> batch;
  const std::size_t windows = bytes.between(1, 3);
  const std::size_t rounds = bytes.between(1, architecture.context);
  batch.window_rounds.assign(windows, rounds);
  for (std::size_t w = 0; w < windows; ++w) {
    const std::size_t first = bytes.between(0, architecture.time_rows - rounds);
    for (std::size_t t = first; t < first + rounds; ++t) batch.timesteps.push_back(static_cast<std::int32_t>(t));
  }
  batch.returns = numbers(batch.rounds());
  batch.observations = numbers(batch.rounds() * architecture.agents * architecture.observation_size);
  batch.opponent = actions_of(architecture, batch.rounds(), bytes);
  batch.own = actions_of(architecture, batch.rounds() * architecture.agents, bytes);
  return batch;
}

/// Of each window's rows, [first, first + count).
Matrix<float> part(const Matrix<float>& rows, std::size_t windows, std::size_t first, std::size_t count) {
  const Index each = rows.rows() / index(windows);
  Matrix<float> out(index(windows * count), rows.cols());
  for (std::size_t w = 0; w < windows; ++w)
    out.middleRows(index(w * count), index(count)) = rows.middleRows(index(w) * each + index(first), index(count));
  return out;
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  Bytes bytes(data, size);
  const auto architecture = architecture_of(bytes);
  const Network<float> network(architecture);
  const auto parameters = bytes.parameters(network.layout().size());
  const auto batch = batch_of(architecture, bytes);
  const Chunk<float> chunk{batch, 0, 0, batch.window_rounds};
  const std::size_t windows = batch.windows();
  const std::size_t tokens = batch.window_rounds.front() * architecture.round_tokens();

  std::vector<std::size_t> every(architecture.round_tokens());
  std::iota(every.begin(), every.end(), std::size_t{0});
  const Dropout none;
  NetworkTape<float> tape;
  network.forward(parameters.data(), chunk, {batch.opponent, none, every}, tape);
  const Matrix<float> states = tape.hidden;

  // The network computes the same where it is asked for one token of each round alone.
  const std::vector<std::size_t> one{bytes.between(0, every.back())};
  network.forward(parameters.data(), chunk, {batch.opponent, none, one}, tape);
  for (std::size_t t = 0; t < batch.rounds(); ++t)
    require(tape.hidden.row(index(t)) == states.row(index(t * every.size() + one[0])));

  EmbeddingTape<float> embedding;
  Matrix<float> embedded;
  embed(architecture, network.embedding(), parameters.data(), chunk, batch.opponent,
        TokenRows(batch.window_rounds, every.size(), every), none, embedding, embedded);
  Stream stream(network, parameters.data(), windows, bytes.between(batch.window_rounds.front(), architecture.context));
  while (stream.tokens() < tokens) {
    const std::size_t there = stream.tokens();
    const std::size_t added = std::min(bytes.between(1, 12), tokens - there);
    const std::size_t asked = bytes.between(1, added);
    const Matrix<float> piece = part(embedded, windows, there, added);
    const std::size_t chance = bytes.between(0, 15);
    if (chance == 0) {  // other tokens, which are then forgotten
      stream.append(-piece, asked);
      stream.keep(there);
    }
    const Matrix<float> said = stream.append(piece, asked);
    require(stream.tokens() == there + added);
    require(said == part(states, windows, there + added - asked, asked));
    if (chance == 1) stream.keep(bytes.between(0, stream.tokens()));
  }
  return 0;
}
