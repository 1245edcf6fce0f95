#pragma once
// What a self-confirming transformer looks like: its sizes, its token stream, and where each parameter stands.

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace folk::sct {

/// Where the action head reads (`opo_type` of the published program).
enum class Readout {
  token,  ///< the hidden state at the belief token: the paper's figure
  cat,    ///< a linear map of [observation ; belief token]: the published program's setting
  add,    ///< the mean of observation and belief token
  own     ///< the observation alone: RMADT with the belief loss, MADT without
};

std::string_view to_string(Readout readout);

/// The row of a time table that a round of the match has, counted from 0: the last row is for all that are left.
inline std::int32_t time_row(std::size_t round, std::size_t rows) {
  return static_cast<std::int32_t>(round < rows ? round : rows - 1);
}

/// Sizes of a decoder-only transformer over the tokens [return, observation of each agent, belief, action of each
/// agent] of each round; the defaults are the paper's.
struct Architecture {
  std::size_t hidden = 128;
  std::size_t layers = 3;
  std::size_t heads = 1;
  std::size_t context = 20;          ///< rounds of a window
  std::size_t time_rows = 100;       ///< rows of the time table: a round each, the last for all that are left
  std::size_t observation_size = 5;  ///< numbers of one agent's observation
  std::size_t action_size = 2;       ///< actions to choose from, or numbers of a continuous action
  std::size_t agents = 1;            ///< ego agents; the opponent is one
  bool discrete = true;              ///< actions are classes (cross-entropy), else numbers in (-1, 1) (squared error)
  Readout readout = Readout::token;
  bool belief_token = true;  ///< the stream holds an opponent token (MADT of the golden files has none)
  bool auxiliary = false;    ///< also predict the next observation and return

  /// Tokens of one round.
  std::size_t round_tokens() const { return 2 * agents + (belief_token ? 2 : 1); }
  std::size_t return_token() const { return 0; }
  std::size_t observation_token(std::size_t agent) const { return 1 + agent; }
  std::size_t opponent_token() const { return 1 + agents; }
  std::size_t action_token(std::size_t agent) const { return 1 + agents + (belief_token ? 1 : 0) + agent; }

  std::int32_t time_row(std::size_t round) const { return sct::time_row(round, time_rows); }

  /// Throws UsageError naming the field that no network can have.
  void check() const;

  bool operator==(const Architecture&) const = default;
};

/// One tensor of a network. Matrices are row-major: [out, in] for embeddings of numbers and for heads, [in, out] for
/// the four of a block, [rows, hidden] for tables, as in the published program.
struct Tensor {
  std::string name;                ///< as the published program names it: "h.0.attn.c_attn.weight"
  std::vector<std::size_t> shape;  ///< one or two numbers
  std::size_t offset = 0;          ///< its first element in the flat parameter buffer

  std::size_t rows() const { return shape[0]; }
  std::size_t columns() const { return shape.size() > 1 ? shape[1] : 1; }
  std::size_t size() const { return rows() * columns(); }
};

/// All tensors of an architecture, one after the other in one buffer.
class ParameterLayout {
public:
  explicit ParameterLayout(const Architecture& architecture);

  const std::vector<Tensor>& tensors() const { return tensors_; }
  std::size_t size() const { return size_; }

  /// Throws std::logic_error for a name that the architecture does not have.
  const Tensor& operator[](std::string_view name) const;

private:
  void add(std::string name, std::vector<std::size_t> shape);

  std::vector<Tensor> tensors_;
  std::size_t size_ = 0;
};

}  // namespace folk::sct
