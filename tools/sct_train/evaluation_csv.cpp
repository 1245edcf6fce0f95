#include <folk/tools/sct_train/evaluation_csv.h>

#include <fmt/format.h>

#include <optional>

namespace folk::tools {
namespace {

std::string number_or_nothing(const std::optional<double>& number) { return number ? fmt::format("{}", *number) : ""; }

}  // namespace

std::string evaluation_heading(bool held_out) {
  return fmt::format("step,belief_loss,action_loss,target,total,belief_accuracy,{}kept\n",
                     held_out ? "held_out_total,held_out_belief_accuracy," : "");
}

std::string evaluation_row(const sct::Evaluation& evaluation, bool kept) {
  const auto& best = sct::best_target(evaluation);
  std::string row = fmt::format("{},{},{},{},{},{},", evaluation.steps, evaluation.belief_loss, evaluation.action_loss,
                                best.target, best.total, number_or_nothing(best.accuracy));
  if (best.held_out) row += fmt::format("{},{},", best.held_out->total, number_or_nothing(best.held_out->accuracy));
  return row + (kept ? "yes\n" : "no\n");
}

std::string evaluation_table(const std::vector<sct::Evaluation>& history, std::size_t kept, bool held_out) {
  std::string table = evaluation_heading(held_out);
  for (std::size_t i = 0; i < history.size(); ++i) table += evaluation_row(history[i], i == kept);
  return table;
}

std::string evaluation_table_so_far(const std::vector<sct::Evaluation>& history, bool held_out) {
  std::string table = evaluation_heading(held_out);
  std::size_t kept = 0;
  for (std::size_t i = 0; i < history.size(); ++i) {
    if (sct::takes_over(history[i], history[kept])) kept = i;
    table += evaluation_row(history[i], i == kept);
  }
  return table;
}

}  // namespace folk::tools
