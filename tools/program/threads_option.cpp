#include <folk/analysis/play/parallel.h>
#include <folk/tools/program/launch.h>
#include <folk/tools/program/threads_option.h>

#include <fmt/format.h>

#include <algorithm>
#include <latch>
#include <thread>

#include <unistd.h>

namespace folk::tools {
namespace {

/// How many of `wanted` threads, this one among them, can be at work at once.
unsigned startable(unsigned wanted) {
  std::latch all_there(1);
  const std::function<void(unsigned)> wait = [&](unsigned) { all_there.wait(); };
  const auto others = start_threads(wanted - 1, wait);
  all_there.count_down();
  return static_cast<unsigned>(others.size()) + 1;
}

/// One a processor that this process may use. Ranks that may use all of a machine divide them.
unsigned usual_threads() {
  const unsigned processors = std::max(1U, std::thread::hardware_concurrency());
  const long all = ::sysconf(_SC_NPROCESSORS_ONLN);
  if (all > 0 && processors < static_cast<unsigned long>(all)) return processors;  // the launcher has divided them
  return std::max(1U, processors / static_cast<unsigned>(ranks_here()));
}

}  // namespace

unsigned threads_option(const po::variables_map& values, const Common& common) {
  const auto wanted = static_cast<unsigned>(whole_option(values, "threads", std::min(256U, usual_threads()), 1, 256));
  const unsigned there = startable(wanted);
  if (there < wanted)
    common.note(
        fmt::format("note: {} of {} threads can be started here; the results do not depend on it", there, wanted));
  return there;
}

}  // namespace folk::tools
