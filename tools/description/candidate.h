#pragma once
// What a word that is being typed may become.

#include <string>
#include <string_view>
#include <vector>

namespace folk::tools {

struct Candidate {
  std::string text;       ///< the whole word
  std::string meaning{};  ///< in a few words
  bool complete = true;   ///< else more of the word follows: "discounted:"
};

/// Adds what begins with `begun`, each after `prefix`: what stands before it in its word.
inline void add_beginning_with(std::vector<Candidate>& candidates, std::string_view prefix, std::string_view begun,
                               const std::vector<Candidate>& all) {
  for (const auto& [text, meaning, complete] : all)
    if (text.starts_with(begun)) candidates.push_back({std::string(prefix) + text, meaning, complete});
}

/// What a path may name that is being typed.
enum class PathKind { file, folder };

/// The files and folders, or the folders alone, that the path may become; ~ is the home folder.
std::vector<Candidate> path_candidates(std::string_view prefix, std::string_view path, PathKind kind = PathKind::file);

}  // namespace folk::tools
