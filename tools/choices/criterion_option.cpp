#include <folk/tools/choices/criterion_option.h>

#include <fmt/format.h>
#include <folk/games/error.h>

#include <optional>

namespace folk::tools {

void add_criterion_options(po::options_description& options) {
  auto add = options.add_options();
  const auto text = [] { return po::value<std::string>(); };
  add("rounds", text(), "rounds of a match (default 100); the same as --criterion finite:N");
  add("criterion", text(), "finite:T (sum), discounted:d (normalised by 1-d), mean, ending:p (expected sum)");
  add("end-probability", text(), "each round is the last with this probability; the same as --criterion ending:p");
}

Criterion chosen_criterion(const po::variables_map& values) {
  std::optional<Criterion> chosen;
  const auto choose = [&](const char* option, const Criterion& criterion) {
    if (chosen && !(*chosen == criterion))
      throw UsageError(fmt::format("--{} says {}, another option says {}: give one of them", option,
                                   criterion.to_string(), chosen->to_string()));
    chosen = criterion;
  };
  if (values.count("rounds") != 0) choose("rounds", Criterion::finite(parse_rounds(text_option(values, "rounds"))));
  if (values.count("criterion") != 0) choose("criterion", Criterion::parse(text_option(values, "criterion")));
  if (values.count("end-probability") != 0)
    choose("end-probability",
           Criterion::ending(parse_exact_number(text_option(values, "end-probability"), "--end-probability", 0, 1)));
  return chosen.value_or(Criterion::finite(100));
}

}  // namespace folk::tools
