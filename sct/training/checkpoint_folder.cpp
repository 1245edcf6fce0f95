#include <folk/sct/training/checkpoint_folder.h>

namespace folk::sct {

std::optional<Checkpoint> CheckpointFolder::newest(const std::function<void(const std::string&)>& skipped) const {
  std::optional<Checkpoint> found;
  read_newest([&](std::string_view bytes, const std::string& source) { found = parse_checkpoint(bytes, source); },
              skipped);
  return found;
}

void CheckpointFolder::write(const Checkpoint& checkpoint) {
  write_bytes(checkpoint.training.optimiser.steps, checkpoint_bytes(checkpoint));
}

}  // namespace folk::sct
