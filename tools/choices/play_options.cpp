#include <folk/tools/choices/play_options.h>

namespace folk::tools {

void add_play_options(po::options_description& options) {
  auto add = options.add_options();
  add("sample", "policies (sct, sct-bayes, sct:FILE) draw their moves instead of playing the likelier one");
  add("extrapolate", "policies also play games and lengths of match that they were not trained on");
}

sct::PlayOptions chosen_play_options(const po::variables_map& values) {
  sct::PlayOptions options;
  options.sample = values.count("sample") != 0;
  options.extrapolate = values.count("extrapolate") != 0;
  return options;
}

}  // namespace folk::tools
