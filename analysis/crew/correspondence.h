#pragma once
// The messages of one rank, work by work.

#include <folk/analysis/crew/messages.h>
#include <folk/analysis/crew/transport.h>

#include <cstddef>
#include <cstdint>
#include <deque>
#include <functional>
#include <memory>
#include <optional>
#include <string_view>
#include <utility>

namespace folk {

class Correspondence {
public:
  explicit Correspondence(std::unique_ptr<Transport> transport)
      : transport_(std::move(transport)) {}

  std::size_t rank() const { return transport_->rank(); }
  std::size_t ranks() const { return transport_->ranks(); }

  /// All ranks count alike: what is said about the next work waits until this rank comes to it.
  void begin_run() { ++run_; }
  std::uint64_t run() const { return run_; }

  struct Letter {
    std::size_t from = 0;
    MessageHead head{};
    std::string bytes{};  ///< all of it
    std::string_view content() const { return std::string_view(bytes).substr(message_head_size); }
  };

  /// The next message about this work or about none, if there is one. That a rank has failed waits until there is work:
  /// what has ended that rank's program may be about to end this one's.
  std::optional<Letter> receive();

  void send(std::size_t to, Word word, std::uint64_t number, std::string_view content = {}) {
    transport_->send(to, message({word, run_, number}, content));
  }

  /// From rank 0 to each other rank.
  void send_all(Word word, std::string_view content = {});

  /// What rank 0 tells all goes from rank to rank down a binary tree: to those that hear it from this one.
  void pass_on(std::string bytes);

  void close() { transport_->close(); }

private:
  std::unique_ptr<Transport> transport_;
  std::uint64_t run_ = 0;
  std::deque<Letter> waiting_;
};

}  // namespace folk
