#include <folk/python/players/time_out.h>

#include <csignal>

namespace folk::python {
namespace {

namespace py = pybind11;

/// A signal that comes just before the call begins to wait wakes nobody, so it is sent again after this time.
constexpr auto patience = std::chrono::seconds(1);

/// True where SIGINT raises KeyboardInterrupt, which also ends a wait of the main thread.
bool signals_raise() {
  const py::module_ signal = py::module_::import("signal");
  return signal.attr("getsignal")(SIGINT).is(signal.attr("default_int_handler"));
}

bool is_main_thread(unsigned long ident) {
  return py::module_::import("threading").attr("main_thread")().attr("ident").cast<unsigned long>() == ident;
}

}  // namespace

TimeOut::TimeOut(std::optional<double> seconds) {
  if (seconds) most_ = std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(*seconds));
}

TimeOut::~TimeOut() {
  if (!watcher_.joinable()) return;
  {
    const std::lock_guard lock(mutex_);
    over_ = true;
  }
  changed_.notify_one();
  if (PyGILState_Check() == 1) {  // which the watcher may wait for
    const py::gil_scoped_release released;
    watcher_.join();
  } else {
    watcher_.join();
  }
}

void TimeOut::begin() {
  if (!most_) return;
  const auto caller = PyThread_get_thread_ident();
  const std::lock_guard lock(mutex_);
  if (caller != caller_) {
    caller_ = caller;
    thread_ = ::pthread_self();
    in_main_thread_ = is_main_thread(caller);
  }
  due_ = Clock::now() + *most_;
  if (!watcher_.joinable()) watcher_ = std::thread([this] { watch(); });
}

bool TimeOut::end() {
  if (!most_) return false;
  const std::lock_guard lock(mutex_);
  due_.reset();
  if (!interrupted_) return false;
  interrupted_ = false;
  PyThreadState_SetAsyncExc(caller_, nullptr);
  if (PyErr_CheckSignals() != 0) PyErr_Clear();
  return true;
}

void TimeOut::watch() {
  std::unique_lock lock(mutex_);
  while (!over_) {
    const auto until = due_.value_or(Clock::now() + *most_);
    changed_.wait_until(lock, until);
    if (over_ || !due_ || Clock::now() < *due_) continue;
    const auto call = due_;
    lock.unlock();  // whoever holds the GIL may wait for the mutex
    {
      const py::gil_scoped_acquire acquired;
      const std::lock_guard again(mutex_);
      if (due_ == call) interrupt();
    }
    lock.lock();
  }
}

void TimeOut::interrupt() {
  interrupted_ = true;
  due_ = Clock::now() + patience;
  if (in_main_thread_ && signals_raise())
    ::pthread_kill(thread_, SIGINT);
  else
    PyThreadState_SetAsyncExc(caller_, PyExc_TimeoutError);
}

}  // namespace folk::python
