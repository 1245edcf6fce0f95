#include <folk/analysis/thresholds/polynomial.h>

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

namespace folk {
namespace {

using Residues = std::vector<std::uint64_t>;

// A prime below 2^31, so that products of residues fit a word.
constexpr std::uint64_t prime = 2'147'483'647U;

std::uint64_t power_modulo(std::uint64_t base, std::uint64_t exponent) {
  std::uint64_t result = 1;
  for (; exponent != 0; exponent >>= 1U, base = base * base % prime)
    if ((exponent & 1U) != 0) result = result * base % prime;
  return result;
}

Residues residues(const Polynomial& p) {
  Residues result;
  result.reserve(p.coefficients().size());
  for (const Integer& c : p.coefficients()) {
    const auto rest = (c % prime).word();
    result.push_back(static_cast<std::uint64_t>(rest < 0 ? rest + static_cast<std::int64_t>(prime) : rest));
  }
  return result;
}

/// a modulo b; b's last residue is not 0.
void reduce(Residues& a, const Residues& b) {
  const std::uint64_t inverse = power_modulo(b.back(), prime - 2);
  while (a.size() >= b.size()) {
    const std::uint64_t factor = a.back() * inverse % prime;
    const std::size_t shift = a.size() - b.size();
    for (std::size_t i = 0; i < b.size(); ++i) a[i + shift] = (a[i + shift] + (prime - factor) * b[i]) % prime;
    a.pop_back();
    while (!a.empty() && a.back() == 0) a.pop_back();
  }
}

/// The greatest common divisor from its image modulo the prime, where that is enough: a common divisor whose degree is
/// the image's is the greatest, because the image's degree is never too small when the prime divides neither leading
/// coefficient. Primitive; nothing when the image's coefficients are not the true ones.
std::optional<Polynomial> divisor_from_image(const Polynomial& a, const Polynomial& b) {
  Residues x = residues(a);
  Residues y = residues(b);
  if (x.back() == 0 || y.back() == 0) return std::nullopt;
  while (!y.empty()) {
    reduce(x, y);
    std::swap(x, y);
  }
  if (x.size() == 1) return Polynomial({1});
  // The true leading coefficient divides both: scaled to their common divisor all coefficients are integers.
  const std::uint64_t scale = residues(Polynomial({gcd(a.leading(), b.leading())})).front();
  const std::uint64_t factor = power_modulo(x.back(), prime - 2) * scale % prime;
  std::vector<Integer> lifted;
  for (const std::uint64_t c : x) {
    const auto residue = static_cast<std::int64_t>(c * factor % prime);
    lifted.emplace_back(residue > static_cast<std::int64_t>(prime / 2) ? residue - static_cast<std::int64_t>(prime)
                                                                       : residue);
  }
  const Polynomial candidate = Polynomial(std::move(lifted)).primitive_part();
  if (exact_quotient(a, candidate) * candidate != a || exact_quotient(b, candidate) * candidate != b)
    return std::nullopt;
  return candidate;
}

/// A multiple of a modulo b, primitive.
Polynomial primitive_remainder(const Polynomial& a, const Polynomial& b) {
  std::vector<Integer> rest = a.coefficients();
  const auto& divisor = b.coefficients();
  while (rest.size() >= divisor.size()) {
    const Integer top = rest.back();
    const std::size_t shift = rest.size() - divisor.size();
    for (Integer& c : rest) c *= divisor.back();
    for (std::size_t i = 0; i < divisor.size(); ++i) rest[i + shift] -= top * divisor[i];
    while (!rest.empty() && rest.back().is_zero()) rest.pop_back();
  }
  return Polynomial(std::move(rest)).primitive_part();
}

/// The sign at 0 < d < 1 by Horner's rule in binary fractions of fixed length; 0 when rounding leaves it open.
int sign_by_rounding(const std::vector<Integer>& coefficients, const Rational& d) {
  Integer sum = 1;
  for (const Integer& c : coefficients) sum += abs(c);
  const auto size_of = [](const Integer& x) { return static_cast<unsigned>(64 * x.words().size()); };
  const unsigned bits = size_of(denominator(d)) + size_of(sum) + 64;
  const Integer rounded = (numerator(d) << bits) / denominator(d);
  Integer value = 0;
  for (std::size_t i = coefficients.size(); i-- > 0;) {
    value *= rounded;
    value /= Integer(1) << bits;
    value += coefficients[i] << bits;
  }
  // Each step errs by less than 2^-bits (sum + 2): `sum` bounds all values, and d is off by less than 2^-bits.
  const Integer error = (sum + 2) * coefficients.size();
  return abs(value) > error ? value.sign() : 0;
}

}  // namespace

Polynomial::Polynomial(std::vector<Integer> coefficients)
    : coefficients_(std::move(coefficients)) {
  trim();
}

void Polynomial::trim() {
  while (!coefficients_.empty() && coefficients_.back().is_zero()) coefficients_.pop_back();
}

Polynomial Polynomial::operator-() const {
  Polynomial result = *this;
  for (Integer& c : result.coefficients_) c = -c;
  return result;
}

Polynomial Polynomial::operator+(const Polynomial& other) const {
  Polynomial result = *this;
  if (result.coefficients_.size() < other.coefficients_.size()) result.coefficients_.resize(other.coefficients_.size());
  for (std::size_t i = 0; i < other.coefficients_.size(); ++i) result.coefficients_[i] += other.coefficients_[i];
  result.trim();
  return result;
}

Polynomial Polynomial::operator-(const Polynomial& other) const { return *this + -other; }

Polynomial Polynomial::operator*(const Polynomial& other) const {
  if (is_zero() || other.is_zero()) return {};
  std::vector<Integer> product(coefficients_.size() + other.coefficients_.size() - 1);
  for (std::size_t i = 0; i < coefficients_.size(); ++i)
    for (std::size_t j = 0; j < other.coefficients_.size(); ++j)
      product[i + j] += coefficients_[i] * other.coefficients_[j];
  return Polynomial(std::move(product));
}

Polynomial Polynomial::times_power(std::size_t k) const {
  if (is_zero()) return {};
  Polynomial result = *this;
  result.coefficients_.insert(result.coefficients_.begin(), k, Integer(0));
  return result;
}

Polynomial Polynomial::times_one_minus_power(std::size_t k) const { return *this - times_power(k); }

Polynomial Polynomial::derivative() const {
  std::vector<Integer> result;
  for (std::size_t i = 1; i < coefficients_.size(); ++i) result.push_back(coefficients_[i] * i);
  return Polynomial(std::move(result));
}

Polynomial Polynomial::primitive_part() const {
  Integer content = 0;
  for (const Integer& c : coefficients_) {
    content = gcd(content, c);
    if (content == 1) return *this;
  }
  Polynomial result = *this;
  for (Integer& c : result.coefficients_) c /= content;
  return result;
}

Polynomial Polynomial::reduced_on_unit_interval() const {
  const auto first = std::find_if(coefficients_.begin(), coefficients_.end(), [](const Integer& c) { return c != 0; });
  std::vector<Integer> rest(first, coefficients_.end());
  while (!rest.empty()) {
    // p / (1 - d) has the partial sums of p's coefficients; the last of them is p(1).
    Integer sum = 0;
    for (const Integer& c : rest) sum += c;
    if (!sum.is_zero()) break;
    for (std::size_t i = 1; i < rest.size(); ++i) rest[i] += rest[i - 1];
    rest.pop_back();
  }
  return Polynomial(std::move(rest)).primitive_part();
}

int Polynomial::sign_at(const Rational& d) const {
  if (is_zero()) return 0;
  if (degree() > 12 && d > 0 && d < 1)
    if (const int sign = sign_by_rounding(coefficients_, d)) return sign;
  const Integer above = numerator(d);
  const Integer below = denominator(d);
  Integer value = coefficients_.back();
  Integer power = 1;
  for (std::size_t i = coefficients_.size() - 1; i-- > 0;) {
    power *= below;
    value *= above;
    if (!coefficients_[i].is_zero()) value += coefficients_[i] * power;
  }
  return value.sign();
}

Polynomial exact_quotient(const Polynomial& dividend, const Polynomial& divisor) {
  std::vector<Integer> rest = dividend.coefficients();
  const auto& by = divisor.coefficients();
  if (rest.size() < by.size()) return {};
  std::vector<Integer> quotient(rest.size() - by.size() + 1);
  for (std::size_t i = quotient.size(); i-- > 0;) {
    quotient[i] = rest[i + by.size() - 1] / by.back();
    if (quotient[i].is_zero()) continue;
    for (std::size_t j = 0; j < by.size(); ++j) rest[i + j] -= quotient[i] * by[j];
  }
  return Polynomial(std::move(quotient));
}

Polynomial greatest_common_divisor(const Polynomial& a, const Polynomial& b) {
  Polynomial x = a.primitive_part();
  Polynomial y = b.primitive_part();
  if (!x.is_zero() && !y.is_zero())
    if (const auto divisor = divisor_from_image(x, y)) return divisor->leading() < 0 ? -*divisor : *divisor;
  if (x.degree() < y.degree()) std::swap(x, y);
  while (!y.is_zero()) {
    Polynomial rest = primitive_remainder(x, y);
    x = std::move(y);
    y = std::move(rest);
  }
  return !x.is_zero() && x.leading() < 0 ? -x : x;
}

Polynomial squarefree_part(const Polynomial& p) {
  const Polynomial primitive = p.primitive_part();
  return exact_quotient(primitive, greatest_common_divisor(primitive, primitive.derivative()));
}

std::string to_text(const Polynomial& p) {
  if (p.is_zero()) return "0";
  std::string text;
  for (std::size_t i = p.coefficients().size(); i-- > 0;) {
    const Integer& c = p.coefficients()[i];
    if (c.is_zero()) continue;
    text += text.empty() ? (c < 0 ? "-" : "") : (c < 0 ? " - " : " + ");
    const Integer size = abs(c);
    if (i == 0 || size != 1) text += size.str();
    if (i == 0) continue;
    if (size != 1) text += ' ';
    text += i == 1 ? "d" : "d^" + std::to_string(i);
  }
  return text;
}

}  // namespace folk
