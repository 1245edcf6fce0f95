#pragma once
// What carries messages from rank to rank: MPI (mpi/), or queues within one process in tests. A header alone, so that
// what is loaded at run time needs nothing else of Folk.

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace folk {

/// The messages of one rank, for one of its threads. From one rank to another they arrive in the order of sending.
class Transport {
public:
  struct Message {
    std::size_t from = 0;
    std::string bytes{};
  };

  virtual ~Transport() = default;
  virtual std::size_t rank() const = 0;
  virtual std::size_t ranks() const = 0;

  /// Returns at once; the bytes are kept until they are gone.
  virtual void send(std::size_t to, std::shared_ptr<const std::string> bytes) = 0;

  /// A message that has arrived, if there is one; does not wait.
  virtual std::optional<Message> receive() = 0;

  /// Waits until all that was sent is gone and every rank has closed.
  virtual void close() = 0;
};

}  // namespace folk
