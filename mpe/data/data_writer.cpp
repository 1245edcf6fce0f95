#include <folk/analysis/play/parallel.h>
#include <folk/games/error.h>
#include <folk/mpe/data/data_figures.h>
#include <folk/mpe/data/data_writer.h>
#include <folk/sct/files/little_endian.h>

#include <fcntl.h>
#include <fmt/format.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <string_view>
#include <system_error>
#include <utility>

namespace folk::mpe {

namespace fs = std::filesystem;

namespace {

constexpr std::size_t word = 8;

[[noreturn]] void fail(const fs::path& path, const std::string& what, int reason) {
  throw EnvironmentError(fmt::format("{}: {}: {}", excerpt(path.string(), 1000), what, std::strerror(reason)));
}

void write_at(const FileDescriptor& file, const fs::path& path, std::string_view bytes, std::size_t place) {
  if (const auto error = write_all_at(file, bytes, place)) fail(path, "cannot be written", error.value());
}

std::string read_at(int file, const fs::path& path, std::size_t size, std::size_t place) {
  std::string bytes(size, '\0');
  std::size_t done = 0;
  while (done < size) {
    const auto count = ::pread(file, bytes.data() + done, size - done, static_cast<off_t>(place + done));
    if (count < 0 && errno == EINTR) continue;
    if (count < 0) fail(path, "cannot be read", errno);
    if (count == 0) break;  // what lies beyond the end is not there: zeros
    done += static_cast<std::size_t>(count);
  }
  return bytes;
}

std::string reserved(std::size_t bytes) {
  return fmt::format("{:.1f} MB cannot be reserved; make room or name another disk", static_cast<double>(bytes) / 1e6);
}

}  // namespace

std::vector<std::uint64_t> episode_signatures(const RowBytes& rows, const std::vector<std::size_t>& episode_bytes) {
  const std::size_t episodes = rows.front().size() / episode_bytes.front();
  std::vector<std::uint64_t> signatures;
  std::vector<std::string_view> one(rows.size());
  for (std::size_t e = 0; e < episodes; ++e) {
    for (std::size_t f = 0; f < rows.size(); ++f)
      one[f] = std::string_view(rows[f]).substr(e * episode_bytes[f], episode_bytes[f]);
    signatures.push_back(episode_signature(one));
  }
  return signatures;
}

DataWriter::File DataWriter::opened(fs::path path, std::size_t begin, std::size_t episode_bytes, std::size_t episodes) {
  File file{std::move(path), FileDescriptor(), begin, episode_bytes};
  file.descriptor = FileDescriptor(::open(file.path.c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666));
  if (file.descriptor.get() < 0) fail(file.path, "cannot be made", errno);
  const std::size_t size = begin + episode_bytes * episodes;
  // A full disk is noticed before the work, not in it.
  if (const int reason = ::posix_fallocate(file.descriptor.get(), 0, static_cast<off_t>(size)))
    fail(file.path, reserved(size), reason);
  return file;
}

DataWriter::DataWriter(fs::path folder, const Scenario& scenario, sct::NpyType type, std::size_t episodes)
    : episodes_(episodes) {
  const std::size_t rows = episodes * scenario.episode_steps;
  for (const DataFile& one : data_files(scenario.agents())) {
    const std::string header = npy_header_bytes(one.shape(scenario, rows), type);
    const std::size_t episode_bytes = scenario.episode_steps * one.width(scenario) * bytes_of(type);
    File file = opened(folder / one.name(), header.size(), episode_bytes, episodes);
    write_at(file.descriptor, file.path, header, 0);
    total_bytes_ += header.size() + episode_bytes * episodes;
    files_.push_back(std::move(file));
  }
  journal_ = opened(folder / "journal", 0, word, episodes);
}

void DataWriter::write(std::size_t first, const RowBytes& rows) {
  std::vector<std::size_t> sizes;
  for (std::size_t f = 0; f < files_.size(); ++f) {
    const File& file = files_[f];
    write_at(file.descriptor, file.path, rows[f], file.begin + first * file.episode_bytes);
    sizes.push_back(file.episode_bytes);
  }
  std::string words;
  for (const std::uint64_t signature : episode_signatures(rows, sizes)) sct::append_little_endian(words, signature);
  write_at(journal_.descriptor, journal_.path, words, first * word);
}

std::uint64_t DataWriter::signature(std::size_t episode) const {
  return sct::load_little_endian<std::uint64_t>(
      read_at(journal_.descriptor.get(), journal_.path, word, episode * word));
}

std::vector<bool> DataWriter::written_in(std::size_t begin, std::size_t end) const {
  const std::size_t count = end - begin;
  const std::string words = read_at(journal_.descriptor.get(), journal_.path, count * word, begin * word);
  std::vector<bool> there(count, false);
  if (std::all_of(words.begin(), words.end(), [](char byte) { return byte == 0; })) return there;
  RowBytes rows;
  std::vector<std::size_t> sizes;
  for (const File& file : files_) {
    rows.push_back(
        read_at(file.descriptor.get(), file.path, count * file.episode_bytes, file.begin + begin * file.episode_bytes));
    sizes.push_back(file.episode_bytes);
  }
  const auto signatures = episode_signatures(rows, sizes);
  for (std::size_t e = 0; e < count; ++e)
    there[e] = signatures[e] == sct::load_little_endian<std::uint64_t>(std::string_view(words).substr(e * word));
  return there;
}

std::vector<bool> DataWriter::written(unsigned threads) const {
  const std::size_t pieces = (episodes_ + episodes_in_piece - 1) / episodes_in_piece;
  std::vector<std::vector<bool>> found(pieces);
  parallel_for(pieces, threads, [&](std::size_t piece, unsigned) {
    const std::size_t begin = piece * episodes_in_piece;
    found[piece] = written_in(begin, std::min(begin + episodes_in_piece, episodes_));
  });
  std::vector<bool> all;
  for (const auto& piece : found) all.insert(all.end(), piece.begin(), piece.end());
  return all;
}

void DataWriter::finish() {
  for (const File& file : files_)
    if (::fsync(file.descriptor.get()) != 0) fail(file.path, "cannot be written", errno);
  files_.clear();
  journal_.descriptor.close();
}

void DataWriter::remove_journal() {
  std::error_code error;
  fs::remove(journal_.path, error);
  if (error) fail(journal_.path, "cannot be removed", error.value());
}

}  // namespace folk::mpe
