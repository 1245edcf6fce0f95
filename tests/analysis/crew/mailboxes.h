#pragma once
// Ranks within one process: a thread each, with queues for messages.

#include <folk/analysis/crew/ranks.h>
#include <folk/analysis/crew/transport.h>

#include <atomic>
#include <cstddef>
#include <deque>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>
#include <thread>
#include <utility>
#include <vector>

namespace folk::test {

struct Mailbox {
  std::mutex mutex;
  std::deque<Transport::Message> messages;
};

class MailboxTransport : public Transport {
public:
  MailboxTransport(std::vector<Mailbox>& boxes, std::size_t rank)
      : boxes_(boxes),
        rank_(rank) {}

  std::size_t rank() const override { return rank_; }
  std::size_t ranks() const override { return boxes_.size(); }

  void send(std::size_t to, std::shared_ptr<const std::string> bytes) override {
    const std::lock_guard lock(boxes_[to].mutex);
    boxes_[to].messages.push_back({rank_, *bytes});
  }

  std::optional<Message> receive() override {
    const std::lock_guard lock(boxes_[rank_].mutex);
    if (boxes_[rank_].messages.empty()) return std::nullopt;
    Message message = std::move(boxes_[rank_].messages.front());
    boxes_[rank_].messages.pop_front();
    return message;
  }

  void close() override {}

private:
  std::vector<Mailbox>& boxes_;
  std::size_t rank_;
};

/// Runs `program` on so many ranks at once, each of which leaves at its end, and returns what each of them threw.
inline std::vector<std::exception_ptr> on_ranks(std::size_t count, const std::function<void(Ranks&)>& program) {
  std::vector<Mailbox> boxes(count);
  std::vector<std::exception_ptr> thrown(count);
  {
    std::vector<std::jthread> threads;
    for (std::size_t rank = 0; rank < count; ++rank)
      threads.emplace_back([&, rank] {
        Ranks ranks(std::make_unique<MailboxTransport>(boxes, rank));
        try {
          program(ranks);
        } catch (...) {
          thrown[rank] = std::current_exception();
        }
        ranks.leave(thrown[rank]);
      });
  }
  return thrown;
}

/// The message of what was thrown; empty for nothing.
inline std::string message_of(const std::exception_ptr& thrown) {
  if (!thrown) return {};
  try {
    std::rethrow_exception(thrown);
  } catch (const std::exception& error) {
    return error.what();
  }
}

}  // namespace folk::test
