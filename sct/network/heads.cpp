#include <folk/sct/network/gemm.h>
#include <folk/sct/network/heads.h>

#include <fmt/format.h>

#include <algorithm>
#include <stdexcept>

namespace folk::sct {
namespace {

/// The hidden states of all rounds, one a row: the read tokens side by side.
template <class M>
auto by_round(M& hidden, std::size_t read) {
  using Plain = std::conditional_t<std::is_const_v<M>, const Matrix<typename M::Scalar>, Matrix<typename M::Scalar>>;
  return Eigen::Map<Plain>(hidden.data(), hidden.rows() / index(read), hidden.cols() * index(read));
}

/// tanh of every number, each as a part of a whole vector: at the ends of a matrix Eigen computes in another way, and a
/// player's action must not depend on who stands beside it.
template <class S>
void hyperbolic_tangents(Matrix<S>& out) {
  constexpr Index lanes = 16;
  Eigen::Array<S, lanes, 1> piece = Eigen::Array<S, lanes, 1>::Zero();
  for (Index i = 0; i < out.size(); i += lanes) {
    const Index some = std::min(lanes, out.size() - i);
    std::copy_n(out.data() + i, some, piece.data());
    piece = piece.tanh();
    std::copy_n(piece.data(), some, out.data() + i);
  }
}

}  // namespace

std::vector<std::size_t> read_tokens(const Architecture& architecture, bool belief, bool action) {
  const bool own = architecture.readout != Readout::token;
  std::vector<std::size_t> tokens;
  for (std::size_t i = 0; i < architecture.agents; ++i)
    if (belief || (action && own) || architecture.auxiliary) tokens.push_back(architecture.observation_token(i));
  if (action && architecture.readout != Readout::own) tokens.push_back(architecture.opponent_token());
  for (std::size_t i = 0; i < architecture.agents; ++i)
    if (architecture.auxiliary) tokens.push_back(architecture.action_token(i));
  return tokens;
}

template <class S>
Heads<S>::Heads(const Architecture& architecture, const ParameterLayout& layout, std::vector<std::size_t> read)
    : architecture_(architecture),
      read_(std::move(read)) {
  const auto linear = [&](const std::string& name) { return Linear{layout[name + ".weight"], layout[name + ".bias"]}; };
  belief_ = linear("predict_opoact");
  for (std::size_t i = 0; i < architecture.agents; ++i) action_.push_back(linear(fmt::format("predict_curact.{}", i)));
  if (architecture.readout == Readout::cat) mix_ = linear("opo_obs_cat");
  if (!architecture.auxiliary) return;
  next_observation_ = linear("predict_state");
  next_return_ = linear("predict_return");
}

template <class S>
Index Heads<S>::column(std::size_t token) const {
  const auto found = std::find(read_.begin(), read_.end(), token);
  if (found == read_.end()) throw std::logic_error("a head reads a token whose hidden state is not computed");
  return (found - read_.begin()) * index(architecture_.hidden);
}

template <class S>
void Heads<S>::squash(Matrix<S>& out) const {
  if (!architecture_.discrete) hyperbolic_tangents(out);
}

/// The gradient before the tanh.
template <class S>
Matrix<S> Heads<S>::unsquashed(const Matrix<S>& out, const Matrix<S>& d_out) const {
  if (architecture_.discrete) return d_out;
  return d_out.array() * (S(1) - out.array().square());
}

template <class S>
void Heads<S>::belief(const S* parameters, const Matrix<S>& hidden, Matrix<S>& out) const {
  const auto x = by_round(hidden, read_.size());
  const auto w = as_matrix(parameters, belief_.weight);
  out.resize(x.rows(), w.rows());
  set_product(out, operand(x.middleCols(column(architecture_.observation_token(0)), w.cols())), transposed(w));
  out.rowwise() += as_row(parameters, belief_.bias);
  squash(out);
}

template <class S>
void Heads<S>::belief_backward(const S* parameters, const Matrix<S>& hidden, const Matrix<S>& out,
                               const Matrix<S>& d_out, Matrix<S>& d_hidden, S* gradient) const {
  const auto x = by_round(hidden, read_.size());
  auto dx = by_round(d_hidden, read_.size());
  const auto w = as_matrix(parameters, belief_.weight);
  const Index first = column(architecture_.observation_token(0));
  const Matrix<S> d = unsquashed(out, d_out);
  add_product(as_matrix(gradient, belief_.weight), transposed(d), operand(x.middleCols(first, w.cols())));
  add_rows(as_row(gradient, belief_.bias), d);
  add_product(dx.middleCols(first, w.cols()), operand(d), operand(w));
}

/// What agent i's action head reads  [rounds, h]
template <class S>
Matrix<S> Heads<S>::source(const S* parameters, const Matrix<S>& hidden, std::size_t agent) const {
  const auto x = by_round(hidden, read_.size());
  const Index h = index(architecture_.hidden);
  const auto at = [&](std::size_t token) { return x.middleCols(column(token), h); };
  const auto observation = architecture_.observation_token(agent);
  switch (architecture_.readout) {
    case Readout::token: return at(architecture_.opponent_token());
    case Readout::own: return at(observation);
    case Readout::add: return (at(observation) + at(architecture_.opponent_token())) * S(0.5);
    case Readout::cat: break;
  }
  const auto w = as_matrix(parameters, mix_.weight);
  Matrix<S> mixed(x.rows(), h);
  set_product(mixed, operand(at(observation)), transposed(w.leftCols(h)));
  add_product(mixed, operand(at(architecture_.opponent_token())), transposed(w.rightCols(h)));
  mixed.rowwise() += as_row(parameters, mix_.bias);
  return mixed;
}

template <class S>
void Heads<S>::action(const S* parameters, const Matrix<S>& hidden, Matrix<S>& out) const {
  const Index size = index(architecture_.action_size);
  out.resize(hidden.rows() / index(read_.size()), size * index(architecture_.agents));
  for (std::size_t i = 0; i < architecture_.agents; ++i) {
    auto own = out.middleCols(index(i) * size, size);
    const auto read = source(parameters, hidden, i);
    set_product(own, operand(read), transposed(as_matrix(parameters, action_[i].weight)));
    own.rowwise() += as_row(parameters, action_[i].bias);
  }
  squash(out);
}

template <class S>
void Heads<S>::action_backward(const S* parameters, const Matrix<S>& hidden, const Matrix<S>& out,
                               const Matrix<S>& d_out, Matrix<S>& d_hidden, S* gradient) const {
  const auto x = by_round(hidden, read_.size());
  auto dx = by_round(d_hidden, read_.size());
  const Index h = index(architecture_.hidden);
  const Index size = index(architecture_.action_size);
  const Matrix<S> d_all = unsquashed(out, d_out);
  for (std::size_t i = 0; i < architecture_.agents; ++i) {
    const auto d = d_all.middleCols(index(i) * size, size);
    const auto read = source(parameters, hidden, i);
    add_product(as_matrix(gradient, action_[i].weight), transposed(d), operand(read));
    add_rows(as_row(gradient, action_[i].bias), d);
    Matrix<S> d_source(d.rows(), h);
    set_product(d_source, operand(d), operand(as_matrix(parameters, action_[i].weight)));
    const auto at = [&](std::size_t token) { return dx.middleCols(column(token), h); };
    const auto observation = architecture_.observation_token(i);
    switch (architecture_.readout) {
      case Readout::token: at(architecture_.opponent_token()) += d_source; break;
      case Readout::own: at(observation) += d_source; break;
      case Readout::add:
        at(observation) += d_source * S(0.5);
        at(architecture_.opponent_token()) += d_source * S(0.5);
        break;
      case Readout::cat: {
        const auto w = as_matrix(parameters, mix_.weight);
        auto dw = as_matrix(gradient, mix_.weight);
        const auto opponent = column(architecture_.opponent_token());
        add_product(dw.leftCols(h), transposed(d_source), operand(x.middleCols(column(observation), h)));
        add_product(dw.rightCols(h), transposed(d_source), operand(x.middleCols(opponent, h)));
        add_rows(as_row(gradient, mix_.bias), d_source);
        add_product(at(observation), operand(d_source), operand(w.leftCols(h)));
        add_product(at(architecture_.opponent_token()), operand(d_source), operand(w.rightCols(h)));
        break;
      }
    }
  }
}

template <class S>
void Heads<S>::auxiliary(const S* parameters, const Matrix<S>& hidden, Predictions<S>& out) const {
  const auto x = by_round(hidden, read_.size());
  const Index h = index(architecture_.hidden);
  const Index size = index(architecture_.observation_size);
  const Index actions = column(architecture_.action_token(0));
  const Index observations = column(architecture_.observation_token(0));
  out.next_observation.resize(x.rows(), size * index(architecture_.agents));
  for (std::size_t i = 0; i < architecture_.agents; ++i) {
    auto own = out.next_observation.middleCols(index(i) * size, size);
    set_product(own, operand(x.middleCols(actions + index(i) * h, h)),
                transposed(as_matrix(parameters, next_observation_.weight)));
    own.rowwise() += as_row(parameters, next_observation_.bias);
  }
  // The return's weights stand agent by agent: action, then observation.
  const auto w = as_matrix(parameters, next_return_.weight);
  out.next_return.setZero(x.rows(), 1);
  for (Index i = 0; i < index(architecture_.agents); ++i) {
    add_product(out.next_return, operand(x.middleCols(actions + i * h, h)), transposed(w.middleCols(2 * i * h, h)));
    add_product(out.next_return, operand(x.middleCols(observations + i * h, h)),
                transposed(w.middleCols((2 * i + 1) * h, h)));
  }
  out.next_return.array() += parameters[next_return_.bias.offset];
}

template <class S>
void Heads<S>::auxiliary_backward(const S* parameters, const Matrix<S>& hidden, const Predictions<S>& d_out,
                                  Matrix<S>& d_hidden, S* gradient) const {
  const auto x = by_round(hidden, read_.size());
  auto dx = by_round(d_hidden, read_.size());
  const Index h = index(architecture_.hidden);
  const Index size = index(architecture_.observation_size);
  const Index actions = column(architecture_.action_token(0));
  const Index observations = column(architecture_.observation_token(0));
  for (std::size_t i = 0; i < architecture_.agents; ++i) {
    const auto d = d_out.next_observation.middleCols(index(i) * size, size);
    const Index own = actions + index(i) * h;
    add_product(as_matrix(gradient, next_observation_.weight), transposed(d), operand(x.middleCols(own, h)));
    add_rows(as_row(gradient, next_observation_.bias), d);
    add_product(dx.middleCols(own, h), operand(d), operand(as_matrix(parameters, next_observation_.weight)));
  }
  const auto w = as_matrix(parameters, next_return_.weight);
  auto dw = as_matrix(gradient, next_return_.weight);
  const auto& d = d_out.next_return;
  for (Index i = 0; i < index(architecture_.agents); ++i) {
    const Index action = actions + i * h;
    const Index observation = observations + i * h;
    add_product(dw.middleCols(2 * i * h, h), transposed(d), operand(x.middleCols(action, h)));
    add_product(dw.middleCols((2 * i + 1) * h, h), transposed(d), operand(x.middleCols(observation, h)));
    add_product(dx.middleCols(action, h), operand(d), operand(w.middleCols(2 * i * h, h)));
    add_product(dx.middleCols(observation, h), operand(d), operand(w.middleCols((2 * i + 1) * h, h)));
  }
  gradient[next_return_.bias.offset] += d.sum();
}

template class Heads<float>;
template class Heads<double>;

}  // namespace folk::sct
