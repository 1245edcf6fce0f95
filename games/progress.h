#pragma once
// How far long work has got, and whether it is to go on.

#include <folk/games/error.h>

#include <atomic>
#include <concepts>
#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

namespace folk {

/// Work was told to stop by whoever asked for it. Nothing is wrong.
class Cancelled : public Error {
public:
  explicit Cancelled(const std::string& what = "cancelled")
      : Error(what) {}
};

/// Who asks for long work hands it a Progress: it is told the finished share, and it may end the work, in three ways.
/// What its function throws, and Cancelled after cancel() or once its question is answered with yes, leaves the call
/// that does the work, on whatever thread it came up. What the call had begun is then as its documentation says.
///
/// Copies, and their parts, are told and cancelled together.
class Progress {
public:
  /// Nobody is told, and nothing but cancel() ends the work.
  Progress();

  /// Nobody is told and nothing ends the work, not even cancel(): what calls take that are given no other. Costs
  /// nothing.
  Progress(std::nullptr_t) {}

  /// `told` is called with the finished share, 0 to 1, by one thread at a time, though not always by the same. `stop`,
  /// where given, is asked between pieces of the work whether it is to end, by any of its threads.
  template <class Told>
  requires(!std::same_as<std::remove_cvref_t<Told>, Progress> && std::convertible_to<Told, std::function<void(double)>>)
      Progress(Told&& told, std::function<bool()> stop = nullptr)
      : Progress(std::make_shared<State>(std::forward<Told>(told), std::move(stop))) {}

  /// Any thread may call it, the function that is told the shares among them.
  void cancel() const;

  /// True once cancel() was called or the question was answered with yes.
  bool cancelled() const;

  // For who does the work.

  /// Tells the finished share. Throws Cancelled, and what the function throws. One thread at a time. When all is done
  /// nobody is asked any more whether to end.
  void operator()(double share) const;

  /// Throws Cancelled where the work is to end. Any thread.
  void check() const;

  /// For a stage of the work: its shares 0 to 1 are told as `begin` to `end` of this one's.
  Progress part(double begin, double end) const;

  /// False where nobody listens.
  explicit operator bool() const { return state_ != nullptr; }

private:
  struct State {
    State(std::function<void(double)> function, std::function<bool()> question)
        : told(std::move(function)),
          stop(std::move(question)) {}

    std::function<void(double)> told;
    std::function<bool()> stop;
    std::atomic<bool> cancelled{false};
  };

  explicit Progress(std::shared_ptr<State> state)
      : state_(std::move(state)) {}

  std::shared_ptr<State> state_;
  double begin_ = 0;
  double end_ = 1;
};

}  // namespace folk
