#include <folk/tools/choices/standard_names.h>

#include <folk/tools/choices/policy_names.h>

#include <folk/analysis/replies/bayes_player.h>

namespace folk::tools {

Registry standard_names(const sct::PlayOptions& options) {
  Registry registry = Registry::standard();
  add_policies(registry, options);
  add_bayes(registry);
  return registry;
}

}  // namespace folk::tools
