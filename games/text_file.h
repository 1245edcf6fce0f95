#pragma once
// Reading and writing whole files, texts above all, without losing anything.

#include <cstddef>
#include <filesystem>
#include <functional>
#include <iosfwd>
#include <string>
#include <string_view>

namespace folk {

/// No text that Folk reads (games, machines) is larger than this.
inline constexpr std::size_t largest_text_file = std::size_t{64} << 20U;

/// The file's bytes; a pipe is read to its end. Throws InputFileError when it does not exist, is a directory, is larger
/// than `largest` bytes (whole MiB) or cannot be read.
std::string read_file(const std::filesystem::path& path, std::size_t largest);

/// read_file up to largest_text_file.
std::string read_text_file(const std::filesystem::path& path);

/// read_file of what must be an ordinary file: a pipe or a device would be waited for. Throws InputFileError.
std::string read_ordinary_file(const std::filesystem::path& path, std::size_t largest);

/// The folder that a file lies in; "." for a bare name.
std::filesystem::path folder_of(const std::filesystem::path& path);

/// Throws EnvironmentError for what can be known before the work: that `path` is no name of a file, too long, a
/// directory, or in a folder that is missing or may not be written to.
void require_writable(const std::filesystem::path& path);

/// Writes to a temporary name in the same folder, which nobody can guess or take, waits for the disk and renames it, so
/// that a reader sees the old file or the whole new one, after a power cut too. Permissions stay.
/// A symbolic link stays one and the file it names is made or replaced; a device or pipe (/dev/null) is written to
/// directly. Throws EnvironmentError when the folder does not exist or cannot be written, the disk is full, or a limit
/// of file sizes is met (whose signal, SIGXFSZ, is the host's to ignore). What `content` throws is passed on, and the
/// old file stays.
void write_file(const std::filesystem::path& path, const std::function<void(std::ostream&)>& content);
void write_file(const std::filesystem::path& path, std::string_view content);

/// Removes from a folder what writers have left that were killed in the middle of one.
void remove_cut_off_writes(const std::filesystem::path& folder);

}  // namespace folk
