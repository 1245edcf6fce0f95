// The messages of ranks over MPI, by Boost.MPI. This is all of the component that programs load when a launcher has
// started several of them: no program is linked with MPI.

#include <folk/analysis/crew/transport.h>

#include <boost/mpi/communicator.hpp>
#include <boost/mpi/environment.hpp>
#include <boost/mpi/request.hpp>

#include <chrono>
#include <cstddef>
#include <deque>
#include <limits>
#include <memory>
#include <stdexcept>
#include <string>
#include <thread>
#include <utility>

namespace folk {
namespace {

namespace mpi = boost::mpi;

class MpiTransport : public Transport {
public:
  MpiTransport()
      : environment_(mpi::threading::funneled, false) {}

  std::size_t rank() const override { return static_cast<std::size_t>(world_.rank()); }
  std::size_t ranks() const override { return static_cast<std::size_t>(world_.size()); }

  void send(std::size_t to, std::shared_ptr<const std::string> bytes) override {
    if (bytes->size() > static_cast<std::size_t>(std::numeric_limits<int>::max()))
      throw std::length_error("a piece of the work is larger than an MPI message may be");
    const auto size = static_cast<int>(bytes->size());
    mpi::request request = world_.isend(static_cast<int>(to), tag, bytes->data(), size);
    sent_.push_back({std::move(request), std::move(bytes)});
    forget_what_is_gone();
  }

  std::optional<Message> receive() override {
    forget_what_is_gone();
    const auto status = world_.iprobe(mpi::any_source, tag);
    if (!status) return std::nullopt;
    Message message{static_cast<std::size_t>(status->source()), {}};
    message.bytes.resize(static_cast<std::size_t>(status->count<char>().value_or(0)));
    world_.recv(status->source(), tag, message.bytes.data(), static_cast<int>(message.bytes.size()));
    return message;
  }

  void close() override {
    for (auto& sent : sent_) wait(sent.request);
    sent_.clear();
    // A barrier of MPI's own would keep a processor busy until the last rank is there.
    MPI_Request all_there = MPI_REQUEST_NULL;
    MPI_Ibarrier(world_, &all_there);
    for (int there = 0; MPI_Test(&all_there, &there, MPI_STATUS_IGNORE) == MPI_SUCCESS && there == 0;) sleep();
  }

private:
  static constexpr int tag = 1;

  struct Sent {
    mpi::request request;
    std::shared_ptr<const std::string> bytes;
  };

  static void sleep() { std::this_thread::sleep_for(std::chrono::microseconds(200)); }

  void wait(mpi::request& request) {
    while (!request.test()) {
      sleep();
      // What others send meanwhile is nobody's any more, but they may wait until it is taken.
      if (const auto status = world_.iprobe(mpi::any_source, tag)) {
        std::string bytes(static_cast<std::size_t>(status->count<char>().value_or(0)), '\0');
        world_.recv(status->source(), tag, bytes.data(), static_cast<int>(bytes.size()));
      }
    }
  }

  void forget_what_is_gone() {
    while (!sent_.empty() && sent_.front().request.test()) sent_.pop_front();
  }

  mpi::environment environment_;
  mpi::communicator world_;
  std::deque<Sent> sent_;
};

}  // namespace
}  // namespace folk

/// The one name that programs look up: a Transport that is the caller's, or null, and then a message that stays valid.
extern "C" __attribute__((visibility("default"))) folk::Transport* folk_mpi_transport_1(const char** error) {
  try {
    return std::make_unique<folk::MpiTransport>().release();
  } catch (const std::exception& failure) {
    static std::string kept;
    kept = failure.what();
    *error = kept.c_str();
    return nullptr;
  }
}
