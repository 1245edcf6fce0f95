#include <folk/analysis/thresholds/minimal_polynomial.h>
#include <folk/analysis/thresholds/root_isolation.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace folk {
namespace {

/// Lenstra, Lenstra & Lovasz's reduction of a lattice's basis in integers alone (Cohen 1993, algorithm 2.6.7):
/// gram_[k] are the determinants of the leading Gram matrices, lambda_[i][j] the Gram-Schmidt coefficients times them.
class LatticeReduction {
public:
  explicit LatticeReduction(std::vector<std::vector<Integer>> basis)
      : basis_(std::move(basis)),
        gram_(basis_.size() + 1),
        lambda_(basis_.size(), std::vector<Integer>(basis_.size())) {
    orthogonalise();
    for (std::size_t k = 1; k < basis_.size();) {
      reduce(k, k - 1);
      const Integer& slope = lambda_[k][k - 1];
      if (4 * (gram_[k + 1] * gram_[k - 1] + slope * slope) < 3 * gram_[k] * gram_[k]) {
        exchange(k);
        k = std::max<std::size_t>(k - 1, 1);
      } else {
        for (std::size_t l = k - 1; l-- > 0;) reduce(k, l);
        ++k;
      }
    }
  }

  const std::vector<Integer>& shortest() const { return basis_.front(); }

private:
  void orthogonalise() {
    gram_[0] = 1;
    for (std::size_t i = 0; i < basis_.size(); ++i)
      for (std::size_t j = 0; j <= i; ++j) {
        Integer u = 0;
        for (std::size_t c = 0; c < basis_[i].size(); ++c) u += basis_[i][c] * basis_[j][c];
        for (std::size_t k = 0; k < j; ++k) u = (gram_[k + 1] * u - lambda_[i][k] * lambda_[j][k]) / gram_[k];
        (j < i ? lambda_[i][j] : gram_[i + 1]) = u;
      }
  }

  void reduce(std::size_t k, std::size_t l) {
    const Integer& size = gram_[l + 1];
    if (2 * abs(lambda_[k][l]) <= size) return;
    const Integer twice = 2 * lambda_[k][l];
    const Integer nearest = (twice < 0 ? twice - size : twice + size) / (2 * size);
    for (std::size_t c = 0; c < basis_[k].size(); ++c) basis_[k][c] -= nearest * basis_[l][c];
    lambda_[k][l] -= nearest * size;
    for (std::size_t i = 0; i < l; ++i) lambda_[k][i] -= nearest * lambda_[l][i];
  }

  void exchange(std::size_t k) {
    std::swap(basis_[k], basis_[k - 1]);
    for (std::size_t j = 0; j + 1 < k; ++j) std::swap(lambda_[k][j], lambda_[k - 1][j]);
    const Integer slope = lambda_[k][k - 1];
    const Integer size = (gram_[k - 1] * gram_[k + 1] + slope * slope) / gram_[k];
    for (std::size_t i = k + 1; i < basis_.size(); ++i) {
      const Integer old = lambda_[i][k];
      lambda_[i][k] = (gram_[k + 1] * lambda_[i][k - 1] - slope * old) / gram_[k];
      lambda_[i][k - 1] = (size * old + slope * lambda_[i][k]) / gram_[k + 1];
    }
    gram_[k] = size;
  }

  std::vector<std::vector<Integer>> basis_;
  std::vector<Integer> gram_;
  std::vector<std::vector<Integer>> lambda_;
};

/// An integer polynomial of this degree or less that is small at the number: c0, ..., c_degree beside 2^bits times its
/// value there make the short vectors of a lattice.
Polynomial nearly_vanishing(const Rational& number, std::size_t degree, unsigned bits) {
  std::vector<std::vector<Integer>> basis;
  Rational power = Rational(Integer(1) << bits);
  for (std::size_t i = 0; i <= degree; ++i, power *= number) {
    std::vector<Integer> row(degree + 2);
    row[i] = 1;
    row.back() = numerator(power) / denominator(power);
    basis.push_back(std::move(row));
  }
  std::vector<Integer> coefficients = LatticeReduction(std::move(basis)).shortest();
  coefficients.pop_back();
  return Polynomial(std::move(coefficients)).primitive_part();
}

bool vanishes_at(const Polynomial& p, const AlgebraicNumber& number) {
  const Polynomial common = greatest_common_divisor(p, *number.polynomial());
  return common.degree() > 0 && common.sign_at(number.low()) * common.sign_at(number.high()) < 0;
}

Polynomial without_roots_of_unity(const Polynomial& p) {
  Polynomial rest = p;
  for (std::size_t k = 1; k <= 2 * p.degree() && rest.degree() > 1; ++k) {
    const Polynomial common = greatest_common_divisor(rest, Polynomial({1}).times_one_minus_power(k));
    if (common.degree() > 0) rest = exact_quotient(rest, common);
  }
  return rest;
}

Polynomial with_positive_lead(const Polynomial& p) { return p.leading() < 0 ? -p : p; }

std::string decimal(const Integer& value, unsigned places) {
  std::string digits = value.str();
  if (digits.size() <= places) digits.insert(0, places + 1 - digits.size(), '0');
  return digits.insert(digits.size() - places, ".");
}

/// True when `p` (squarefree) has a single root in the open interval.
bool isolates(const Polynomial& p, const Rational& low, const Rational& high) {
  RootIsolation found = isolate_roots(p, low, high);
  const auto polynomial = std::make_shared<const Polynomial>(std::move(found.polynomial));
  return std::count_if(found.roots.begin(), found.roots.end(), [&](const RootInterval& root) {
           const AlgebraicNumber place =
               root.low == root.high ? AlgebraicNumber(root.low) : AlgebraicNumber(polynomial, root.low, root.high);
           return place > low && place < high;
         }) == 1;
}

/// The decimal interval of the fewest places, two or more, that tells `number` from the other roots of `p`.
std::string decimal_interval(AlgebraicNumber number, const Polynomial& p) {
  Integer scale = 100;
  for (unsigned places = 2;; ++places, scale *= 10) {
    const auto floor = [&](const Rational& x) { return Integer(numerator(x) * scale / denominator(x)); };
    // The number is irrational: it ends strictly between two decimals.
    while (floor(number.low()) != floor(number.high())) number.refine();
    const Integer below = floor(number.low());
    if (isolates(p, Rational(below, scale), Rational(below + 1, scale)))
      return "(" + decimal(below, places) + ", " + decimal(below + 1, places) + ")";
  }
}

}  // namespace

Polynomial minimal_polynomial(const AlgebraicNumber& number) {
  const Polynomial known = without_roots_of_unity(squarefree_part(*number.polynomial()));
  unsigned size = 0;  // bits of the largest coefficient; those of a factor are not much longer (Mignotte's bound)
  for (const Integer& c : known.coefficients())
    size = std::max(size, static_cast<unsigned>(64 * c.words().size()));
  AlgebraicNumber fine = number;
  for (std::size_t degree = 2; degree < known.degree() && degree <= most_minimal_degree; ++degree) {
    const auto terms = static_cast<unsigned>(degree) + 1;
    const unsigned bits = terms * (size + terms) + 10;
    while (!fine.is_rational() && (fine.high() - fine.low()) * (Integer(1) << bits) > 1) fine.refine();
    const Polynomial candidate = nearly_vanishing(fine.low(), degree, bits);
    if (vanishes_at(candidate, number)) return with_positive_lead(candidate);
  }
  return with_positive_lead(known);
}

std::string to_text(const AlgebraicNumber& number) {
  if (number.is_rational()) {
    const Integer below = denominator(number.low());
    return numerator(number.low()).str() + (below == 1 ? "" : "/" + below.str());
  }
  const Polynomial simplest = minimal_polynomial(number);
  return "root of " + to_text(simplest) + " in " + decimal_interval(number, simplest);
}

}  // namespace folk
