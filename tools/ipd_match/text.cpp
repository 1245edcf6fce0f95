#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cstdlib>
#include <string>
#include <string_view>
#include <vector>

#include <sys/ioctl.h>
#include <unistd.h>

#include <folk/games/utf8.h>
#include <folk/tools/choices/game_option.h>
#include <folk/tools/ipd_match/output.h>
#include <folk/tools/program/table.h>

namespace folk::tools {
namespace {

bool stdout_is_coloured() {
  const char* refusal = std::getenv("NO_COLOR");
  const char* terminal = std::getenv("TERM");
  return ::isatty(STDOUT_FILENO) == 1 && (refusal == nullptr || *refusal == '\0') &&
         (terminal == nullptr || std::string_view(terminal) != "dumb");
}

std::size_t stdout_width() {
  winsize size{};
  return ::ioctl(STDOUT_FILENO, TIOCGWINSZ, &size) == 0 && size.ws_col > 0 ? size.ws_col : 80;
}

char lower(char letter) { return letter == 'C' ? 'c' : 'd'; }

/// A move; lower case where noise flipped it.
char move_letter(const MatchRecord& record, Seat seat, std::size_t round) {
  const char letter = to_char(record.move(seat, round));
  return record.slipped[index(seat)][round] ? lower(letter) : letter;
}

/// The move that was expected of the other; lower case where it was wrong.
char belief_letter(const MatchRecord& record, Seat seat, std::size_t round) {
  const auto expected = expected_move(record, seat, round);
  if (!expected) return '-';
  const char letter = to_char(*expected);
  return *expected == record.move(other(seat), round) ? letter : lower(letter);
}

/// C blue, D orange (a pair that the colour-blind tell apart), lower case underlined.
std::string coloured(const std::string& letters, bool colours) {
  if (!colours) return letters;
  std::string text;
  char last = '\0';
  for (const char letter : letters) {
    if (letter != last) {
      text += "\x1b[0m";
      if (letter == 'C' || letter == 'c') text += "\x1b[38;5;33m";
      if (letter == 'D' || letter == 'd') text += "\x1b[38;5;208m";
      if (letter == 'c' || letter == 'd') text += "\x1b[4m";
    }
    text += letter;
    last = letter;
  }
  return text + "\x1b[0m";
}

/// How wide the parts of a line are.
struct Page {
  std::size_t name = 0;
  std::size_t moves = 0;
  std::size_t score = 5;
  bool colours = false;
};

/// A name for the margin, its middle left out when it is long.
std::string margin_name(const std::string& whole) {
  constexpr std::size_t most = 24;
  const std::string name = visible_text(whole);
  if (name.size() <= most) return name;
  // No UTF-8 character is cut: its later bytes are 10xxxxxx.
  const auto inside = [&](std::size_t at) { return (static_cast<unsigned char>(name[at]) & 0xC0U) == 0x80U; };
  std::size_t head = 12;
  while (head > 0 && inside(head)) --head;
  std::size_t tail = name.size() - 9;
  while (tail < name.size() && inside(tail)) ++tail;
  return name.substr(0, head) + "..." + name.substr(tail);
}

Page page_for(const MatchRecord& record, const std::array<std::vector<Rational>, 2>& scores, const Sheet& sheet) {
  Page page;
  page.colours = sheet.colours;
  for (const auto& name : record.names) page.name = std::max(page.name, margin_name(name).size());
  page.name = std::max<std::size_t>(page.name, 5);
  for (const auto& beliefs : record.beliefs)
    if (!beliefs.empty()) page.name = std::max<std::size_t>(page.name, 10);
  for (const auto& running : scores) page.score = std::max(page.score, to_text(running.back()).size());
  const std::size_t taken = page.name + page.score + 4;
  // Whole tens, so that every line begins at round 1, 41, 81...
  page.moves = sheet.width > taken + 10 ? (sheet.width - taken) / 10 * 10 : 10;
  page.moves = std::min(page.moves, (record.transcript.rounds() + 9) / 10 * 10);
  return page;
}

std::string line(const Page& page, const std::string& name, const std::string& moves, const std::string& plain,
                 const std::string& score) {
  const std::string gap(page.moves - plain.size(), ' ');
  std::string text = fmt::format("{:<{}}  {}{}  {:>{}}", name, page.name, moves, gap, score, page.score);
  text.erase(text.find_last_not_of(' ') + 1);
  return text + "\n";
}

/// The numbers of the rounds 10, 20, 30... above the moves, each ending over its round.
std::string ruler(const Page& page, std::size_t begin, std::size_t end) {
  std::string text;
  for (std::size_t ten = begin + 10; ten <= end; ten += 10) text += fmt::format("{:>10}", ten);
  return line(page, "round", text, text, "score");
}

std::string block(const Page& page, const MatchRecord& record, const std::array<std::vector<Rational>, 2>& scores,
                  std::size_t begin, std::size_t end) {
  std::string text = ruler(page, begin, end);
  for (const Seat seat : both_seats) {
    const std::size_t s = index(seat);
    std::string moves;
    std::string beliefs;
    for (std::size_t t = begin; t < end; ++t) {
      moves += move_letter(record, seat, t);
      if (!record.beliefs[s].empty()) beliefs += belief_letter(record, seat, t);
    }
    text += line(page, margin_name(record.names[s]), coloured(moves, page.colours), moves, to_text(scores[s][end - 1]));
    if (!beliefs.empty()) text += line(page, "  believes", coloured(beliefs, page.colours), beliefs, "");
  }
  return text;
}

std::string legend(const MatchRecord& record) {
  std::string text;
  const auto slipped = [](const std::vector<bool>& flags) {
    return std::find(flags.begin(), flags.end(), true) != flags.end();
  };
  if (slipped(record.slipped[0]) || slipped(record.slipped[1])) text += "lower case: a move that noise flipped\n";
  if (!record.beliefs[0].empty() || !record.beliefs[1].empty())
    text += "believes: the move expected of the other, lower case where it was wrong (-: none told)\n";
  return text.empty() ? text : text + "\n";
}

std::string summary(const MatchSettings& settings, const MatchRecord& record,
                    const std::array<std::vector<Rational>, 2>& scores) {
  const bool believing = !record.beliefs[0].empty() || !record.beliefs[1].empty();
  std::vector<std::string> header{"", "score", "mean a round", "cooperation"};
  if (believing) header.emplace_back("beliefs right");
  Table table(header);
  for (const Seat seat : both_seats) {
    const std::size_t s = index(seat);
    const Rational& score = scores[s].back();
    std::vector<std::string> row{record.names[s], to_text(score),
                                 fmt::format("{:.3f}", to_double(score / Rational(settings.rounds))),
                                 fmt::format("{:.1f} %", 100 * cooperation_rate(record, seat))};
    if (believing) {
      const auto accuracy = belief_accuracy(record, seat);
      row.push_back(accuracy ? fmt::format("{:.2f} %", 100 * *accuracy) : "-");
    }
    table.add(row);
  }
  return table.text();
}

}  // namespace

Sheet sheet_of_stdout() { return {stdout_width(), stdout_is_coloured()}; }

void write_text(std::ostream& out, const MatchSettings& settings, const MatchRecord& record, const Sheet& sheet) {
  const std::array<std::vector<Rational>, 2> scores{running_scores(settings, record, Seat::first),
                                                    running_scores(settings, record, Seat::second)};
  out << visible_line(record.names[0] + " against " + record.names[1])
      << fmt::format("{}, {}; {} rounds; noise {}; seed {}\n", shown_title(settings.game.title),
                     to_text(settings.game.payoffs), settings.rounds, to_short_text(settings.noise), settings.seed);
  const std::string actions = action_words(settings.game);
  out << (actions.empty() ? "\n" : actions + "\n\n");
  const Page page = page_for(record, scores, sheet);
  for (std::size_t begin = 0; begin < settings.rounds; begin += page.moves)
    out << block(page, record, scores, begin, std::min<std::size_t>(begin + page.moves, settings.rounds)) << "\n";
  out << legend(record) << summary(settings, record, scores);
  for (std::size_t i = 0; i < record.caveats.size(); ++i)
    out << (i == 0 ? "\n" : "") << visible_line("note: " + record.caveats[i]);
}

}  // namespace folk::tools
