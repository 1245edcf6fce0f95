#include <folk/analysis/judgement/own_judgement.h>
#include <folk/analysis/play/parallel.h>

#include <algorithm>
#include <numeric>

namespace folk {

std::vector<std::size_t> OwnJudgement::consistent() const {
  std::vector<std::size_t> places;
  for (std::size_t i = 0; i < agreements.size(); ++i)
    if (agreements[i].consistent()) places.push_back(i);
  return places;
}

std::vector<std::size_t> OwnJudgement::ranking() const {
  std::vector<std::size_t> order(posterior.candidates.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
                   [&](std::size_t a, std::size_t b) { return posterior.candidates[a] > posterior.candidates[b]; });
  return order;
}

SlipPosterior posterior_of(const Candidates& candidates, const std::vector<Agreement>& agreements,
                           const std::vector<ClassAgreement>& class_agreements, const std::vector<double>& slips) {
  std::vector<std::vector<double>> likelihoods;
  const auto add = [&](const auto& agreement) {
    auto& row = likelihoods.emplace_back();
    for (const double slip : slips) row.push_back(agreement.log_likelihood(slip));
  };
  std::for_each(agreements.begin(), agreements.end(), add);
  std::for_each(class_agreements.begin(), class_agreements.end(), add);
  return slip_posterior(candidates.weights(), likelihoods);
}

OwnJudgement judge_own(const Candidates& candidates, const std::vector<RecordedMatch>& matches,
                       const std::vector<double>& slips, const Payoffs& payoffs, unsigned threads,
                       const Progress& progress) {
  check_slips(slips);
  OwnJudgement judgement;
  judgement.agreements.resize(candidates.behaviours.size());
  parallel_for(
      candidates.behaviours.size(), threads,
      [&](std::size_t i, unsigned) {
        judgement.agreements[i] = agreement_with(candidates.behaviours[i].first(), matches, Seat::first, payoffs);
      },
      progress);
  for (const auto& [members, weight] : candidates.classes)
    judgement.class_agreements.emplace_back(members, matches, Seat::first);
  judgement.posterior = posterior_of(candidates, judgement.agreements, judgement.class_agreements, slips);
  return judgement;
}

}  // namespace folk
