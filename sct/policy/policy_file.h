#pragma once
// Policies as files: one safetensors file holds the network and everything needed to let it play. The whole format,
// every key of its metadata, is in docs/policy-files.md.

#include <folk/sct/policy/policy.h>

#include <cstddef>
#include <filesystem>
#include <string>
#include <string_view>

namespace folk::sct {

/// What the metadata key "format" says in the files that this Folk writes and reads; the second in files of policies
/// that plan or whose return tokens are hidden, which the first does not know.
inline constexpr std::string_view policy_format = "folk-sct-1";
inline constexpr std::string_view planning_policy_format = "folk-sct-2";

/// No policy file that Folk reads is larger than this.
inline constexpr std::size_t largest_policy_file = std::size_t{1} << 30U;

/// Reads the bytes of a policy file; `source` (a path) is what messages call them. Nothing in them is taken on trust,
/// and no more memory is asked for than the bytes account for.
/// Throws InputFileError "source: what; mend" on the first fault: a file that ends too soon or goes on too long, a
/// header that is no such JSON or tells of other tensors, types, shapes or places than its architecture has, a foreign
/// or newer format, metadata out of range, a number that is not finite, a checksum that the contents do not have.
Policy parse_policy(std::string_view bytes, const std::string& source);

/// parse_policy of a file's bytes. Also throws InputFileError when the file cannot be read.
Policy read_policy(const std::filesystem::path& path);

/// The bytes of a policy's file: equal policies give equal bytes, and parse_policy gives back the same policy, its
/// doubles exactly. (Bytes in a text that are not UTF-8 become U+FFFD.)
/// Throws UsageError for a policy that parse_policy would refuse: a wrong number of parameters, one that is not finite,
/// names that do not fit the actions.
std::string policy_bytes(const Policy& policy);

/// Writes policy_bytes at once or not at all (write_file of games/text_file.h). Throws UsageError, EnvironmentError.
void write_policy(const std::filesystem::path& path, const Policy& policy);

}  // namespace folk::sct
