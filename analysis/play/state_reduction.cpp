#include <folk/analysis/play/state_reduction.h>

namespace folk {

using Eigen::Index;

Eigen::VectorXd stationary_distribution(Transitions p) {
  const Index n = p.rows();
  // Leaving out state k, its visits become direct moves between the others; what leaves k is summed, not 1 - p(k, k).
  for (Index k = n - 1; k > 0; --k) {
    const double leaves = p.row(k).head(k).sum();
    for (Index i = 0; i < k; ++i) {
      if (p(i, k) == 0) continue;
      p(i, k) /= leaves;
      p.row(i).head(k) += p(i, k) * p.row(k).head(k);
    }
  }
  Eigen::VectorXd distribution(n);
  distribution[0] = 1;
  for (Index k = 1; k < n; ++k) distribution[k] = distribution.head(k).dot(p.col(k).head(k));
  return distribution / distribution.sum();
}

Eigen::VectorXd absorption_probabilities(Transitions p) {
  const Index n = p.rows();
  const Index classes = p.cols() - n;
  for (Index k = n - 1; k > 0; --k) {
    const double leaves = p.row(k).head(k).sum() + p.row(k).tail(classes).sum();
    for (Index i = 0; i < k; ++i) {
      if (p(i, k) == 0) continue;
      const double share = p(i, k) / leaves;
      p.row(i).head(k) += share * p.row(k).head(k);
      p.row(i).tail(classes) += share * p.row(k).tail(classes);
    }
  }
  return p.row(0).tail(classes).transpose() / p.row(0).tail(classes).sum();
}

Eigen::VectorXd expected_ends(Transitions p, const Eigen::VectorXd& ends) {
  const Index n = p.rows();
  Eigen::VectorXd had = p.col(n).cwiseProduct(ends);
  Eigen::VectorXd leaves(n);
  for (Index k = n - 1; k >= 0; --k) {
    leaves[k] = p.row(k).head(k).sum() + p(k, n);
    for (Index i = 0; i < k; ++i) {
      if (p(i, k) == 0) continue;
      const double share = p(i, k) / leaves[k];
      p.row(i).head(k) += share * p.row(k).head(k);
      p(i, n) += share * p(k, n);
      had[i] += share * had[k];
    }
  }
  Eigen::VectorXd expected(n);
  for (Index k = 0; k < n; ++k) expected[k] = (p.row(k).head(k).dot(expected.head(k)) + had[k]) / leaves[k];
  return expected;
}

}  // namespace folk
