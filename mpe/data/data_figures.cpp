#include <folk/analysis/play/parallel.h>
#include <folk/games/error.h>
#include <folk/mpe/data/data_figures.h>
#include <folk/sct/files/checksum.h>
#include <folk/sct/files/little_endian.h>

#include <fmt/format.h>

#include <cmath>
#include <vector>

namespace folk::mpe {
namespace {

/// Over the episodes in their order.
MeanReturn mean_return(const std::vector<double>& returns) {
  const auto n = static_cast<double>(returns.size());
  double sum = 0;
  for (const double value : returns) sum += value;
  MeanReturn result{sum / n, std::nullopt};
  if (returns.size() < 2) return result;
  double squares = 0;
  for (const double value : returns) squares += (value - result.mean) * (value - result.mean);
  result.standard_error = std::sqrt(squares / (n - 1) / n);
  return result;
}

double episode_return(const DataSet& data, std::size_t agent, std::size_t episode) {
  double sum = 0;
  for (std::size_t step = 0; step < data.episode_steps(); ++step)
    sum += static_cast<double>(data.reward(agent, episode * data.episode_steps() + step));
  return sum;
}

}  // namespace

std::uint64_t episode_signature(std::span<const std::string_view> rows) {
  sct::Checksum sum;
  for (const std::string_view bytes : rows) {
    std::size_t at = 0;
    for (; at + 8 <= bytes.size(); at += 8) sum.add(sct::load_little_endian<std::uint64_t>(bytes.substr(at, 8)));
    sum.add(bytes.substr(at));
  }
  return sum.value();
}

DataFigures data_figures(const DataSet& data, unsigned threads, const Progress& progress) {
  std::vector<std::uint64_t> signatures(data.episodes());
  std::vector<double> predator(data.episodes());
  std::vector<double> prey(data.episodes());
  parallel_for((data.episodes() + episodes_in_piece - 1) / episodes_in_piece, threads,
               [&](std::size_t piece, unsigned) {
                 const std::size_t begin = piece * episodes_in_piece;
                 for (std::size_t e = begin; e < std::min(begin + episodes_in_piece, data.episodes()); ++e) {
                   signatures[e] = episode_signature(data.episode_bytes(e));
                   predator[e] = episode_return(data, 0, e);
                   prey[e] = episode_return(data, data.scenario().prey(), e);
                 }
               },
               progress);
  sct::Checksum all;
  for (const std::uint64_t signature : signatures) all.add(signature);
  return {all.value(), mean_return(predator), mean_return(prey)};
}

void require_recorded(const DataSet& data, const DataFigures& figures) {
  if (data.record() && data.record()->figures.signature != figures.signature)
    throw InputFileError(fmt::format("{}: the numbers' signature is {:016x}, but {} says {:016x}; take a fresh copy",
                                     excerpt(data.source(), 1000), figures.signature, metadata_name,
                                     data.record()->figures.signature));
}

}  // namespace folk::mpe
