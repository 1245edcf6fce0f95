#include <folk/python/bindings/long_call.h>

#include <atomic>
#include <chrono>
#include <csignal>
#include <functional>
#include <string>
#include <utility>

namespace folk::python {
namespace {

std::atomic<unsigned> interruptions{0};
struct sigaction python_action {};  // Python's own, while a SignalWatch lives
unsigned watches = 0;

void count_interruption(int number) {
  interruptions.fetch_add(1, std::memory_order_relaxed);
  python_action.sa_handler(number);
}

bool in_main_thread() {
  const py::module_ threading = py::module_::import("threading");
  return threading.attr("current_thread")().is(threading.attr("main_thread")());
}

/// sys.stderr where it goes to the page of a notebook, else nothing.
py::object notebook_page() {
  py::object stream = py::module_::import("sys").attr("stderr");
  const auto module = py::str(py::type::of(stream).attr("__module__")).cast<std::string>();
  return module.starts_with("ipykernel") ? stream : py::object();
}

using Clock = std::chrono::steady_clock;
constexpr auto pause = std::chrono::milliseconds(100);

}  // namespace

SignalWatch::SignalWatch()
    : before_(interruptions) {
  if (!in_main_thread()) return;
  watches_ = true;
  if (watches++ > 0) return;  // a callback of a long call may make one of its own
  ::sigaction(SIGINT, nullptr, &python_action);
  const auto handler = python_action.sa_handler;
  if (handler == SIG_IGN || handler == SIG_DFL) return;
  struct sigaction action = python_action;
  action.sa_handler = count_interruption;
  ::sigaction(SIGINT, &action, nullptr);
}

SignalWatch::~SignalWatch() {
  if (!watches_ || --watches > 0) return;
  struct sigaction now {};
  ::sigaction(SIGINT, nullptr, &now);
  if (now.sa_handler == count_interruption) ::sigaction(SIGINT, &python_action, nullptr);
}

bool SignalWatch::signalled() const { return watches_ && interruptions != before_; }

LongCall::LongCall(std::string what, const py::object& progress) {
  const auto stop = [this] { return signals_.signalled(); };
  if (PyCallable_Check(progress.ptr()) == 1) {
    told_ = progress;
    const auto next = std::make_shared<Clock::time_point>(Clock::now());
    progress_ = Progress(
        [this, next](double share) {
          const auto now = Clock::now();
          if (now < *next && share < 1) return;
          *next = now + pause;
          const py::gil_scoped_acquire acquired;
          told_(share);
        },
        stop);
  } else {
    if (progress.is_none()) page_ = notebook_page();
    if (page_)
      bar_ = std::make_unique<tools::ProgressBar>(std::move(what), [this](const std::string& text) {
        const py::gil_scoped_acquire acquired;
        page_.attr("write")(text);
        page_.attr("flush")();
      });
    else
      bar_ = std::make_unique<tools::ProgressBar>(std::move(what), progress.is_none());
    progress_ = Progress(std::ref(*bar_), stop);
  }
}

void LongCall::raise_signals() {
  if (PyErr_CheckSignals() != 0) throw py::error_already_set();
}

}  // namespace folk::python
