#pragma once
// A call into the library that may last: without the GIL, with progress, ended by Ctrl-C.

#include <folk/games/progress.h>
#include <folk/tools/program/progress.h>

#include <pybind11/pybind11.h>

#include <cstddef>
#include <functional>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>

namespace folk::python {

namespace py = pybind11;

/// SIGINT, while one lives in the main thread, is also counted where any thread of the library sees it; Python's own
/// handler runs as ever.
class SignalWatch {
public:
  SignalWatch();
  ~SignalWatch();
  SignalWatch(const SignalWatch&) = delete;
  SignalWatch& operator=(const SignalWatch&) = delete;

  /// True when one came since this was made.
  bool signalled() const;

private:
  bool watches_ = false;
  unsigned before_ = 0;
};

/// What long work is told, out of the argument `progress` of a Python call: None shows a bar where stderr is a
/// terminal or a notebook's, False nothing, and a function gets the finished share, from 0 to 1, some ten times a
/// second and at the end. What the function raises ends the work.
class LongCall {
public:
  LongCall(std::string what, const py::object& progress);

  /// Does `work(progress)` without the GIL. What it throws is thrown; KeyboardInterrupt after Ctrl-C.
  template <class Work>
  auto run(Work&& work) {
    try {
      const py::gil_scoped_release released;
      if constexpr (std::is_void_v<decltype(work(progress_))>) {
        work(progress_);
      } else {
        auto result = work(progress_);
        return end(std::move(result));
      }
    } catch (const Cancelled&) {
      raise_signals();
      throw;
    }
    raise_signals();
  }

private:
  /// Still without the GIL.
  template <class Result>
  Result end(Result result) {
    const py::gil_scoped_acquire acquired;
    raise_signals();
    return result;
  }

  static void raise_signals();

  SignalWatch signals_;
  py::object page_;  ///< that the bar is drawn on
  std::unique_ptr<tools::ProgressBar> bar_;
  py::object told_;
  Progress progress_;
};

/// What is short enough not to be ended, and may still keep other threads of Python waiting.
template <class Work>
auto without_gil(Work&& work) {
  const py::gil_scoped_release released;
  return work();
}

}  // namespace folk::python
