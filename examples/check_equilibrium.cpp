// Is pavlov in equilibrium with itself when the next round counts 0.6, and what shows it? As sce-check concludes.

#include <folk/analysis/equilibria/examination.h>
#include <folk/strategies/registry.h>

#include <iostream>

int main() {
  const folk::Registry registry = folk::Registry::standard();
  folk::ExaminationQuestion question;
  question.criterion = folk::Criterion::discounted(0.6);
  question.policy = registry.make("pavlov");
  question.opponents = {question.policy};
  question.beliefs = registry.roster("classics");  // whom either side may hold the other to be
  const folk::Examination found = folk::examine(question);
  for (const folk::Notion notion : folk::all_notions) {
    const auto& verdict = found.verdict(notion);
    if (!verdict) continue;  // it does not apply
    std::cout << to_string(notion) << ": " << verdict->text() << ", gain " << verdict->margin_exact;
    if (!verdict->witness.empty()) std::cout << ", " << verdict->witness;
    std::cout << "\n";
  }
}
