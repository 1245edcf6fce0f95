#include <folk/analysis/equilibria/extracted_machine.h>

#include <algorithm>
#include <cstdint>
#include <utility>

namespace folk {
namespace {

std::size_t smallest(const std::vector<Extraction>& tried) {
  const auto smaller = [](const Extraction& a, const Extraction& b) { return a.machine.size() < b.machine.size(); };
  return static_cast<std::size_t>(std::min_element(tried.begin(), tried.end(), smaller) - tried.begin());
}

}  // namespace

ExtractedMachine extract_machine(const ExaminationQuestion& question, const Examination& examination,
                                 const std::vector<Strategy>& unseen, std::string unseen_name, const Stages& stages) {
  std::vector<BeliefRecord> records;
  for (const auto& pair : examination.pairs) records.push_back(pair.record.value());
  ExtractionOptions options;
  options.payoffs = question.payoffs;
  options.threads = question.threads;
  options.depth = static_cast<unsigned>(std::min<std::uint64_t>(options.depth, question.criterion.rounds() - 1));
  ExtractedMachine extracted;
  extracted.tried = extract_machines(question.policy, question.opponents, records, options,
                                     begin_stage(stages, "extracting an automaton"));
  extracted.chosen = readable_machine(extracted.tried).value_or(smallest(extracted.tried));
  extracted.unseen_name = std::move(unseen_name);
  const auto played = record_beliefs(question.policy, unseen, question.sampling(),
                                     begin_stage(stages, "testing it on unseen opponents"));
  extracted.unseen = fidelity(extracted.choice().machine, unseen, played, question.payoffs);
  return extracted;
}

}  // namespace folk
