#include "standard_names.h"

#include "policy_names.h"

#include <folk/analysis/bayes_player.h>

namespace folk::tools {

Registry standard_names(const sct::PlayOptions& options) {
  Registry registry = Registry::standard();
  add_policies(registry, options);
  add_bayes(registry);
  return registry;
}

}  // namespace folk::tools
