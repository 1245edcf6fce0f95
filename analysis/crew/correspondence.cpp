#include <folk/analysis/crew/correspondence.h>

#include <algorithm>

namespace folk {
namespace {

/// The end of a rank's program, or its failure outside of shared work.
bool about_none(const MessageHead& head) {
  return head.word == Word::leave || (head.word == Word::failed && head.number == no_piece);
}

}  // namespace

std::optional<Correspondence::Letter> Correspondence::receive() {
  while (auto received = transport_->receive()) {
    Letter letter{received->from, {}, std::move(received->bytes)};
    Unpacker bytes(letter.bytes);
    letter.head = read_head(bytes);
    waiting_.push_back(std::move(letter));
  }
  std::erase_if(waiting_, [this](const Letter& letter) { return !about_none(letter.head) && letter.head.run < run_; });
  const auto timely = [this](const Letter& letter) {
    return letter.head.word == Word::leave || (about_none(letter.head) ? run_ > 0 : letter.head.run == run_);
  };
  const auto found = std::find_if(waiting_.begin(), waiting_.end(), timely);
  if (found == waiting_.end()) return std::nullopt;
  Letter letter = std::move(*found);
  waiting_.erase(found);
  return letter;
}

void Correspondence::send_all(Word word, std::string_view content) {
  const auto bytes = message({word, run_, 0}, content);
  for (std::size_t rank = 1; rank < ranks(); ++rank) transport_->send(rank, bytes);
}

void Correspondence::pass_on(std::string bytes) {
  const auto shared = std::make_shared<const std::string>(std::move(bytes));
  for (const std::size_t child : {2 * rank() + 1, 2 * rank() + 2})
    if (child < ranks()) transport_->send(child, shared);
}

}  // namespace folk
