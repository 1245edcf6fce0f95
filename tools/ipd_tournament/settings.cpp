#include <folk/tools/ipd_tournament/settings.h>

#include <folk/tools/choices/criterion_option.h>
#include <folk/tools/program/threads_option.h>

#include <cstdint>

namespace folk::tools {

TournamentSettings chosen_settings(const po::variables_map& values, const Common& common, const Payoffs& payoffs) {
  TournamentSettings settings;
  settings.payoffs = payoffs;
  settings.criterion = chosen_criterion(values);
  settings.noise = parse_number(text_option(values, "noise"), "--noise", 0, 1);
  settings.self_play = values.count("no-self-play") == 0;
  settings.repetitions = whole_option(values, "repetitions", 100, 1, 10'000'000);
  settings.seed = whole_option(values, "seed", 1, 0, ~std::uint64_t{0});
  settings.threads = threads_option(values, common);
  return settings;
}

}  // namespace folk::tools
