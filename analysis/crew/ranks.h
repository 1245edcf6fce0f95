#pragma once
// The processes that a launcher started together, as a crew.

#include <folk/analysis/crew/crew.h>
#include <folk/analysis/crew/failure.h>
#include <folk/analysis/crew/transport.h>

#include <cstdint>
#include <exception>
#include <memory>

namespace folk {

/// Rank 0 hands out pieces as ranks become free, and its own threads do pieces like all others. Each rank has its own
/// number of threads. Messages are sent and received by the thread that calls run alone; while it waits for them it
/// sleeps.
class Ranks : public Crew {
public:
  /// `transport` has at least one rank.
  explicit Ranks(std::unique_ptr<Transport> transport);
  ~Ranks() override;

  std::size_t ranks() const override;
  std::size_t rank() const override;

  /// Before the first work: rank 0 hears from all others that they were given the same `command`, a signature of it.
  /// Throws UsageError where one was given another, and Cancelled.
  void agree(std::uint64_t command, const Progress& progress = nullptr) const;

  /// As Crew says. What another rank threw outside of it, on its way to this work, is thrown with that rank's number.
  /// Throws EnvironmentError where another rank has other work, and Dismissed.
  void run(const SharedWork& work, const Progress& progress = nullptr) const override;

  std::string tell(std::string bytes) const override;

  /// The last call of every rank's program: rank 0 dismisses the others, they wait for it. `failure`: what ended this
  /// rank's program; of other ranks rank 0 hears it, where it is still at work.
  void leave(const std::exception_ptr& failure = nullptr);

private:
  void help_until_dismissed(const SharedWork& work, const Progress& progress) const;

  struct State;
  std::unique_ptr<State> state_;
};

}  // namespace folk
