#include <folk/sct/files/made_folder.h>

namespace folk::sct {

namespace fs = std::filesystem;

MadeFolder::MadeFolder(const fs::path& folder, std::error_code& error) {
  std::error_code ignored;
  // Absolute: the working folder may be another one at the end.
  const fs::path whole = fs::absolute(folder, ignored).lexically_normal();
  for (fs::path missing = whole.has_filename() ? whole : whole.parent_path();
       missing.has_relative_path() && !fs::exists(fs::symlink_status(missing, ignored));
       missing = missing.parent_path())
    made_.push_back(missing);
  fs::create_directories(folder, error);
}

MadeFolder::~MadeFolder() {
  std::error_code ignored;
  for (const fs::path& folder : made_) fs::remove(folder, ignored);  // removes no folder that holds anything
}

}  // namespace folk::sct
