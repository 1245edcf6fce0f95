#include <folk/analysis/crew/piece_journal.h>
#include <folk/analysis/crew/seal.h>
#include <folk/analysis/play/signature.h>
#include <folk/games/error.h>

#include <fmt/format.h>

#include <charconv>
#include <optional>

namespace folk {
namespace {

constexpr std::string_view piece_title = "folk piece journal 1";
constexpr std::string_view record_word = "piece ";
constexpr std::size_t longest_head = 100;  // of a record

std::uint64_t seal_of_piece(std::uint64_t identity, std::size_t piece, std::string_view bytes) {
  Signature signature;
  signature.add(identity);
  signature.add(std::uint64_t{piece});
  signature.add(bytes);
  return signature.value();
}

/// Takes a number and the character after it off the front of a text.
std::optional<std::uint64_t> take_number(std::string_view& text, int base, char after) {
  std::uint64_t number = 0;
  const auto [end, error] = std::from_chars(text.data(), text.data() + text.size(), number, base);
  if (error != std::errc() || end == text.data() + text.size() || *end != after) return std::nullopt;
  text.remove_prefix(static_cast<std::size_t>(end - text.data()) + 1);
  return number;
}

struct Record {
  std::uint64_t identity = 0;
  std::size_t piece = 0;
  std::string_view bytes{};
  bool sealed = false;
};

/// Takes a record off the front; nothing where it is cut off or none, which `cut_off` tells apart.
std::optional<Record> take_record(std::string_view& text, bool& cut_off) {
  const auto line = text.substr(0, longest_head).find('\n');
  cut_off = line == std::string_view::npos;
  if (cut_off || text.substr(0, record_word.size()) != record_word) return std::nullopt;
  std::string_view rest = text.substr(record_word.size());
  const auto identity = take_number(rest, 16, ' ');
  const auto piece = identity ? take_number(rest, 10, ' ') : std::nullopt;
  const auto size = piece ? take_number(rest, 10, ' ') : std::nullopt;
  const auto seal = size ? take_number(rest, 16, '\n') : std::nullopt;
  if (!seal) return std::nullopt;
  cut_off = rest.size() <= *size;
  if (cut_off) return std::nullopt;
  Record record{*identity, *piece, rest.substr(0, *size), false};
  record.sealed = rest[*size] == '\n' && *seal == seal_of_piece(*identity, *piece, record.bytes);
  text = rest.substr(*size + 1);
  return record;
}

}  // namespace

std::string piece_journal_head(std::uint64_t identity) {
  return sealed(fmt::format("{}\nidentity {:016x}\n", piece_title, identity));
}

std::string piece_record(std::uint64_t identity, std::size_t piece, std::string_view bytes) {
  std::string record = fmt::format("{}{:016x} {} {} {:016x}\n", record_word, identity, piece, bytes.size(),
                                   seal_of_piece(identity, piece, bytes));
  record += bytes;
  record += '\n';
  return record;
}

PieceJournal read_piece_journal(std::string_view text, const std::string& source, std::uint64_t identity) {
  const std::size_t head = piece_journal_head(identity).size();
  unsealed(text.substr(0, head), piece_title, source);
  if (text.substr(0, head) != piece_journal_head(identity)) refuse_other_run(source);
  PieceJournal journal;
  std::string_view rest = text.substr(head);
  while (!rest.empty()) {
    journal.whole = text.size() - rest.size();
    bool cut_off = false;
    const auto record = take_record(rest, cut_off);
    const bool last = cut_off || rest.empty();
    if ((!record || !record->sealed) && !last)
      refuse_file(source, "a journal that is damaged: delete it to begin anew");
    if (!record || !record->sealed) return journal;
    journal.pieces[{record->identity, record->piece}] = record->bytes;
  }
  journal.whole = text.size();
  return journal;
}

}  // namespace folk
